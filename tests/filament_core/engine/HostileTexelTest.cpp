// SPDX-License-Identifier: Apache-2.0
// One texel of light that is NaN, infinite, or the largest number, under every post-processing effect alone
// and under all of them: the others stay finite, and a frame later it is forgotten. The list of effects is generated
// from the options, so new ones are in it.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <cmath>
#include <functional>

namespace filament_core {
namespace {

struct NamedView {
    std::string name;
    std::function<void(View&)> set;
};

void switchOn(View& view, std::string_view name) {
    EXPECT_TRUE(setOption(view.effects, name, "on")) << name;
    view.effects.depthOfField.focusMeters = 0.2f;
    view.effects.depthOfField.blurScale = 100;
    view.effects.depthOfField.maxRadius = 0.1f;
    view.effects.motionBlur.maxRadius = 0.1f;
    view.effects.lensFlare.threshold = 0.2f;
    view.effects.colorGrading.contrast = 1.2f;
    view.effects.colorGrading.temperature = 0.2f;
    view.effects.autoExposure.speedDown = view.effects.autoExposure.speedUp = 1000; // stops a second
}

bool isSwitch(Option const& option) {
    return option.kind == OptionKind::Switch && option.name.find('.') == std::string_view::npos;
}

std::vector<NamedView> everyEffect() {
    std::vector<NamedView> views{ { "none", [](View&) {} } };
    for (Option const& option : optionsOf<Effects>()) {
        if (isSwitch(option))
            views.push_back({ std::string(option.name), [name = option.name](View& view) { switchOn(view, name); } });
    }
    for (const AntiAliasing choice : { AntiAliasing::Fxaa, AntiAliasing::Taa })
        views.push_back({ toString(choice), [choice](View& view) { view.quality.antiAliasing = choice; } });
    for (const Upscaling choice : { Upscaling::Bilinear, Upscaling::CatmullRom, Upscaling::EdgeAdaptive })
        views.push_back({ toString(choice), [choice](View& view) {
                             view.effects.resolution.upscaling = choice;
                             view.effects.resolution.scale = float2(0.5f);
                         } });
    views.push_back({ "everything", [](View& view) {
                         for (Option const& option : optionsOf<Effects>())
                             if (isSwitch(option)) switchOn(view, option.name);
                         view.quality.antiAliasing = AntiAliasing::Taa;
                     } });
    return views;
}

constexpr uint2 kPictureSize{ 24, 20 }, kTexel{ 11, 9 };
constexpr int kFrames = 3, kHostileFrame = 1;

/// The frames of an engine that shows moderate light, and in one frame `light` in one texel.
std::vector<Image> framesOf(Backend backend, NamedView const& effect, std::string const& light, Format format) {
    test::SquareStage stage(
            backend,
            test::text("shadingModel : unlit, culling : none",
                       fmt::format("vec2 band = 0.5 * (getResolution().xy - vec2({}, {})); // that a guard band adds\n"
                                   "vec2 at = gl_FragCoord.xy - band; float calm = 0.3 + 0.2 * sin(at.x) * cos(at.y);\n"
                                   "bool isHostile = ivec2(at) == ivec2({}, {}) && getUserTime().x == {}.0;\n"
                                   "material.baseColor = vec4(vec3(isHostile ? {} : calm), 1.0);",
                                   kPictureSize.x, kPictureSize.y, kTexel.x, kTexel.y, kHostileFrame, light)));
    Scene scene(stage.engine);
    stage.square.add(scene, stage.instance, double3(0), 8);
    View view = test::SquareMesh::view(kPictureSize);
    effect.set(view);
    Renderer renderer(stage.engine);
    const Owned<SwapChain> target = stage.engine.own(
            stage.engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = format, .name = "out" }));
    std::vector<Image> images;
    for (int frame = 0; frame < kFrames; ++frame) {
        view.timeSeconds = frame;
        view.camera.worldFromView[3].x = 0.4 * frame; // for what blurs motion
        renderer.render(scene, view, target);
        auto image = renderer.waitPixels(renderer.readPixels(target));
        EXPECT_TRUE(image);
        if (image) images.push_back(std::move(*image));
    }
    return images;
}

/// A light of the texel in GLSL, and whether it is one at all.
struct HostileLight {
    const char* formula;
    bool isBright = false;
};
constexpr HostileLight kHostileLights[] = { { "uintBitsToFloat(0x7fc00000u)" },
                                            { "uintBitsToFloat(0x7f800000u)", true },
                                            { "-uintBitsToFloat(0x7f800000u)" },
                                            { "1e6", true },
                                            { "-1e6" } };

/// The largest difference of a component from the image without the texel, which is skipped; expects that all are
/// finite.
float farthestFrom(Image const& calm, Image const& image, bool hasTexel) {
    float farthest = 0;
    for (uint32_t i = 0; i < kPictureSize.x * kPictureSize.y; ++i) {
        const uint2 at(i % kPictureSize.x, i / kPictureSize.x);
        if (hasTexel && at == kTexel) continue;
        const float4 seen = test::halfPixel(image, at.x, at.y), expected = test::halfPixel(calm, at.x, at.y);
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(seen[c])) << at.x << " " << at.y;
            farthest = std::max(farthest, std::abs(seen[c] - expected[c]));
        }
    }
    return farthest;
}

bool gathers(std::string const& effect) { return effect == "taa" || effect == "everything"; }

TEST(HostileTexel, StaysAloneAndIsForgotten) {
    constexpr float kMostCalm = 0.5f; // of the light around it
    std::vector<Image> plain;
    for (NamedView const& effect : everyEffect()) {
        const std::vector<Image> calm = framesOf(Backend::Vulkan, effect, "calm", Format::RGBA16F);
        if (plain.empty()) plain = calm;
        // a display; effects that look beyond the image; indirect light; materials that reflect the scene
        constexpr std::array kNeedMore{ "grain", "guardBand", "ambientOcclusion", "screenSpaceReflections" };
        const bool needsMore = std::ranges::find(kNeedMore, effect.name) != kNeedMore.end();
        EXPECT_EQ(calm.back().pixels == plain.back().pixels, effect.name == "none" || needsMore)
                << effect.name << " does something";
        for (HostileLight const& light : kHostileLights) {
            SCOPED_TRACE(effect.name + ", " + light.formula);
            const std::vector<Image> vulkan = framesOf(Backend::Vulkan, effect, light.formula, Format::RGBA16F);
            const std::vector<Image> gles = framesOf(Backend::Gles, effect, light.formula, Format::RGBA16F);
            ASSERT_TRUE(vulkan.size() == kFrames && gles.size() == kFrames && calm.size() == kFrames);
            for (int frame = 0; frame < kFrames; ++frame) {
                EXPECT_EQ(test::differingPixels(vulkan[frame], gles[frame]), 0u) << frame;
                const float farthest = farthestFrom(calm[frame], vulkan[frame], frame == kHostileFrame);
                if (frame == kHostileFrame)
                    EXPECT_LE(farthest, light.isBright ? 65504 : kMostCalm);
                else
                    EXPECT_LE(farthest, frame > kHostileFrame && gathers(effect.name) ? 0.4f * kMostCalm : 0) << frame;
            }
        }
    }
}

TEST(HostileTexel, HasTheSameDisplayValuesOnBothApis) {
    for (NamedView const& effect : everyEffect()) {
        for (HostileLight const& light : std::span(kHostileLights).first(2)) {
            const std::vector<Image> vulkan = framesOf(Backend::Vulkan, effect, light.formula, Format::RGBA8);
            const std::vector<Image> gles = framesOf(Backend::Gles, effect, light.formula, Format::RGBA8);
            ASSERT_EQ(vulkan.size(), gles.size());
            for (size_t frame = 0; frame < vulkan.size(); ++frame)
                EXPECT_EQ(vulkan[frame].pixels, gles[frame].pixels) << effect.name << ", " << light.formula;
        }
    }
}

} // namespace
} // namespace filament_core
