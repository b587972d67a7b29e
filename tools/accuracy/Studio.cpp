// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Studio.h"

#include <chrono>

namespace filament::accuracy {
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
    for (uint32_t i = 1; i < mParts.frames; ++i) mRenderer.render(mParts.scene, mParts.view, mParts.target);
    mRenderer.render(mParts.scene, mParts.view, mParts.target);
    const Result<Image> image = mRenderer.waitPixels(mRenderer.readPixels(mParts.target));
    if (!image) return image.error();
    if (const Result<void> fine = checkDevice(); !fine) return fine.error();
    mRenderer.takeTimings();
    return pictureOf(*image);
}

// The first frame is not timed: what the renderer keeps from frame to frame, shadow maps and the last picture, is that
// of another take.
Result<double> Take::time() {
    for (int i = 0; i < 2; ++i) mRenderer.render(mParts.scene, mParts.view, mParts.target);
    mEngine.waitIdle();
    const std::vector<FrameTimings> timings = mRenderer.takeTimings();
    if (const Result<void> fine = checkDevice(); !fine) return fine.error();
    if (timings.empty() || !(timings.back().gpuMilliseconds > 0))
        return fail(ErrorCode::Unsupported, "{}: the device does not time its passes", mEngine.device().device);
    return timings.back().gpuMilliseconds;
}

struct Studio::Equipment {
    explicit Equipment(Engine made) : engine(std::move(made)), renderer(engine, { .passTimers = true }) {}

    Engine engine;
    Renderer renderer;
    std::map<std::string, Loaded<Model>> models;
    std::map<std::string, Loaded<Environment>> environments;
};

Studio::Studio(Backend backend, tools::SceneFolders const& folders) : mBackend(backend), mFolders(folders) {}
Studio::~Studio() = default;

Result<std::unique_ptr<Studio>> Studio::open(Backend backend, tools::SceneFolders const& folders) {
    std::unique_ptr<Studio> studio(new Studio(backend, folders));
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
        known = std::make_unique<Equipment>(std::move(*engine));
    }
    return known.get();
}

Result<std::shared_ptr<Model>> Studio::model(Equipment& used, SceneSpec const& spec, Settings const& settings) {
    const Result<fs::path> file = tools::modelFile(spec, mFolders);
    if (!file) return file.error();
    Loaded<Model>& known = used.models[file->string() + settings.modelKey];
    if (!known.file) {
        Result<Model> loaded = loadGltf(used.engine, *file, settings.model);
        if (!loaded) return loaded.error();
        known = { std::make_shared<Model>(std::move(*loaded)), settings.modelKey.empty() };
    }
    return known.file;
}

Result<std::shared_ptr<Environment>> Studio::environment(Equipment& used, SceneSpec const& spec,
                                                         Settings const& settings) {
    const Result<fs::path> file = tools::environmentFile(spec, mFolders);
    if (!file) return file.error();
    if (file->empty()) return std::shared_ptr<Environment>();
    Loaded<Environment>& known = used.environments[file->string() + settings.environmentKey];
    if (!known.file) {
        Result<Environment> loaded = loadEnvironment(used.engine, *file, settings.environment);
        if (!loaded) return loaded.error();
        known = { std::make_shared<Environment>(std::move(*loaded)), settings.environmentKey.empty() };
    }
    return known.file;
}

Result<std::unique_ptr<Take>> Studio::take(SceneSpec const& spec, Settings const& settings, uint2 size, bool linear) {
    const Result<Equipment*> used = equipment(settings);
    if (!used) return used.error();
    Engine& engine = (*used)->engine;
    Result<TakeParts> parts = partsOf(**used, spec, settings);
    if (!parts) return parts.error();
    Scene& scene = parts->scene;
    if (const Result<void> added = tools::addLights(engine, scene, spec, mFolders); !added) return added.error();
    if (parts->environment)
        scene.setEnvironment(*parts->environment, spec.environmentSettings);
    else if (parts->model && parts->model->environment())
        scene.setEnvironment(*parts->model->environment(), spec.environmentSettings);
    View& view = parts->view;
    view = spec.view;
    view.size = size;
    view.quality = settings.view.quality;
    view.effects = settings.view.effects;
    view.samples = settings.view.samples;
    view.colorGrading = settings.view.colorGrading;
    view.camera = cameraOf(spec, scene.bounds());
    parts->frames = spec.frames;
    parts->target = engine.own(engine.create(SwapChainDesc{
            .size = size, .imageCount = 1, .format = linear ? Format::RGBA16F : Format::RGBA8, .name = "accuracy" }));
    return std::make_unique<Take>(engine, (*used)->renderer, std::move(*parts));
}

/// The objects that are drawn, without lights.
Result<TakeParts> Studio::partsOf(Equipment& used, SceneSpec const& spec, Settings const& settings) {
    TakeParts parts{ .scene = Scene(used.engine) };
    Result<std::shared_ptr<Environment>> sky = environment(used, spec, settings);
    if (!sky) return sky.error();
    parts.environment = std::move(*sky);
    if (tools::isMaterialModel(spec)) {
        Result<tools::MaterialStand> stand = tools::makeMaterialModel(used.engine, spec);
        if (!stand) return stand.error();
        parts.material = std::make_shared<tools::MaterialStand>(std::move(*stand));
        const auto added = tools::addMaterialCopies(used.engine, parts.scene, spec, *parts.material);
        if (!added) return added.error();
        return parts;
    }
    Result<std::shared_ptr<Model>> loaded = model(used, spec, settings);
    if (!loaded) return loaded.error();
    parts.model = std::move(*loaded);
    for (double4x4 const& copy : placedCopies(spec)) parts.scene.add(*parts.model, copy);
    return parts;
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
    const auto isUnusual = [](auto const& entry) {
        return !entry.second.isUsual && entry.second.file.use_count() == 1;
    };
    for (auto& [key, used] : mEquipment) {
        std::erase_if(used->models, isUnusual);
        std::erase_if(used->environments, isUnusual);
    }
}

} // namespace filament::accuracy
