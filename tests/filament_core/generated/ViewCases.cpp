// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/generated/ViewCases.h"

#include <fmt/format.h>

#include <iterator>

namespace filament_core::test {
namespace {

void append(std::vector<ViewFactor>& all, std::vector<ViewFactor> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<ViewFactor> factorsOfScene() {
    return {
        { "scene",
          { { "everything", [](ViewCase&) {} },
            { "empty", [](ViewCase& c) { c.scene = SeenScene::Empty; } },
            { "sky", [](ViewCase& c) { c.scene = SeenScene::SkyOnly; } },
            { "unlit", [](ViewCase& c) { c.scene = SeenScene::UnlitOnly; } },
            { "blended", [](ViewCase& c) { c.scene = SeenScene::BlendedOnly; } } } },
        { "target",
          { { "rgba8", [](ViewCase&) {} },
            { "rgb10a2", [](ViewCase& c) { c.target = SeenTarget::Rgb10A2; } },
            { "rgba16f", [](ViewCase& c) { c.target = SeenTarget::HalfFloats; } },
            { "srgbWithMips", [](ViewCase& c) { c.target = SeenTarget::SrgbWithMips; } },
            { "lightWithDepth", [](ViewCase& c) { c.target = SeenTarget::LightWithDepth; } } } },
        { "size",
          { { "32x24",
              [](ViewCase& c) {
                  c.view.size = { 32, 24 };
              } },
            { "1x1",
              [](ViewCase& c) {
                  c.view.size = { 1, 1 };
              } },
            { "1x37",
              [](ViewCase& c) {
                  c.view.size = { 1, 37 };
              } },
            { "61x1",
              [](ViewCase& c) {
                  c.view.size = { 61, 1 };
              } },
            { "33x17",
              [](ViewCase& c) {
                  c.view.size = { 33, 17 };
              } } } },
        { "viewport",
          { { "none", [](ViewCase&) {} },
            { "keep",
              [](ViewCase& c) {
                  c.view.viewport = Viewport{ .offset = { 2, 1 } };
              } },
            { "clear",
              [](ViewCase& c) {
                  c.view.viewport = Viewport{ .offset = { 3, 2 },
                                              .contents = TargetContents::Clear,
                                              .clearColor = { 0.2f, 0.4f, 0.6f, 1 } };
              } },
            { "translucent",
              [](ViewCase& c) {
                  c.view.viewport = Viewport{ .offset = { 1, 2 }, .blending = ViewBlending::Translucent };
                  c.view.clearColor = { 0, 0, 0, 0 };
              } } } },
        { "moves", { { "off", [](ViewCase&) {} }, { "on", [](ViewCase& c) { c.moves = true; } } } },
    };
}

std::vector<ViewFactor> factorsOfLens() {
    return {
        { "lens",
          { { "perspective", [](ViewCase&) {} },
            { "parallel", [](ViewCase& c) { c.view.camera.lens = { .orthographicHeight = 4, .farMeters = 30 }; } },
            { "box", [](ViewCase& c) { c.view.camera.lens = Lens::orthographic(-3, 1, -2, 2, 0.5f, 40); } },
            { "offCenter", [](ViewCase& c) { c.view.camera.lens = Lens::offCenter(-0.8f, 0.2f, -0.1f, 0.7f); } } } },
        { "samples", { { "1", [](ViewCase&) {} }, { "4", [](ViewCase& c) { c.view.samples = 4; } } } },
        { "msaaResolve",
          { { "average", [](ViewCase&) {} },
            { "toneAware", [](ViewCase& c) { c.view.quality.msaaResolve = MsaaResolve::ToneAware; } } } },
        { "depthRange",
          { { "reversed", [](ViewCase&) {} },
            { "ordinary", [](ViewCase& c) { c.view.quality.depthRange = DepthRange::Ordinary; } } } },
        { "depthPrepass",
          { { "auto", [](ViewCase&) {} },
            { "on", [](ViewCase& c) { c.view.quality.depthPrepass = DepthPrepass::On; } },
            { "off", [](ViewCase& c) { c.view.quality.depthPrepass = DepthPrepass::Off; } } } },
    };
}

std::vector<ViewFactor> factorsOfPixels() {
    return {
        { "antiAliasing",
          { { "off", [](ViewCase&) {} },
            { "fxaa", [](ViewCase& c) { c.view.quality.antiAliasing = AntiAliasing::Fxaa; } },
            { "sraa", [](ViewCase& c) { c.view.quality.antiAliasing = AntiAliasing::Sraa; } },
            { "taa", [](ViewCase& c) { c.view.quality.antiAliasing = AntiAliasing::Taa; } } } },
        { "upscale",
          { { "off", [](ViewCase&) {} },
            { "bilinear", [](ViewCase& c) { c.view.effects.resolution.upscaling = Upscaling::Bilinear; } },
            { "catmullRom", [](ViewCase& c) { c.view.effects.resolution.upscaling = Upscaling::CatmullRom; } },
            { "edgeAdaptive", [](ViewCase& c) { c.view.effects.resolution.upscaling = Upscaling::EdgeAdaptive; } } } },
        { "scale",
          { { "1", [](ViewCase&) {} },
            { "0.5", [](ViewCase& c) { c.view.effects.resolution.scale = float2(0.5f); } },
            { "0.77x0.6",
              [](ViewCase& c) {
                  c.view.effects.resolution.scale = { 0.77f, 0.6f };
              } } } },
        { "guardBand",
          { { "off", [](ViewCase&) {} },
            { "0.1", [](ViewCase& c) { c.view.effects.guardBand.enabled = true; } },
            { "0.5", [](ViewCase& c) { c.view.effects.guardBand = { .enabled = true, .width = 0.5f }; } } } },
        { "sharpening",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.sharpening = { true, 1 };
              } } } },
        { "postProcess",
          { { "none", [](ViewCase&) {} },
            { "afterOpaque", [](ViewCase& c) { c.pass = PassPlace::AfterOpaque; } },
            { "afterToneMapping", [](ViewCase& c) { c.pass = PassPlace::AfterToneMapping; } },
            { "last", [](ViewCase& c) { c.pass = PassPlace::Last; } } } },
        { "debugDraw", { { "off", [](ViewCase&) {} }, { "on", [](ViewCase& c) { c.hasDebugDraw = true; } } } },
    };
}

std::vector<ViewFactor> factorsOfLight() {
    return {
        { "shadows",
          { { "off", [](ViewCase& c) { c.view.quality.shadows = ShadowFilter::Off; } },
            { "pcf3", [](ViewCase&) {} },
            { "pcss",
              [](ViewCase& c) {
                  c.view.quality.shadows = ShadowFilter::Pcss;
                  c.view.quality.areaShadows = AreaShadows::Shape;
              } },
            { "evsm",
              [](ViewCase& c) {
                  c.view.quality.shadows = ShadowFilter::Evsm;
                  c.view.quality.coloredShadows = true;
                  c.view.quality.shadowCascades = 3;
              } } } },
        { "ao",
          { { "off", [](ViewCase&) {} },
            { "sao",
              [](ViewCase& c) {
                  c.view.effects.ambientOcclusion.enabled = true;
                  c.view.effects.ambientOcclusion.method = AmbientOcclusionMethod::Sao;
              } },
            { "gtao",
              [](ViewCase& c) {
                  c.view.effects.ambientOcclusion.enabled = true;
                  c.view.effects.ambientOcclusion.resolution = AmbientOcclusionResolution::Checkerboard;
                  c.view.effects.ambientOcclusion.bentNormals = true;
              } } } },
        { "ssr",
          { { "off", [](ViewCase&) {} },
            { "on", [](ViewCase& c) { c.view.effects.screenSpaceReflections.enabled = true; } } } },
        { "refraction",
          { { "environment", [](ViewCase& c) { c.view.quality.refraction = RefractionSource::Environment; } },
            { "screen", [](ViewCase&) {} },
            { "layers", [](ViewCase& c) { c.view.quality.refractionLayers = 4; } } } },
        { "transparency",
          { { "sorted", [](ViewCase&) {} },
            { "weighted", [](ViewCase& c) { c.view.quality.transparency = TransparencyOrder::Weighted; } },
            { "peeled", [](ViewCase& c) { c.view.quality.transparency = TransparencyOrder::Peeled; } } } },
        { "fog",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.fog = { .enabled = true, .heightFalloff = 0.5f, .inScatteringSize = 8 };
              } },
            { "fromEnvironment",
              [](ViewCase& c) { c.view.effects.fog = { .enabled = true, .colorFromEnvironment = true }; } },
            { "volumetric",
              [](ViewCase& c) {
                  c.view.effects.fog = { .enabled = true, .volumetric = true, .volumetricMeters = 9 };
              } },
            { "varying",
              [](ViewCase& c) {
                  c.view.effects.fog = { .enabled = true,
                                         .volumetric = true,
                                         .volumetricMeters = 9,
                                         .volumetricFrames = 8,
                                         .attenuatesLight = true,
                                         .noiseAmplitude = 0.8f,
                                         .noiseMeters = 1 };
              } } } },
        { "probe",
          { { "off", [](ViewCase&) {} },
            { "on", [](ViewCase& c) { c.hasProbe = true; } },
            { "debug view", [](ViewCase& c) { c.hasProbe = true, c.view.debugView = DebugView::Probes; } } } },
    };
}

std::vector<ViewFactor> factorsOfCamera() {
    return {
        { "bloom",
          { { "off", [](ViewCase&) {} },
            { "half", [](ViewCase& c) { c.view.effects.bloom = { .enabled = true, .radius = 1 }; } },
            { "quarter",
              [](ViewCase& c) {
                  c.view.effects.bloom = { .enabled = true, .strength = 1, .threshold = 0.5f };
                  c.view.effects.bloom.resolution = BloomResolution::Quarter;
                  c.hasDirt = true;
              } } } },
        { "lensFlare",
          { { "off", [](ViewCase&) {} },
            { "on", [](ViewCase& c) { c.view.effects.lensFlare = { .enabled = true, .threshold = 0.1f }; } } } },
        { "depthOfField",
          { { "off", [](ViewCase&) {} },
            { "round",
              [](ViewCase& c) {
                  c.view.effects.depthOfField = { .enabled = true, .focusMeters = 0.5f, .blurScale = 20 };
              } },
            { "blades",
              [](ViewCase& c) {
                  c.view.effects.depthOfField = {
                      .enabled = true, .focusMeters = 9, .blurScale = 90, .maxRadius = 0.1f, .blades = 5
                  };
              } } } },
        { "motionBlur",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.motionBlur = { .enabled = true, .shutterDegrees = 360, .maxRadius = 0.1f };
              } } } },
        { "autoExposure",
          { { "off", [](ViewCase&) {} }, { "on", [](ViewCase& c) { c.view.effects.autoExposure.enabled = true; } } } },
    };
}

std::vector<ViewFactor> factorsOfFinish() {
    return {
        { "fringes",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.chromaticAberration = { true, 0.1f };
              } } } },
        { "vignette",
          { { "off", [](ViewCase&) {} }, { "on", [](ViewCase& c) { c.view.effects.vignette.enabled = true; } } } },
        { "grain",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.grain = { true, 1, 1.3f };
              } } } },
        { "grading",
          { { "off", [](ViewCase&) {} },
            { "on",
              [](ViewCase& c) {
                  c.view.effects.colorGrading = { .enabled = true,
                                                  .nightAdaptation = 0.5f,
                                                  .temperature = 0.7f,
                                                  .power = float3(0.5f, 1, 3),
                                                  .contrast = 1.8f,
                                                  .vibrance = 2,
                                                  .gamutMapping = true };
              } } } },
        { "toneMapper",
          { { "linear", [](ViewCase& c) { c.view.display.toneMapper = ToneMapper::Linear; } },
            { "aces", [](ViewCase&) {} },
            { "agxTable",
              [](ViewCase& c) {
                  c.view.display = { .toneMapper = ToneMapper::Agx, .dither = true };
                  c.view.quality.toneMapping = ToneMapping::Table16;
              } },
            { "pq",
              [](ViewCase& c) {
                  c.view.display = { .toneMapper = ToneMapper::PbrNeutral, .outputSpace = OutputSpace::Rec2020Pq };
              } } } },
    };
}

} // namespace

std::span<const ViewFactor> viewFactors() {
    static const std::vector<ViewFactor> kAll = [] {
        std::vector<ViewFactor> all;
        append(all, factorsOfScene());
        append(all, factorsOfLens());
        append(all, factorsOfPixels());
        append(all, factorsOfLight());
        append(all, factorsOfCamera());
        append(all, factorsOfFinish());
        return all;
    }();
    return kAll;
}

std::vector<uint32_t> valuesOfFactors() {
    std::vector<uint32_t> counts;
    for (ViewFactor const& factor : viewFactors()) counts.push_back(static_cast<uint32_t>(factor.values.size()));
    return counts;
}

ViewCase viewCase(PairRow const& row) {
    ViewCase made;
    const Lens lens{ .verticalFovDegrees = 60, .nearMeters = 0.1f };
    made.view.camera = Camera::lookAt({ 0.3, 1.2, 4 }, { 0, 0.2, 0 }, lens, { 4, 1.0f / 60, 200 });
    made.view.clearColor = { 0.3f, 0.1f, 0.05f, 1 };
    for (size_t i = 0; i < row.size(); ++i) {
        ViewFactor const& factor = viewFactors()[i];
        ViewValue const& value = factor.values[row[i]];
        value.apply(made);
        made.words += fmt::format("{}{}={}", i ? " " : "", factor.name, value.name);
    }
    return made;
}

uint2 targetSize(ViewCase const& viewCase) { return viewCase.view.size + (viewCase.view.viewport ? 5u : 0u); }

} // namespace filament_core::test
