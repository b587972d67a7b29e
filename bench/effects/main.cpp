// SPDX-License-Identifier: Apache-2.0
// effects_bench [--frames N] [--size WxH] [--only TEXT] [--unseen] [--json FILE]: the cost of effects where they are
// visible, and that invisible ones cost nothing. Both frames of a pair are drawn in turns, first one,
// then the other first, and the ratio is that of each pair: its median, and the interval in which the true median lies
// with 95 % certainty. What cannot be seen must have the same bits, the same draws and the same passes, or the program
// fails. The last line is the time of a pass that fetches one texel a pixel: the lower bound of all full-screen passes.
#include "base/Statistics.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

namespace {

using namespace filament_core;
using Clock = std::chrono::steady_clock;

struct Options {
    int frames = 48;
    uint2 size{ 1280, 720 };
    std::filesystem::path assets;
};

enum class Moving { Nothing, Model, Camera }; ///< the model turns by a degree a frame, the camera goes 2 mm

/// A model under a light, and the two views or scenes that are compared.
struct Pair {
    std::string name{}; ///< empty: passes are timed
    const char* file = nullptr;
    std::function<void(Scene&, View&)> plain{};  ///< the frame to compare with
    std::function<void(Scene&, View&)> effect{}; ///< the scene with the effect
    bool isUnseen = false;
    bool hasMirror = false; ///< a floor with screen-space reflections
    bool hasProbe = false;  ///< the effect is a reflection probe around the model
    Moving moving = Moving::Nothing;
};

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

auto reflecting(bool isOn) {
    return [isOn](Scene&, View& view) {
        view.quality.shadows = ShadowFilter::Off;
        view.effects.screenSpaceReflections = { .enabled = isOn, .distanceMeters = 2, .thicknessMeters = 0.1f };
    };
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

std::vector<Pair> pairs() {
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
    all.push_back(
            { .name = "reflection probe", .file = kHelmet, .plain = nothing, .effect = nothing, .hasProbe = true });
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
    return all;
}

struct Measured {
    double median = 0, low = 0, high = 0; ///< of the ratio
    double milliseconds = 0;              ///< of the plain frame
    bool isSame = false;                  ///< bits, draws and passes
};

/// What both frames of a pair show.
struct Subject {
    Model model;
    Environment environment;
    std::optional<tools::MaterialStand> mirror;
};

double4x4 belowModel() {
    return glm::scale(glm::translate(double4x4(1.0), double3(0, -0.52, 0)), double3(1.5, 0.02, 1.5));
}

/// One of the two frames.
class Side {
public:
    Side(Engine& engine, Subject const& subject, Pair const& pair, std::function<void(Scene&, View&)> const& set,
         uint2 size)
            : mEngine(engine), mScene(engine), mRenderer(engine, { .passTimers = pair.name.empty() }),
              mMoving(pair.moving), mPlace(fitToUnitCube(subject.model.bounds())) {
        mRoot = mScene.add(subject.model, mPlace);
        mScene.setEnvironment(subject.environment);
        if (subject.mirror) subject.mirror->addTo(mScene, belowModel());
        mView.size = size;
        lookFrom({ 0.9, 0.6, 1.5 });
        set(mScene, mView);
        mTarget = engine.own(engine.create(SwapChainDesc{ .size = size, .name = "bench" }));
    }
    double draw() {
        ++mDrawn;
        if (mMoving == Moving::Model)
            mScene.setTransform(mRoot, glm::rotate(mPlace, 0.0175 * mDrawn, double3(0, 1, 0)));
        if (mMoving == Moving::Camera) lookFrom({ 0.9 + 0.002 * mDrawn, 0.6, 1.5 });
        const auto begin = Clock::now();
        mRenderer.render(mScene, mView, mTarget);
        mEngine.waitIdle();
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }
    /// With the light of the environment, around the model.
    void addProbe(Environment const& light) {
        mScene.add(ReflectionProbeDesc{ .halfExtentMeters = float3(1.5f), .light = light.indirectLight() });
    }
    Result<Image> picture() { return mRenderer.renderToImage(mScene, mView); }
    Renderer const& renderer() const { return mRenderer; }
    std::vector<FrameTimings> takeTimings() { return mRenderer.takeTimings(); }

private:
    void lookFrom(double3 eye) { mView.camera = Camera::lookAt(eye, { 0, 0, 0 }, { .verticalFovDegrees = 40 }); }

    Engine& mEngine;
    Scene mScene;
    Renderer mRenderer;
    View mView;
    Owned<SwapChain> mTarget;
    Moving mMoving;
    double4x4 mPlace;
    Node mRoot;
    int mDrawn = 0;
};

bool haveSameFrames(Side& a, Side& b) {
    const Result<Image> first = a.picture(), second = b.picture();
    const auto before = a.renderer().statistics(), after = b.renderer().statistics();
    return first && second && first->pixels == second->pixels && before.draws == after.draws &&
           before.passesRun == after.passesRun;
}

Result<tools::MaterialStand> makeMirror(Engine& engine) {
    const auto file = tools::readMaterialFile(tools::sourceDir() / "samples/materials/reflections_screen.mat");
    if (!file) return file.error();
    return tools::MaterialStand::make(engine, **file, {}, "box");
}

Result<Subject> load(Engine& engine, Pair const& pair, Options const& options) {
    auto environment = loadEnvironment(engine, options.assets / "environments" / "studio_small_03_1k.hdr");
    if (!environment) return environment.error();
    auto model = loadGltf(engine, options.assets / "models" / pair.file);
    if (!model) return model.error();
    Subject subject{ std::move(*model), std::move(*environment), {} };
    if (pair.hasMirror) {
        auto mirror = makeMirror(engine);
        if (!mirror) return mirror.error();
        subject.mirror.emplace(std::move(*mirror));
    }
    return subject;
}

Result<Measured> measure(Backend backend, Pair const& pair, Options const& options) {
    auto engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    const auto subject = load(*engine, pair, options);
    if (!subject) return subject.error();
    Side plain(*engine, *subject, pair, pair.plain, options.size);
    Side effect(*engine, *subject, pair, pair.effect, options.size);
    if (pair.hasProbe) effect.addProbe(subject->environment);
    Measured measured;
    measured.isSame = haveSameFrames(plain, effect);
    std::vector<double> ratios, times;
    for (int i = -2; i < options.frames; ++i) {
        const bool isPlainFirst = i % 2 == 0;
        const double first = (isPlainFirst ? plain : effect).draw(), second = (isPlainFirst ? effect : plain).draw();
        if (i < 0) continue;
        times.push_back(1e3 * (isPlainFirst ? first : second));
        ratios.push_back(isPlainFirst ? second / first : first / second);
    }
    std::ranges::sort(ratios);
    std::ranges::sort(times);
    const size_t count = ratios.size(), middle = count / 2;
    const auto reach = static_cast<size_t>(std::ceil(0.98 * std::sqrt(static_cast<double>(count)))); // binomial, 95 %
    measured.median = ratios[middle];
    measured.low = ratios[middle > reach ? middle - reach : 0];
    measured.high = ratios[std::min(middle + reach, count - 1)];
    measured.milliseconds = times[middle];
    return measured;
}

/// Device time of the pass that makes distances of depths: one fetch and a few operations a pixel.
Result<double> millisecondsOfOneFetch(Backend backend, Options const& options) {
    const Pair pair{ .file = "FlightHelmet/FlightHelmet.gltf", .hasMirror = true }; // reflections read distances
    auto engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    const auto subject = load(*engine, pair, options);
    if (!subject) return subject.error();
    Side side(*engine, *subject, pair, reflecting(true), options.size);
    for (int i = 0; i < options.frames; ++i) side.draw();
    std::vector<double> times;
    for (FrameTimings const& frame : side.takeTimings()) {
        for (PassTiming const& pass : frame.passes)
            if (pass.name == "distances") times.push_back(pass.gpuMilliseconds);
    }
    if (times.empty()) return Error{ ErrorCode::NotFound, "no frame had a pass 'distances'" };
    return median(std::move(times));
}

void print(Pair const& pair, Backend backend, Measured const& m) {
    std::printf("%-40s %-32s %-7s %8.1f   %6.3f  [%.3f, %.3f]%s\n", pair.name.c_str(), pair.file, toString(backend),
                m.milliseconds, m.median, m.low, m.high,
                !pair.isUnseen ? ""
                : m.isSame     ? "  same"
                               : "  DIFFERENT");
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    filament_core::tools::CommandLine app("What effects cost where they are seen, and where they are not");
    Options options{ .assets = tools::assetDir() };
    std::string size = "1280x720", json, only;
    bool isUnseenOnly = false;
    app.option("--frames", options.frames, "pairs of frames a measurement").inRange(4, 10'000);
    app.option("--size", size, "WxH in pixels");
    app.option("--assets", options.assets, "directory with models/ and environments/");
    app.option("--only", only, "pairs whose names contain this");
    app.flag("--unseen", isUnseenOnly, "only effects that the scene cannot show");
    app.option("--json", json, "also write the figures to this file");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    if (std::sscanf(size.c_str(), "%ux%u", &options.size.x, &options.size.y) != 2 || options.size.x == 0 ||
        options.size.y == 0) {
        std::fprintf(stderr, "effects_bench: error: --size wants WxH, got '%s'\n", size.c_str());
        return 1;
    }
    nlohmann::json report = nlohmann::json::array();
    bool isGood = true;
    std::printf("%-40s %-32s %-7s %8s   %s\n", "effect", "model", "api", "plain ms", "ratio");
    for (Pair const& pair : pairs()) {
        if (pair.name.find(only) == std::string::npos) continue;
        if (isUnseenOnly && !pair.isUnseen) continue;
        for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
            const Result<Measured> measured = measure(backend, pair, options);
            if (!measured) {
                std::fprintf(stderr, "effects_bench: error: %s\n", measured.error().message.c_str());
                return 1;
            }
            print(pair, backend, *measured);
            isGood = isGood && (!pair.isUnseen || measured->isSame);
            report.push_back({ { "effect", pair.name },
                               { "model", pair.file },
                               { "api", toString(backend) },
                               { "plainMs", measured->milliseconds },
                               { "ratio", measured->median },
                               { "interval", { measured->low, measured->high } } });
        }
    }
    if (!json.empty()) std::ofstream(json) << report.dump(2) << '\n';
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        const Result<double> floor = millisecondsOfOneFetch(backend, options);
        if (!floor) {
            std::fprintf(stderr, "effects_bench: error: %s\n", floor.error().message.c_str());
            return 1;
        }
        std::printf("one fetch a pixel, %s: %.2f ms\n", toString(backend), *floor);
    }
    return isGood ? 0 : 1;
}
