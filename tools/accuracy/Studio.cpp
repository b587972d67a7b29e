// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Studio.h"

#include <chrono>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;
using tools::SceneSpec;

// Timed loads put their baked environments here; the folder is removed before each load.
fs::path cacheOf(tools::SceneFolders const& folders) { return folders.work / "environments"; }

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

Settings settingsOf(SceneSpec const& spec) {
    Settings settings;
    settings.view = spec.view;
    return settings;
}

Take::Take(Engine& engine, Renderer& renderer, TakeParts parts)
        : mEngine(engine), mRenderer(renderer), mParts(std::move(parts)) {}

Result<void> Take::checkDevice() {
    const std::vector<std::string> errors = mEngine.takeErrors();
    if (errors.empty()) return {};
    return fail(ErrorCode::DeviceLost, "the device reported: {}", errors.front());
}

Result<Picture> Take::shoot() {
    for (uint32_t i = mParts.frames; i-- > 1;) {
        View before = mParts.view;
        before.camera.worldFromView[3] -= double4(mParts.cameraMoves * static_cast<double>(i), 0);
        mRenderer.render(mParts.shown.scene, before, mParts.target);
    }
    mRenderer.render(mParts.shown.scene, mParts.view, mParts.target);
    const Result<Image> image = mRenderer.waitPixels(mRenderer.readPixels(mParts.target));
    if (!image) return image.error();
    if (const Result<void> fine = checkDevice(); !fine) return fine.error();
    mRenderer.takeTimings();
    return pictureOf(*image);
}

// The first frame is not timed: what the renderer keeps from frame to frame, shadow maps and the scene colour history,
// is that of another take.
Result<double> Take::time() {
    for (int i = 0; i < 2; ++i) mRenderer.render(mParts.shown.scene, mParts.view, mParts.target);
    mEngine.waitIdle();
    const std::vector<FrameTimings> timings = mRenderer.takeTimings();
    if (const Result<void> fine = checkDevice(); !fine) return fine.error();
    if (timings.empty() || !(timings.back().gpuMilliseconds > 0))
        return fail(ErrorCode::Unsupported, "{}: the device does not time its passes", mEngine.device().device);
    return timings.back().gpuMilliseconds;
}

struct Studio::Equipment {
    Equipment(Engine made, SceneFolders const& folders)
            : engine(std::move(made)), renderer(engine, { .passTimers = true }),
              loader(engine, folders, SceneLoader::Keep::All) {}

    Engine engine;
    Renderer renderer;
    SceneLoader loader;
};

Studio::Studio(Backend backend, tools::SceneFolders const& folders, std::shared_ptr<Bakes> bakes)
        : mBackend(backend), mFolders(folders), mBakes(bakes ? std::move(bakes) : std::make_shared<Bakes>()) {}
Studio::~Studio() = default;

Result<std::unique_ptr<Studio>> Studio::open(Backend backend, tools::SceneFolders const& folders,
                                             std::shared_ptr<Bakes> bakes) {
    std::unique_ptr<Studio> studio(new Studio(backend, folders, std::move(bakes)));
    const Result<Equipment*> first = studio->equipment({});
    if (!first) return first.error();
    studio->mDevice = (*first)->engine.device();
    return studio;
}

Result<Studio::Equipment*> Studio::equipment(Settings const& settings) {
    std::unique_ptr<Equipment>& known = mEquipment[settings.engineKey];
    if (!known) {
        EngineOptions options = settings.engine;
        options.backend = mBackend;
        options.cacheDirectory = cacheOf(mFolders);
        Result<Engine> engine = Engine::create(options);
        if (!engine) return engine.error();
        known = std::make_unique<Equipment>(std::move(*engine), mFolders);
    }
    return known.get();
}

Result<std::unique_ptr<Take>> Studio::take(SceneSpec const& named, Settings const& settings, uint2 size, bool linear) {
    const Result<SceneSpec const*> baked = mBakes->bake(named, settings.bake, mFolders);
    if (!baked) return baked.error();
    SceneSpec const& spec = **baked;
    const Result<Equipment*> used = equipment(settings);
    if (!used) return used.error();
    Engine& engine = (*used)->engine;
    GltfLoadOptions model = settings.model;
    model.simplified |= settings.view.lod.pixels > 0;
    Result<ShownScene> shown = (*used)->loader.show(spec, model, settings.environment);
    if (!shown) return shown.error();
    TakeParts parts{ .shown = std::move(*shown), .view = spec.view };
    View& view = parts.view;
    view.size = size;
    view.quality = settings.view.quality;
    view.effects = settings.view.effects;
    view.samples = settings.view.samples;
    view.lod = settings.view.lod;
    view.display = settings.view.display;
    view.camera = cameraOf(spec, parts.shown.scene.bounds());
    parts.frames = spec.frames;
    parts.cameraMoves = spec.cameraMoves;
    parts.target = engine.own(engine.create(SwapChainDesc{
            .size = size, .imageCount = 1, .format = linear ? Format::RGBA16F : Format::RGBA8, .name = "accuracy" }));
    return std::make_unique<Take>(engine, (*used)->renderer, std::move(parts));
}

Result<double> Studio::timeEnvironment(SceneSpec const& spec, Settings const& settings) {
    const Result<fs::path> file = tools::environmentFile(spec, mFolders);
    if (!file) return file.error();
    const Result<Equipment*> used = equipment(settings);
    if (!used) return used.error();
    Engine& engine = (*used)->engine;
    std::error_code error;
    fs::remove_all(cacheOf(mFolders), error);
    const auto begin = std::chrono::steady_clock::now();
    const Result<Environment> loaded = loadEnvironment(engine, *file, settings.environment);
    if (!loaded) return loaded.error();
    engine.waitIdle();
    return millisecondsSince(begin);
}

Result<double> Studio::timeModel(SceneSpec const& spec, Settings const& settings) {
    const Result<fs::path> file = tools::modelFile(spec, mFolders);
    if (!file) return file.error();
    const Result<Equipment*> used = equipment(settings);
    if (!used) return used.error();
    Engine& engine = (*used)->engine;
    const auto begin = std::chrono::steady_clock::now();
    const Result<Model> loaded = loadGltf(engine, *file, settings.model);
    if (!loaded) return loaded.error();
    engine.waitIdle();
    return millisecondsSince(begin);
}

void Studio::forgetUnusual() {
    for (auto& [key, used] : mEquipment) used->loader.forgetUnusual();
}

} // namespace filament_core::accuracy
