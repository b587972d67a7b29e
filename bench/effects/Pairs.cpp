// SPDX-License-Identifier: Apache-2.0
#include "bench/effects/Pairs.h"

#include <array>
#include <memory>
#include <utility>

namespace filament_core::bench {
namespace {

constexpr float3 kSunDirection{ -0.4f, -1.0f, -0.6f };

std::function<void(Scene&, View&)> withSun(ShadowFilter filter) {
    return [filter](Scene& scene, View& view) {
        scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
        view.quality.shadows = filter;
    };
}

std::function<void(Scene&, View&)> withThreeSuns(ShadowFilter filter) {
    return [filter](Scene& scene, View& view) {
        for (const float turn : { -1.0f, 0.0f, 1.0f })
            scene.add(SunLight{ .directionWorld = kSunDirection + float3(turn, 0, 0), .illuminance = Lux{ 20'000 } });
        view.quality.shadows = filter;
    };
}

std::function<void(Scene&, View&)> withFog(Fog const& fog) {
    return [fog](Scene&, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        view.effects.fog = fog;
    };
}

/// Probes around the model, whose light changes from place to place.
void addGrid(Scene& scene, View&) {
    auto probes = std::make_shared<IrradianceProbes>();
    probes->count = uint3(6);
    for (uint32_t i = 0; i < 216; ++i) {
        const float3 at = float3(uint3(i % 6, i / 6 % 6, i / 36));
        IrradianceProbe probe;
        probe.irradianceSh[0] = 2000.0f + 800.0f * at;
        probe.irradianceSh[1] = 300.0f * float3(at.y, at.z, at.x);
        probe.irradianceSh[4] = float3(100);
        probes->probes.push_back(probe);
    }
    scene.add(IrradianceGridDesc{ .halfExtentMeters = float3(1.5f), .probes = probes });
}

void addGridPairs(std::vector<Pair>& all, const char* file) {
    const auto nothing = [](Scene&, View& view) { view.quality.shadows = ShadowFilter::Off; };
    const auto grid = [](Scene& scene, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        addGrid(scene, view);
    };
    all.push_back({ .name = "irradiance grid", .file = file, .plain = nothing, .effect = grid });
    all.push_back({ .name = "irradiance grid, the model turns",
                    .file = file,
                    .plain = nothing,
                    .effect = grid,
                    .moving = Moving::Model });
}

void addFogPairs(std::vector<Pair>& all, const char* file) {
    Fog fog{ .enabled = true, .density = 0.4f, .startMeters = 0.5f, .heightMeters = -0.5f, .heightFalloff = 1 };
    all.push_back({ "fog", file, withFog({}), withFog(fog) });
    Fog colored = fog;
    colored.colorFromEnvironment = true;
    all.push_back({ "fog, coloured by the environment", file, withFog({}), withFog(colored) });
    fog.density = 0;
    all.push_back({ "fog without density", file, withFog({}), withFog(fog), true });
}

/// The sun shines through fog and casts shadows into it; without them, volumetric fog needs no cells.
void addVolumetricFogPairs(std::vector<Pair>& all, const char* file) {
    const auto lit = [](bool isVolumetric, ShadowFilter filter) {
        return [isVolumetric, filter](Scene& scene, View& view) {
            scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
            view.quality.shadows = filter;
            view.effects.fog = { .enabled = true, .density = 0.4f, .volumetric = isVolumetric, .volumetricMeters = 8 };
        };
    };
    all.push_back({ "volumetric fog", file, lit(false, ShadowFilter::Pcf3), lit(true, ShadowFilter::Pcf3) });
    all.push_back(
            { "volumetric fog without shadows", file, lit(false, ShadowFilter::Off), lit(true, ShadowFilter::Off) });
}

std::function<void(Scene&, View&)> withContactSun(bool isAsked, ShadowFilter filter) {
    return [isAsked, filter](Scene& scene, View& view) {
        scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 }, .contactShadows = isAsked });
        view.quality.shadows = filter;
        view.effects.contactShadows = { .distanceMeters = 0.1f, .thicknessMeters = 0.05f };
    };
}

void addContactPairs(std::vector<Pair>& all, const char* file) {
    for (const ShadowFilter filter : { ShadowFilter::Off, ShadowFilter::Pcf3 })
        all.push_back({ filter == ShadowFilter::Off ? "contact shadows" : "contact shadows beside pcf3", file,
                        withContactSun(false, filter), withContactSun(true, filter) });
    const auto lamp = [](bool isAsked) {
        return [isAsked](Scene& scene, View& view) {
            view.quality.shadows = ShadowFilter::Off;
            scene.add(PointLight{ .positionWorld = { 50, 0, 0 }, .rangeMeters = 2, .contactShadows = isAsked });
        };
    };
    all.push_back({ "contact shadows of a lamp out of reach", file, lamp(false), lamp(true), true });
}

std::function<void(Scene&, View&)> withOcclusion(AmbientOcclusion const& occlusion) {
    return [=](Scene&, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        view.effects.ambientOcclusion = occlusion;
        view.effects.ambientOcclusion.radiusMeters = 0.1f; // the model is 1 m large
    };
}

void addOcclusion(std::vector<Pair>& all) {
    constexpr const char* kHelmet = "FlightHelmet/FlightHelmet.gltf";
    constexpr const char* kTokyo = "LittlestTokyo/LittlestTokyo.glb";
    using Method = AmbientOcclusionMethod;
    using Resolution = AmbientOcclusionResolution;
    const auto plain = withOcclusion({});
    for (const char* file : { kHelmet, kTokyo }) {
        for (const Method method : { Method::Sao, Method::Gtao }) {
            for (const Resolution resolution : { Resolution::Full, Resolution::Half })
                all.push_back({ fmt::format("ambientOcclusion.method={}, {}", toString(method), toString(resolution)),
                                file, plain,
                                withOcclusion({ .enabled = true, .method = method, .resolution = resolution }) });
        }
    }
    all.push_back({ "ambientOcclusion.method=gtao, checkerboard", kHelmet, plain,
                    withOcclusion({ .enabled = true, .resolution = Resolution::Checkerboard }) });
    all.push_back({ "ambientOcclusion.method=gtao, full, bent normals", kHelmet, plain,
                    withOcclusion({ .enabled = true, .resolution = Resolution::Full, .bentNormals = true }) });
    const auto withoutSky = [](bool isOn) {
        return [=](Scene& scene, View& view) {
            scene.setIndirectLight({}, {});
            scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
            view.quality.shadows = ShadowFilter::Off;
            view.effects.ambientOcclusion.enabled = isOn;
        };
    };
    all.push_back({ "ambientOcclusion, no indirect light", kHelmet, withoutSky(false), withoutSky(true), true });
}

void addReflections(std::vector<Pair>& all, const char* file) {
    const auto on = reflecting(true), off = reflecting(false);
    all.push_back({ .name = "screenSpaceReflections=on, with a metal floor",
                    .file = file,
                    .plain = off,
                    .effect = on,
                    .hasMirror = true });
    all.push_back({ .name = "screenSpaceReflections=on, with a metal floor, and the model turns",
                    .file = file,
                    .plain = off,
                    .effect = on,
                    .hasMirror = true,
                    .moving = Moving::Model });
    all.push_back({ .name = "screenSpaceReflections=on", .file = file, .plain = off, .effect = on });
}

void addBloom(std::vector<Pair>& all, const char* file) {
    const auto blooming = [](Bloom const& bloom) {
        return [bloom](Scene&, View& view) {
            view.quality.shadows = ShadowFilter::Off;
            view.effects.bloom = bloom;
        };
    };
    all.push_back({ "bloom", file, blooming({}), blooming({ .enabled = true }) });
    all.push_back({ "bloom of strength 0", file, blooming({}), blooming({ .enabled = true, .strength = 0 }), true });
    const auto flaring = [](LensFlare const& flare) {
        return [flare](Scene&, View& view) {
            view.quality.shadows = ShadowFilter::Off;
            view.effects.lensFlare = flare;
        };
    };
    all.push_back({ "lens flare", file, flaring({}), flaring({ .enabled = true, .threshold = 0.5f }) });
    all.push_back({ "lens flare, nothing bright", file, flaring({}), flaring({ .enabled = true, .threshold = 1e4f }) });
    all.push_back({ "lens flare of strength 0", file, flaring({}),
                    flaring({ .enabled = true, .ghostStrength = 0, .haloStrength = 0 }), true });
}

void addAntiAliasing(std::vector<Pair>& all, const char* file) {
    const auto smoothed = [](AntiAliasing antiAliasing) {
        return [antiAliasing](Scene&, View& view) {
            view.quality.shadows = ShadowFilter::Off;
            view.quality.antiAliasing = antiAliasing;
        };
    };
    const auto off = smoothed(AntiAliasing::Off), taa = smoothed(AntiAliasing::Taa);
    all.push_back({ "fxaa", file, off, smoothed(AntiAliasing::Fxaa) });
    all.push_back({ "sraa", file, off, smoothed(AntiAliasing::Sraa) });
    all.push_back({ "taa", file, off, taa });
    all.push_back(
            { .name = "taa, and the model turns", .file = file, .plain = off, .effect = taa, .moving = Moving::Model });
}

void addResolutions(std::vector<Pair>& all, const char* file) {
    const auto drawn = [](Upscaling filter, AntiAliasing antiAliasing, float scale) {
        return [=](Scene&, View& view) {
            view.quality.shadows = ShadowFilter::Off;
            view.effects.resolution.upscaling = filter;
            view.quality.antiAliasing = antiAliasing;
            view.effects.resolution.scale = float2(scale);
        };
    };
    const auto off = drawn(Upscaling::Off, AntiAliasing::Off, 1);
    const auto filtered = [&](Upscaling filter, float scale) { return drawn(filter, AntiAliasing::Off, scale); };
    all.push_back({ "bilinear, half", file, off, filtered(Upscaling::Bilinear, 0.5f) });
    all.push_back({ "catmullRom, half", file, off, filtered(Upscaling::CatmullRom, 0.5f) });
    all.push_back({ "edgeAdaptive, half", file, off, filtered(Upscaling::EdgeAdaptive, 0.5f) });
    all.push_back({ "edgeAdaptive, two thirds", file, off, filtered(Upscaling::EdgeAdaptive, 0.67f) });
    all.push_back({ "taa of half the pixels", file, off, drawn(Upscaling::Off, AntiAliasing::Taa, 0.5f) });
    all.push_back({ "edgeAdaptive of all pixels", file, off, filtered(Upscaling::EdgeAdaptive, 1), true });
    all.push_back({ "sharpening", file, off, [](Scene&, View& view) {
                       view.quality.shadows = ShadowFilter::Off;
                       view.effects.sharpening.enabled = true;
                   } });
}

std::function<void(Scene&, View&)> withEffects(std::function<void(View&)> const& set) {
    return [set](Scene&, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        set(view);
    };
}

void addFinish(std::vector<Pair>& all, const char* file) {
    const auto plain = withEffects([](View&) {});
    const auto look = [](View& view) {
        view.effects.colorGrading = { .enabled = true, .temperature = 0.1f, .contrast = 1.1f, .saturation = 1.1f };
    };
    all.push_back({ "color grading", file, plain, withEffects(look) });
    all.push_back({ "grading by table32", file, plain, withEffects([look](View& view) {
                        look(view);
                        view.quality.toneMapping = ToneMapping::Table32;
                    }) });
    all.push_back({ "vignette", file, plain, withEffects([](View& view) { view.effects.vignette.enabled = true; }) });
    all.push_back({ "grain", file, plain, withEffects([](View& view) { view.effects.grain.enabled = true; }) });
    all.push_back({ "chromatic aberration", file, plain,
                    withEffects([](View& view) { view.effects.chromaticAberration.enabled = true; }) });
    all.push_back({ "auto exposure", file, plain,
                    withEffects([](View& view) { view.effects.autoExposure.enabled = true; }) });
    all.push_back({ "grading without a change", file, plain,
                    withEffects([](View& view) { view.effects.colorGrading.enabled = true; }), true });
    const auto focused = [](float meters, float scale) {
        return withEffects([=](View& view) {
            view.effects.depthOfField = { .enabled = true, .focusMeters = meters, .blurScale = scale };
            view.camera.exposure = { .aperture = 2.8f, .shutterSeconds = 1.0f / 4000 };
        });
    };
    const auto open =
            withEffects([](View& view) { view.camera.exposure = { .aperture = 2.8f, .shutterSeconds = 1.0f / 4000 }; });
    all.push_back({ "depth of field", file, open, focused(1.6f, 4) });
    all.push_back({ "depth of field, all in focus", file, open, focused(1.6f, 0.01f), true });
    const auto moving =
            withEffects([](View& view) { view.effects.motionBlur = { .enabled = true, .shutterDegrees = 360 }; });
    all.push_back({ .name = "motion blur, and the model turns",
                    .file = file,
                    .plain = withEffects([](View&) {}),
                    .effect = moving,
                    .moving = Moving::Model });
    all.push_back({ "motion blur, nothing moves", file, withEffects([](View&) {}), moving, true });
}

/// Time of a frame with all effects, against a plain one.
void addChain(std::vector<Pair>& all, const char* file) {
    const auto chain = [](uint8_t samples, BloomResolution bloom = BloomResolution::Half) {
        return [samples, bloom](Scene& scene, View& view) {
            scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
            view.samples = samples;
            view.effects.ambientOcclusion.enabled = true;
            view.effects.ambientOcclusion.method = AmbientOcclusionMethod::Sao;
            view.effects.ambientOcclusion.radiusMeters = 0.1f;
            view.effects.bloom.enabled = true;
            view.effects.bloom.resolution = bloom;
            view.quality.antiAliasing = AntiAliasing::Fxaa;
        };
    };
    const auto plain = withEffects([](View&) {});
    all.push_back({ "sun, pcf3, sao, bloom, fxaa", file, plain, chain(1) });
    all.push_back({ "the same with bloom.resolution=quarter", file, plain, chain(1, BloomResolution::Quarter) });
    all.push_back({ "the same with four samples", file, plain, chain(4) });
    all.push_back({ "four samples", file, plain, withEffects([](View& view) { view.samples = 4; }) });
}

/// Planes around the middle of the model, which is 1 m large. Six keep a box of 0.4 m.
void addSections(std::vector<Pair>& all, const char* file) {
    const auto cut = [](size_t planes, bool isLit) {
        return [planes, isLit](Scene& scene, View& view) {
            if (isLit) scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
            view.quality.shadows = isLit ? ShadowFilter::Pcf3 : ShadowFilter::Off;
            constexpr std::array kAxes{ double3(0, 0, 1), double3(0, 1, 0), double3(1, 0, 0) };
            for (size_t i = 0; i < planes; ++i) {
                const double3 inwards = i % 2 == 0 ? -kAxes[i / 2] : kAxes[i / 2];
                view.section.planes[i] = sectionPlane(inwards * -0.2, inwards);
            }
        };
    };
    struct Section {
        const char *plain, *lit;
        size_t planes;
    };
    constexpr Section kSections[] = { { "section of one plane", "section of one plane, and shadows", 1 },
                                      { "section of a slab", "section of a slab, and shadows", 2 },
                                      { "section of a box", "section of a box, and shadows", 6 } };
    for (auto const& [plain, lit, planes] : kSections) {
        all.push_back(
                { .name = plain, .file = file, .plain = cut(0, false), .effect = cut(planes, false), .isCut = true });
        all.push_back({ .name = lit, .file = file, .plain = cut(0, true), .effect = cut(planes, true), .isCut = true });
    }
}

/// What whole views of a model under a sun take, beside one with the defaults.
void addPresets(std::vector<Pair>& all, const char* file) {
    const auto sunlit = [](std::function<void(View&)> const& set) {
        return [set](Scene& scene, View& view) {
            scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 } });
            view.effects.ambientOcclusion.radiusMeters = 0.1f; // the model is 1 m large
            set(view);
        };
    };
    struct Preset {
        const char *still, *moving;
        RenderPreset preset;
    };
    constexpr Preset kPresets[] = {
        { "preset fast", "preset fast, and the camera moves", RenderPreset::Fast },
        { "preset balanced", "preset balanced, and the camera moves", RenderPreset::Balanced },
        { "preset fine", "preset fine, and the camera moves", RenderPreset::Fine },
        { "preset cinematic", "preset cinematic, and the camera moves", RenderPreset::Cinematic },
    };
    const auto plain = sunlit([](View&) {});
    for (auto const& [still, moving, preset] : kPresets) {
        const auto finished = sunlit([preset](View& view) { applyPreset(view, preset); });
        all.push_back({ .name = still, .file = file, .plain = plain, .effect = finished });
        all.push_back({ .name = moving, .file = file, .plain = plain, .effect = finished, .moving = Moving::Camera });
    }
}

} // namespace

std::function<void(Scene&, View&)> reflecting(bool isOn) {
    return [isOn](Scene&, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        view.effects.screenSpaceReflections = { .enabled = isOn, .distanceMeters = 2, .thicknessMeters = 0.1f };
    };
}

std::vector<Pair> effectPairs() {
    constexpr const char* kHelmet = "FlightHelmet/FlightHelmet.gltf";
    constexpr const char* kTokyo = "LittlestTokyo/LittlestTokyo.glb";
    std::vector<Pair> all;
    for (const char* file : { kHelmet, "ClearCoatTest/ClearCoatTest.glb", "SheenChair/SheenChair.gltf", kTokyo })
        all.push_back({ "shadows=pcf3", file, withSun(ShadowFilter::Off), withSun(ShadowFilter::Pcf3) });
    all.push_back({ "shadows=pcf3, three suns", kHelmet, withThreeSuns(ShadowFilter::Off),
                    withThreeSuns(ShadowFilter::Pcf3) });
    for (const ShadowFilter filter :
         { ShadowFilter::Hard, ShadowFilter::Pcf2, ShadowFilter::Pcf5, ShadowFilter::Poisson, ShadowFilter::Pcss,
           ShadowFilter::Vsm, ShadowFilter::Evsm })
        all.push_back({ toString(filter), kHelmet, withSun(ShadowFilter::Off), withSun(filter) });

    const auto nothing = [](Scene&, View& view) { view.quality.shadows = ShadowFilter::Off; };
    all.push_back({ "shadows, no light", kHelmet, nothing,
                    [](Scene&, View& view) { view.quality.shadows = ShadowFilter::Pcss; }, true });
    const auto castsNone = [](ShadowFilter filter) {
        return [filter](Scene& scene, View& view) {
            scene.add(SunLight{ .directionWorld = kSunDirection, .illuminance = Lux{ 60'000 }, .castsShadows = false });
            view.quality.shadows = filter;
        };
    };
    all.push_back({ "shadows, a sun that casts none", kHelmet, castsNone(ShadowFilter::Off),
                    castsNone(ShadowFilter::Evsm), true });
    all.push_back({ "lamps out of reach", kHelmet, nothing,
                    [](Scene& scene, View& view) {
                        view.quality.shadows = ShadowFilter::Off;
                        for (int i = 0; i < 200; ++i)
                            scene.add(PointLight{ .positionWorld = { 30 + i, 0, 0 }, .rangeMeters = 2 });
                    },
                    true });
    all.push_back({ "area lights out of reach", kHelmet, nothing,
                    [](Scene& scene, View& view) {
                        view.quality.shadows = ShadowFilter::Off;
                        scene.add(RectLight{ .positionWorld = { 50, 0, 0 }, .rangeMeters = 2 });
                    },
                    true });
    const auto refracting = [](RefractionSource source) {
        return [source](Scene&, View& view) { view.quality.refraction = source; };
    };
    all.push_back({ "refraction=screen", "TransmissionTest/TransmissionTest.glb",
                    refracting(RefractionSource::Environment), refracting(RefractionSource::Screen) });
    all.push_back({ "refraction, nothing asks", kHelmet, refracting(RefractionSource::Environment),
                    refracting(RefractionSource::Screen), true });
    const auto disc = [](bool shown) {
        return [shown](Scene& scene, View& view) {
            scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 60'000 }, .showsDisc = shown });
            view.quality.shadows = ShadowFilter::Off;
        };
    };
    all.push_back({ "a sun's disc behind the camera", kHelmet, disc(false), disc(true), true });
    const auto probes = [&](const char* name, std::vector<float> halfSides) {
        all.push_back(
                { .name = name, .file = kHelmet, .plain = nothing, .effect = nothing, .probes = std::move(halfSides) });
    };
    probes("reflection probe around everything", { 1.5f });
    probes("reflection probe in a part", { 0.1f });
    probes("two reflection probes in parts", { 0.1f, 0.15f });
    probes("four reflection probes in parts", { 0.09f, 0.11f, 0.13f, 0.15f });
    probes("eight reflection probes in parts", { 0.08f, 0.09f, 0.1f, 0.11f, 0.12f, 0.13f, 0.14f, 0.15f });
    addGridPairs(all, kHelmet);
    addFogPairs(all, kHelmet);
    addVolumetricFogPairs(all, kHelmet);
    addContactPairs(all, kHelmet);
    addOcclusion(all);
    addReflections(all, kHelmet);
    addBloom(all, kHelmet);
    addAntiAliasing(all, kHelmet);
    addFinish(all, kHelmet);
    addResolutions(all, kHelmet);
    addChain(all, kHelmet);
    addPresets(all, kHelmet);
    addSections(all, kHelmet);
    return all;
}

} // namespace filament_core::bench
