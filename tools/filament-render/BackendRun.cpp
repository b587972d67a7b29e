// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/BackendRun.h"

#include "base/Statistics.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/materials/PictureFile.h"
#include "toolkit/materials/PlainMaterials.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/Console.h"
#include "tools/filament-render/GltfFile.h"
#include "tools/filament-render/HeapCounter.h"

#include <filament_core/Animator.h>
#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/Primitives.h>
#include <filament_core/RenderAovs.h>
#include <filament_core/Scene.h>
#include <filament_core/Sky.h>
#include <filament_core/TextureStreaming.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace filament_core::tools {
namespace {

constexpr uint32_t kCostRounds = 31;
constexpr uint32_t kBudgetFrames = 7; // their median is the time of a frame

class StopWatch {
public:
    double milliseconds() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - mStart).count();
    }
    /// Milliseconds since construction.
    double lap() {
        const double elapsed = milliseconds();
        mStart = std::chrono::steady_clock::now();
        return elapsed;
    }

private:
    std::chrono::steady_clock::time_point mStart = std::chrono::steady_clock::now();
};

LoadProgress progressOf(Backend backend, const char* what) {
    return [=](std::string_view stage, size_t done, size_t total) {
        showProgress(fmt::format("{}: {}, {} {}/{}", fileStem(backend), what, stage, done, total));
    };
}

Format formatOf(PictureFormat picture) {
    return picture == PictureFormat::Exr     ? Format::RGBA16F
           : picture == PictureFormat::Png16 ? Format::RGB10A2
                                             : Format::RGBA8;
}

View viewOf(Options const& options) {
    View view = options.view;
    view.camera = cameraOf(options);
    view.timeSeconds = options.seconds.value_or(0);
    return view;
}

Result<Engine> createEngine(Options const& options, Backend backend) {
    EngineOptions engineOptions = engineOptionsOf(options);
    engineOptions.backend = backend;
    if (options.trace) engineOptions.traceFile = options.out / fmt::format("{}.trace", fileStem(backend));
    Result<Engine> engine = Engine::create(engineOptions);
    if (!engine) return engine;
    const uint32_t largest = engine->device().maxTextureSize;
    if (options.view.size.x > largest || options.view.size.y > largest) {
        return fail(ErrorCode::Unsupported, "--size {}x{}: {} draws at most {} pixels a side; give a smaller size",
                    options.view.size.x, options.view.size.y, engine->device().device, largest);
    }
    return engine;
}

/// Positions of the copies: a square grid in the xz plane, scaled to the size of a single copy.
std::vector<double4x4> placesOf(uint32_t copies, double4x4 const& worldFromModel) {
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(copies)));
    const double cell = 1.0 / side;
    std::vector<double4x4> places;
    for (uint32_t i = 0; i < copies; ++i) {
        const double3 offset((i % side + 0.5) * cell - 0.5, 0, (i / side + 0.5) * cell - 0.5);
        double4x4 grid(cell);
        grid[3] = double4(copies > 1 ? offset : double3(0.0), 1);
        places.push_back(grid * worldFromModel);
    }
    return places;
}

/// The animation that the command line selects; without one, the model stays at rest.
Result<std::optional<uint32_t>> animationOf(Options const& options, Model const& model) {
    const uint32_t count = model.animationCount();
    if (options.animation.empty()) {
        return options.seconds && count > 0 ? std::optional<uint32_t>(0) : std::optional<uint32_t>();
    }
    if (count > 0) {
        const auto index = wholeNumber(options.animation, 0, count - 1);
        if (index) return std::optional(*index);
    }
    const Result<uint32_t> named = model.findAnimation(options.animation);
    if (!named) return fail(named.error().code, "--animation {}: {}", options.animation, named.error().message);
    return std::optional(*named);
}

/// Everything between a running engine and its first image, in the order in which it must be destroyed.
class Stage {
public:
    Stage(Engine& engine, Options const& options)
            : mEngine(engine), mOptions(options), mScene(engine), mRenderer(engine, { .passTimers = true }) {}

    Result<void> load(BackendRun& run, std::filesystem::path const& model, std::filesystem::path const& environment);
    /// With --budget: measures frames with the requested settings, and continues with the settings that fit.
    Result<void> fitBudget(BackendRun& run);
    Result<void> drawAovs(BackendRun& run);
    Result<void> drawShares(BackendRun& run);
    Result<void> measureCosts(BackendRun& run);
    Result<void> saveScene(std::filesystem::path const& environment) const {
        return saveGltfFile(mOptions, mEngine.device().backend, mScene, mView.camera, environment.string());
    }
    void drawFirst(BackendRun& run);
    void drawOthers(BackendRun& run);
    Result<Image> readPixels() { return mRenderer.waitPixels(mRenderer.readPixels(mTarget)); }
    Renderer& renderer() { return mRenderer; }

private:
    Engine& mEngine;
    Options const& mOptions;
    Result<void> loadMaterial(BackendRun& run, std::filesystem::path const& path);
    Result<void> loadModel(BackendRun& run, std::filesystem::path const& path);
    Result<void> loadSky(BackendRun& run, std::filesystem::path const& path);
    Result<void> computeSky(BackendRun& run, EnvironmentSettings const& settings);
    Result<void> loadDirt();
    void pose(double seconds);
    /// Draws it as it was a frame ago, from which motion counts.
    Result<void> drawPrevious(Renderer& numbers);
    Result<void> addGround(double level);

    std::optional<MaterialStand> mMaterial; ///< instead of a model
    std::optional<Model> mModel;
    std::vector<Node> mCopies; ///< of it
    std::vector<Animator> mAnimators;
    std::optional<uint32_t> mAnimation;
    std::optional<Environment> mEnvironment;
    std::optional<Fog> mSkyFog;
    Owned<Material> mCatcher;
    Owned<MaterialInstance> mShadows;
    Owned<VertexBuffer> mGroundVertices;
    Owned<IndexBuffer> mGroundIndices;
    Owned<Texture> mPixels, mDirt;
    Owned<RenderTarget> mTarget;
    Scene mScene;
    Renderer mRenderer;
    View mView;
};

Result<void> Stage::loadMaterial(BackendRun& run, std::filesystem::path const& path) {
    const auto file = readMaterialFile(path);
    if (!file) return file.error();
    Result<MaterialStand> stand = MaterialStand::make(mEngine, **file, mOptions.values);
    if (!stand) return stand.error();
    mMaterial.emplace(std::move(*stand));
    run.modelName = (*file)->name;
    const Box bounds{ double3(-1), double3(1) };
    const double4x4 worldFromMaterial = mOptions.fit ? fitToUnitCube(bounds) : double4x4(1.0);
    for (double4x4 const& place : placesOf(mOptions.copies, worldFromMaterial)) mMaterial->addTo(mScene, place);
    return {};
}

Result<void> Stage::loadModel(BackendRun& run, std::filesystem::path const& path) {
    GltfLoadOptions modelOptions = mOptions.modelOptions;
    modelOptions.simplified |= mOptions.view.lod.pixels > 0;
    modelOptions.sectionPlanes |= mOptions.view.section.isUsed();
    modelOptions.progress = progressOf(run.backend, "model");
    Result<Model> loaded = loadGltf(mEngine, path, modelOptions);
    if (!loaded) return loaded.error();
    mModel.emplace(std::move(*loaded));
    run.modelName = mModel->name();
    run.warnings = mModel->warnings();
    const double4x4 worldFromModel = mOptions.fit ? fitToUnitCube(mModel->bounds()) : double4x4(1.0);
    const Result<std::optional<uint32_t>> animation = animationOf(mOptions, *mModel);
    if (!animation) return animation.error();
    mAnimation = *animation;
    for (double4x4 const& place : placesOf(mOptions.copies, worldFromModel)) {
        const Node copy = mCopies.emplace_back(mScene.add(*mModel, place));
        if (mAnimation) mAnimators.emplace_back(*mModel, mScene, copy);
        if (mOptions.variant.empty()) continue;
        if (const Result<void> done = mScene.setVariant(copy, mOptions.variant); !done) return done.error();
    }
    pose(mOptions.seconds.value_or(0));
    return {};
}

void Stage::pose(double seconds) {
    for (Animator& animator : mAnimators) animator.apply(*mAnimation, seconds);
}

/// Takes the shadows of what stands on it.
Result<void> Stage::addGround(double level) {
    const Box around = mScene.bounds();
    const double3 size = around.max - around.min;
    const auto side = static_cast<float>(8 * std::max({ size.x, size.y, size.z }));
    const Result<Mesh> plane = makePlane({ .width = side, .depth = side });
    if (!plane) return plane.error();
    Result<Material> catcher = createBuiltInMaterial(mEngine, "litShadowCatcher");
    if (!catcher) return catcher.error();
    mCatcher = mEngine.own(*catcher);
    mShadows = mEngine.own(mEngine.createInstance(mCatcher));
    mGroundVertices = mEngine.own(mEngine.create(plane->vertexBuffer()));
    mGroundIndices = mEngine.own(mEngine.create(plane->indexBuffer()));
    const double3 middle = (around.min + around.max) * 0.5;
    double4x4 world(1.0);
    world[3] = double4(middle.x, level, middle.z, 1);
    mScene.add(RenderableDesc{ .vertices = mGroundVertices,
                               .indices = mGroundIndices,
                               .material = mShadows,
                               .bounds = plane->bounds(),
                               .worldFromObject = world,
                               .castsShadows = false });
    return {};
}

/// Its fog takes the place of the view's.
Result<void> Stage::computeSky(BackendRun& run, EnvironmentSettings const& settings) {
    Result<Environment> sky = filament_core::loadSky(mEngine, *mOptions.sky, mOptions.environmentOptions);
    if (!sky) return fail(sky.error().code, "--sky: {}", sky.error().message);
    mEnvironment.emplace(std::move(*sky));
    run.lights = mEnvironment->lights();
    mScene.setEnvironment(*mEnvironment, settings);
    if (!mOptions.skyFog) return {};
    Result<Fog> fog = skyFog(mEngine, *mOptions.sky);
    if (!fog) return fail(fog.error().code, "--sky-fog: {}", fog.error().message);
    mSkyFog = std::move(*fog);
    return {};
}

Result<void> Stage::loadSky(BackendRun& run, std::filesystem::path const& path) {
    const double level = mScene.bounds().min.y;
    const EnvironmentSettings settings{ .illuminance = mOptions.iblIntensity,
                                        .skybox = mOptions.skybox,
                                        .groundHeightMeters = mOptions.groundHeightMeters,
                                        .groundLevelMeters = static_cast<float>(level) };
    if (settings.groundHeightMeters > 0) {
        if (const Result<void> added = addGround(level); !added) return added;
    }
    if (mOptions.sky) return computeSky(run, settings);
    Environment const* own = mModel ? mModel->environment() : nullptr;
    run.usesModelEnvironment = own && mOptions.environment.empty();
    if (run.usesModelEnvironment) {
        mScene.setEnvironment(*own, settings);
    } else if (!path.empty()) {
        EnvironmentLoadOptions environmentOptions = mOptions.environmentOptions;
        environmentOptions.progress = progressOf(run.backend, "environment");
        Result<Environment> sky = loadEnvironment(mEngine, path, environmentOptions);
        if (!sky) return sky.error();
        mEnvironment.emplace(std::move(*sky));
        run.lights = mEnvironment->lights();
        mScene.setEnvironment(*mEnvironment, settings);
    }
    return {};
}

Result<void> Stage::load(BackendRun& run, std::filesystem::path const& model,
                         std::filesystem::path const& environment) {
    StopWatch watch;
    const Result<void> shown = isMaterialFile(model) ? loadMaterial(run, model) : loadModel(run, model);
    if (!shown) return shown;
    run.start.model = watch.lap();

    if (const Result<void> lit = loadSky(run, environment); !lit) return lit;
    run.start.environment = watch.lap();

    if (mOptions.sun) mScene.add(*mOptions.sun);
    const Format format = formatOf(mOptions.format);
    mPixels = mEngine.own(mEngine.create(TextureDesc{ .format = format,
                                                      .width = mOptions.view.size.x,
                                                      .height = mOptions.view.size.y,
                                                      .renderable = true,
                                                      .name = "pixels" }));
    mTarget = mEngine.own(mEngine.create(RenderTargetDesc{ .color = mPixels, .name = "pixels" }));
    mView = viewOf(mOptions);
    if (mSkyFog) mView.effects.fog = *mSkyFog;
    for (const Node copy : mCopies) ModelCopy::of(mScene, copy)->chooseLevels(mView);
    return loadDirt();
}

/// Of the lens.
Result<void> Stage::loadDirt() {
    if (mOptions.dirt.empty()) return {};
    Result<Owned<Texture>> dirt = loadPictureTexture(mEngine, mOptions.dirt);
    if (!dirt) return fail(dirt.error().code, "--set bloom.dirt: {}", dirt.error().message);
    mDirt = std::move(*dirt);
    mView.effects.bloom.dirt = mDirt;
    return {};
}

Result<void> Stage::fitBudget(BackendRun& run) {
    if (!mOptions.budgetMilliseconds) return {};
    Result<QualityCosts> costs = mOptions.costs.empty() ? defaultQualityCosts() : loadQualityCosts(mOptions.costs);
    if (!costs) return costs.error();
    showProgress(fmt::format("{}: frames to fit the budget", fileStem(run.backend)));
    View view = mView;
    view.quality = {}; // the base of the table's ratios
    for (uint32_t frame = 0; frame <= kBudgetFrames; ++frame) {
        mRenderer.render(mScene, view, mTarget.get());
        mEngine.waitIdle();
    }
    std::vector<double> milliseconds;
    for (FrameTimings const& frame : mRenderer.takeTimings()) milliseconds.push_back(frame.gpuMilliseconds);
    if (!milliseconds.empty()) milliseconds.erase(milliseconds.begin()); // the first frame compiles and uploads
    Result<QualityDecision> decision = chooseQuality({ .gpuMilliseconds = *mOptions.budgetMilliseconds,
                                                       .size = mOptions.view.size,
                                                       .backend = run.backend,
                                                       .frameMilliseconds = median(std::move(milliseconds)) },
                                                     *costs, mOptions.view.quality);
    if (!decision) return decision.error();
    mView.quality = decision->quality;
    run.decision = std::move(*decision);
    return {};
}

Result<void> Stage::drawPrevious(Renderer& numbers) {
    View view = mView;
    view.debugView = DebugView::None;
    view.camera.worldFromView = Camera::lookAt(mOptions.previousEye, mOptions.previousAt).worldFromView;
    view.timeSeconds -= 1 / mOptions.framesPerSecond;
    pose(view.timeSeconds);
    const Result<std::vector<Image>> drawn = renderAovs(numbers, mScene, view, std::array{ Aov::Motion });
    pose(mView.timeSeconds);
    return drawn ? Result<void>{} : Result<void>(drawn.error());
}

Result<void> Stage::drawAovs(BackendRun& run) {
    if (mOptions.aovs.empty()) return {};
    showProgress(fmt::format("{}: AOVs", fileStem(run.backend)));
    View view = mView;
    view.debugView = DebugView::None;
    Renderer numbers(mEngine);
    if (std::ranges::find(mOptions.aovs, Aov::Motion) != mOptions.aovs.end())
        if (const Result<void> drawn = drawPrevious(numbers); !drawn) return drawn;
    Result<std::vector<Image>> aovs = renderAovs(numbers, mScene, view, mOptions.aovs);
    if (!aovs) return aovs.error();
    run.aovs = std::move(*aovs);
    return {};
}

Result<void> Stage::drawShares(BackendRun& run) {
    View view = mView;
    view.debugView = DebugView::None;
    ShareOptions shares{ .frames = std::min(mOptions.frames, ShareOptions::kMostFrames) };
    if (mOptions.shares) {
        showProgress(fmt::format("{}: shares", fileStem(run.backend)));
        shares.terms = *mOptions.shares;
        Result<Shares> drawn = renderShares(mEngine, mScene, view, shares);
        if (!drawn) return drawn.error();
        run.shares = std::move(*drawn);
    }
    if (!mOptions.explainPixel) return {};
    showProgress(fmt::format("{}: explaining a pixel", fileStem(run.backend)));
    shares.terms = ShareTerms::All;
    Result<PixelExplanation> explained = explainPixel(mEngine, mScene, view, *mOptions.explainPixel, shares);
    if (!explained) return explained.error();
    run.explained = std::move(*explained);
    return {};
}

Result<void> Stage::measureCosts(BackendRun& run) {
    if (mOptions.measureCosts.empty()) return {};
    showProgress(fmt::format("{}: measuring quality choices", fileStem(run.backend)));
    View view = mView;
    view.quality = {};
    Result<QualityCosts> costs = measureQualityCosts(mEngine, mScene, view, { .rounds = kCostRounds });
    if (!costs) return costs.error();
    run.costs = std::move(*costs);
    return {};
}

void Stage::drawFirst(BackendRun& run) {
    showProgress(fmt::format("{}: first frame", fileStem(run.backend)));
    const StopWatch watch;
    mRenderer.render(mScene, mView, mTarget.get());
    mEngine.waitIdle();
    run.start.firstFrame = watch.milliseconds();
    // Streamed textures arrive with later frames: what is measured and stored shows all of them.
    while (waitForTextures(mEngine)) mRenderer.render(mScene, mView, mTarget.get());
    run.afterFirstFrame = mEngine.statistics();
}

void Stage::drawOthers(BackendRun& run) {
    run.samples.resize(mOptions.frames - 1);
    size_t frame = 1;
    const StopWatch whole;
    StopWatch watch;
    uint64_t allocations = heapAllocations();
    for (FrameSample& sample : run.samples) {
        mRenderer.render(mScene, mView, mTarget.get());
        const uint64_t now = heapAllocations();
        sample = { .milliseconds = watch.lap(), .heapAllocations = now - std::exchange(allocations, now) };
        if (++frame % 64 == 0)
            showProgress(fmt::format("{}: frame {}/{}", fileStem(run.backend), frame, mOptions.frames));
    }
    mEngine.waitIdle();
    if (!run.samples.empty())
        run.pipelinedMilliseconds = whole.milliseconds() / static_cast<double>(run.samples.size());
    run.atEnd = mEngine.statistics();
}

// With several backends the file name includes the backend: jobs.json -> jobs.vulkan.json, jobs.gles.json.
std::filesystem::path traceFileOf(Options const& options, Backend backend) {
    if (options.backends.size() == 1) return options.traceJobs;
    std::filesystem::path path = options.traceJobs;
    const std::string extension = path.extension().string();
    return path.replace_extension(fileStem(backend) + extension);
}

} // namespace

const char* fileStem(Backend backend) {
    return backend == Backend::Vulkan ? "vulkan" : backend == Backend::Gles ? "gles" : "null";
}

EngineOptions engineOptionsOf(Options const& options) {
    EngineOptions engineOptions{ .requireDevice = options.requireDevice };
    engineOptions.workers = options.workers;
    engineOptions.affinity = options.affinity;
    engineOptions.driverCore = options.driverCore;
    engineOptions.repinAfterWaits = options.repinAfterWaits;
    engineOptions.exactShaders = options.exactShaders;
    engineOptions.debug.plainMaterials = &tools::plainMaterial;
    engineOptions.traceJobs = !options.traceJobs.empty();
    return engineOptions;
}

Result<Image> drawPicture(Engine& engine, Options const& options, std::filesystem::path const& model,
                          std::filesystem::path const& environment) {
    BackendRun run{ .backend = engine.device().backend };
    Stage stage(engine, options);
    if (const Result<void> loaded = stage.load(run, model, environment); !loaded) return loaded.error();
    stage.drawFirst(run);
    stage.drawOthers(run);
    return stage.readPixels();
}

Result<BackendRun> runBackend(Options const& options, Backend backend, std::filesystem::path const& model,
                              std::filesystem::path const& environment) {
    BackendRun run{ .backend = backend };
    const StopWatch whole;
    Result<Engine> engine = createEngine(options, backend);
    if (!engine) return engine.error();
    run.device = engine->device();
    run.start.engine = whole.milliseconds();

    Stage stage(*engine, options);
    if (const Result<void> loaded = stage.load(run, model, environment); !loaded) return loaded.error();
    if (const Result<void> fitted = stage.fitBudget(run); !fitted) return fitted.error();
    stage.drawFirst(run);
    run.start.startToFirstFrame = whole.milliseconds();
    stage.drawOthers(run);

    Result<Image> image = stage.readPixels();
    if (!image) return image.error();
    run.image = std::move(*image);
    if (Result<void> drawn = stage.drawAovs(run); !drawn) return drawn.error();
    if (Result<void> drawn = stage.drawShares(run); !drawn) return drawn.error();
    if (Result<void> saved = stage.saveScene(environment); !saved) return saved.error();
    run.timings = stage.renderer().takeTimings();
    run.statistics = stage.renderer().statistics();
    run.explanation = stage.renderer().explain();
    run.decisions = stage.renderer().decisions();
    if (const Result<void> measured = stage.measureCosts(run); !measured) return measured.error();
    run.errors = engine->takeErrors();
    if (!options.traceJobs.empty()) {
        if (const Result<void> traced = engine->writeJobTrace(traceFileOf(options, backend)); !traced)
            return traced.error();
    }
    return run;
}

} // namespace filament_core::tools
