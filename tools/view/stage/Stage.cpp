// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/Stage.h"

#include "tools/view/stage/FileWatch.h"
#include "tools/view/stage/StagedScene.h"

#include <filament_core/LightProfile.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace filament_core::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kWatchInterval = std::chrono::milliseconds(250);

/// What decides which file is loaded, and how. Not `fit` and `variant`, which need no other load.
struct ModelKey : DocumentModel {
    explicit ModelKey(Document const& document) : DocumentModel(document.model) {
        options.simplified |= document.view.lod.pixels > 0;
        fit = true;
        variant.clear();
    }
};

struct EnvironmentKey : DocumentEnvironment {
    explicit EnvironmentKey(DocumentEnvironment const& environment) : DocumentEnvironment(environment) {
        prefersModels = true;
        settings = {};
    }
};

bool operator==(ModelKey const& a, ModelKey const& b) {
    return static_cast<DocumentModel const&>(a) == static_cast<DocumentModel const&>(b);
}
bool operator==(EnvironmentKey const& a, EnvironmentKey const& b) {
    return static_cast<DocumentEnvironment const&>(a) == static_cast<DocumentEnvironment const&>(b);
}

/// The parts of a document that belong to its model.
void copyModelPart(Document const& from, Document& to) {
    to.model = from.model;
    to.nodes = from.nodes;
    to.materials = from.materials;
    to.textures = from.textures;
    to.modelLights = from.modelLights;
    to.playback = from.playback;
    to.morphs = from.morphs;
}

} // namespace

struct Stage::Impl {
    /// `created`: none, if the engine is the caller's.
    Impl(std::optional<Engine> created, Engine* others, StageOptions const& given)
            : options(given), own(std::move(created)), engine(own ? *own : *others),
              renderer(std::in_place, engine, given.renderer) {
        rebuild();
    }

    // ---- files
    void startLoads(bool again);
    void pollModel();
    void pollEnvironment();
    void pollLook();
    void pollDirt();
    void pollTextures();
    void pollProbes();
    void readProfiles(bool again);
    void watchFiles(bool again);
    void watchListed();
    void pollListing();
    void lookAtFiles();
    bool isLoading() const {
        return model.isLoading() || environment.isLoading() || lookFile.isLoading() || dirt.isLoading() ||
               textures.isLoading() || probes.isLoading() || listing;
    }
    template <class SlotType>
    void finish(SlotType& slot, Result<typename std::remove_reference_t<decltype(*slot.value())>>&& result);

    // ---- the scene
    /// What is drawn: the document, with the model that is there.
    Document wanted() const;
    void show();
    void rebuild();
    void light();
    void updateView();
    View frameView(FrameExtras const& extras) const;

    StageOptions options;
    Messages messages;
    std::optional<Error> loadError; ///< the first one
    Abandoned abandoned;
    std::optional<Engine> own;
    Engine& engine;
    Document document; ///< that was applied
    Document shown;    ///< that the scene has
    std::string lastRefusal;

    Slot<ModelLoad, ModelKey> model;
    Slot<EnvironmentLoad, EnvironmentKey> environment;
    Slot<LookLoad, std::filesystem::path> lookFile;
    Slot<DirtLoad, std::filesystem::path> dirt;
    Profiles profiles;
    LoadedTextures textures;
    LoadedProbes probes;
    FileWatch watch;
    std::vector<std::filesystem::path> watchedOthers, modelFiles; ///< the latter: of watchedModel
    std::filesystem::path watchedModel;
    std::optional<Background<std::vector<std::filesystem::path>>> listing; ///< filesOf(watchedModel)
    Clock::time_point nextLook{};

    std::unique_ptr<StagedScene> scene; ///< ends before what is loaded
    bool isModelEnvironment = false;
    View view;
    uint64_t generation = 0;
    std::optional<Renderer> renderer;
};

// ---- files

void Stage::Impl::startLoads(bool again) {
    const auto endedModel = model.want(engine, ModelKey(document), !document.model.file.empty(), again, abandoned);
    const auto endedSky = environment.want(engine, EnvironmentKey(document.environment),
                                           !document.environment.file.empty(), again, abandoned);
    (void)lookFile.want(engine, document.look, !document.look.empty(), again, abandoned);
    const auto endedDirt = dirt.want(engine, document.dirt, !document.dirt.empty(), again, abandoned);
    textures.want(document.textures, again, abandoned);
    probes.want(engine, document, again, abandoned, messages);
    readProfiles(again);
    watchFiles(again);
    if (endedModel)
        rebuild();
    else if (endedSky)
        light();
    if (endedDirt) updateView();
}

/// A finished load takes the place of what was there, or says why it does not.
template <class SlotType>
void Stage::Impl::finish(SlotType& slot, Result<typename std::remove_reference_t<decltype(*slot.value())>>&& result) {
    if (result) {
        slot.value() = std::move(*result);
    } else if (result.error().code != ErrorCode::Cancelled) {
        if (!loadError) loadError = result.error();
        messages.add(result.error().message);
    }
}

void Stage::Impl::pollModel() {
    auto result = model.poll(engine, options.sliceBytes);
    if (!result) return;
    if (!*result) return finish(model, std::move(*result));
    messages.forget();
    if (Model const* gltf = (*result)->model()) {
        for (std::string const& warning : gltf->warnings()) messages.add(warning);
    }
    std::optional<LoadedModel> last = std::exchange(model.value(), std::move(**result));
    rebuild(); // the last scene ends before what it showed
}

void Stage::Impl::pollEnvironment() {
    auto result = environment.poll(engine, options.sliceBytes);
    if (!result) return;
    finish(environment, std::move(*result));
    light();
}

void Stage::Impl::pollLook() {
    auto result = lookFile.poll(engine, options.sliceBytes);
    if (!result) return;
    finish(lookFile, std::move(*result));
    updateView();
}

void Stage::Impl::pollDirt() {
    auto result = dirt.poll(engine, options.sliceBytes);
    if (!result) return;
    finish(dirt, std::move(*result));
    updateView();
}

void Stage::Impl::pollTextures() {
    if (textures.poll(engine, messages)) rebuild();
}

void Stage::Impl::pollProbes() {
    if (probes.poll(engine, options.sliceBytes, messages)) rebuild();
}

/// Small files, so at once. One that cannot be read leaves its light without a profile.
void Stage::Impl::readProfiles(bool again) {
    Profiles known = std::exchange(profiles, {});
    for (DocumentLight const& light : document.lights) {
        std::filesystem::path const& file = light.profileFile;
        if (file.empty() || profiles.contains(file)) continue;
        const auto found = known.find(file);
        if (found != known.end() && !again) {
            profiles[file] = std::move(found->second);
            continue;
        }
        Result<LightProfile> profile = loadLightProfile(engine, file);
        if (profile)
            profiles[file] = engine.own(*profile);
        else
            messages.addOnce(profile.error().message);
    }
}

void Stage::Impl::watchFiles(bool again) {
    std::vector<std::filesystem::path> files{ document.environment.file, document.look, document.dirt };
    for (DocumentLight const& light : document.lights) files.push_back(light.profileFile);
    for (TextureEdit const& edit : document.textures) files.push_back(edit.file);
    const bool isSame = document.model.file == watchedModel && files == watchedOthers && !again;
    if (!options.watchesFiles || isSame) return;
    watchedOthers = std::move(files);
    if (std::exchange(watchedModel, document.model.file) != watchedModel) modelFiles = { watchedModel };
    abandoned.add(listing);
    if (!watchedModel.empty()) listing.emplace([file = watchedModel] { return filesOf(file); });
    watchListed();
}

void Stage::Impl::watchListed() {
    std::vector<std::filesystem::path> files = watchedOthers;
    files.insert(files.end(), modelFiles.begin(), modelFiles.end());
    watch.watch(files);
}

/// Until then the files that the model named before are watched.
void Stage::Impl::pollListing() {
    std::optional<std::vector<std::filesystem::path>> files = takeFinished(listing);
    if (!files) return;
    modelFiles = std::move(*files);
    watchListed();
}

void Stage::Impl::lookAtFiles() {
    if (!options.watchesFiles || Clock::now() < nextLook) return;
    nextLook = Clock::now() + kWatchInterval;
    const std::vector<std::filesystem::path> changed = watch.changed();
    for (std::filesystem::path const& file : changed) {
        if (std::ranges::find(modelFiles, file) != modelFiles.end()) {
            (void)model.want(engine, ModelKey(document), true, true, abandoned);
        } else if (file == document.environment.file) {
            (void)environment.want(engine, EnvironmentKey(document.environment), true, true, abandoned);
        } else if (file == document.look) {
            (void)lookFile.want(engine, file, true, true, abandoned);
        } else if (file == document.dirt) {
            (void)dirt.want(engine, file, true, true, abandoned);
        } else if (std::ranges::find(document.textures, file, &TextureEdit::file) != document.textures.end()) {
            textures.reload(file, abandoned);
        } else {
            readProfiles(true);
            rebuild();
        }
    }
    if (!changed.empty()) watchFiles(true); // a file may name others now
}

// ---- the scene

Document Stage::Impl::wanted() const {
    Document wanted = document;
    if (!model.isCurrent()) copyModelPart(shown, wanted);
    return wanted;
}

/// After a change of the document.
void Stage::Impl::show() {
    Document next = wanted();
    if (StagedScene::needsAnother(shown, next)) return rebuild();
    scene->update(shown, next, messages);
    const bool isLit = isEqual(shown.environment.settings, next.environment.settings) &&
                       shown.environment.prefersModels == next.environment.prefersModels;
    shown = std::move(next);
    if (!isLit) light();
    updateView();
}

void Stage::Impl::rebuild() {
    shown = wanted();
    LoadedModel* loaded = model.value() ? &*model.value() : nullptr;
    scene.reset();
    scene = std::make_unique<StagedScene>(engine, loaded, profiles, textures, probes, shown, messages);
    textures.dropRetired();
    probes.dropRetired();
    ++generation;
    light();
    updateView();
}

void Stage::Impl::light() {
    Model const* gltf = model.value() ? model.value()->model() : nullptr;
    Environment const* ofModel = gltf && document.environment.prefersModels ? gltf->environment() : nullptr;
    Environment const* ofFile = environment.value() ? &*environment.value() : nullptr;
    isModelEnvironment = ofModel != nullptr;
    scene->setEnvironment(ofModel ? ofModel : ofFile, document.environment.settings);
}

void Stage::Impl::updateView() {
    view = document.view;
    view.display.look = lookFile.value() ? *lookFile.value() : nullptr;
    view.effects.bloom.dirt = dirt.value() ? dirt.value()->get() : Texture{};
    view.viewport.reset();
    view.debugDraw = nullptr;
}

View Stage::Impl::frameView(FrameExtras const& extras) const {
    View frame = view;
    frame.viewport = extras.viewport;
    frame.debugDraw = extras.debugDraw;
    frame.visibleLayers = static_cast<Layers>(frame.visibleLayers & extras.visibleLayers);
    scene->chooseLevels(frame);
    return frame;
}

// ---- Stage

Stage::Stage(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
Stage::~Stage() = default;

Result<std::unique_ptr<Stage>> Stage::create(StageOptions const& options) {
    Result<Engine> engine = Engine::create(options.engine);
    if (!engine) return engine.error();
    return std::unique_ptr<Stage>(new Stage(std::make_unique<Impl>(std::move(*engine), nullptr, options)));
}

std::unique_ptr<Stage> Stage::on(Engine& engine, StageOptions const& options) {
    return std::unique_ptr<Stage>(new Stage(std::make_unique<Impl>(std::nullopt, &engine, options)));
}

void Stage::apply(Document const& document) {
    if (document == mImpl->document) return;
    if (const Result<void> valid = check(document); !valid) {
        if (mImpl->lastRefusal != valid.error().message) mImpl->messages.add(valid.error().message);
        mImpl->lastRefusal = valid.error().message;
        return;
    }
    mImpl->lastRefusal.clear();
    mImpl->document = document;
    mImpl->startLoads(false);
    mImpl->show();
}

Document const& Stage::document() const { return mImpl->document; }

void Stage::poll() {
    mImpl->abandoned.removeFinished();
    mImpl->pollListing();
    mImpl->lookAtFiles();
    mImpl->pollModel();
    mImpl->pollEnvironment();
    mImpl->pollLook();
    mImpl->pollDirt();
    mImpl->pollTextures();
    mImpl->pollProbes();
}

StageProgress Stage::progress() const {
    StageProgress progress;
    const auto add = [&](std::filesystem::path const& file, std::optional<LoadState> const& state) {
        if (!state) return;
        if (progress.files++ > 0) return;
        progress.isLoading = true;
        progress.what = fmt::format("{}, {}", file.filename().string(), state->step);
        progress.done = state->done;
        progress.total = state->total;
    };
    add(mImpl->document.model.file, mImpl->model.state());
    add(mImpl->document.environment.file, mImpl->environment.state());
    add(mImpl->document.look, mImpl->lookFile.state());
    add(mImpl->document.dirt, mImpl->dirt.state());
    if (const auto file = mImpl->textures.firstLoading()) add(*file, LoadState{ .step = "decoding" });
    if (const auto file = mImpl->probes.firstLoading()) add(*file, LoadState{ .step = "filtering" });
    return progress;
}

void Stage::finishLoading(std::function<bool()> const& isCancelled) {
    const auto goesOn = [&] { return mImpl->isLoading() && !(isCancelled && isCancelled()); };
    for (poll(); goesOn(); poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Stage::cancel() {
    mImpl->model.drop(mImpl->abandoned);
    mImpl->environment.drop(mImpl->abandoned);
    mImpl->lookFile.drop(mImpl->abandoned);
    mImpl->dirt.drop(mImpl->abandoned);
    mImpl->textures.drop(mImpl->abandoned);
    mImpl->probes.drop(mImpl->abandoned);
}

void Stage::reload() {
    mImpl->startLoads(true);
    mImpl->rebuild();
}

void Stage::render(SwapChain swapChain, FrameExtras const& extras) {
    mImpl->renderer->render(mImpl->scene->scene(), mImpl->frameView(extras), swapChain);
}
void Stage::render(RenderTarget target, FrameExtras const& extras) {
    mImpl->renderer->render(mImpl->scene->scene(), mImpl->frameView(extras), target);
}
Result<Image> Stage::renderToImage() {
    return mImpl->renderer->renderToImage(mImpl->scene->scene(), mImpl->frameView({}));
}
void Stage::forgetFrames() { mImpl->renderer.emplace(mImpl->engine, mImpl->options.renderer); }

std::vector<std::string> Stage::takeMessages() {
    std::vector<std::string> lines = mImpl->messages.take();
    for (std::string& error : mImpl->engine.takeErrors()) lines.push_back(std::move(error));
    return lines;
}

std::optional<Error> const& Stage::loadError() const { return mImpl->loadError; }

uint64_t Stage::generation() const { return mImpl->generation; }
Engine& Stage::engine() { return mImpl->engine; }
Scene& Stage::scene() { return mImpl->scene->scene(); }
Renderer& Stage::renderer() { return *mImpl->renderer; }
View const& Stage::view() const { return mImpl->view; }

std::filesystem::path const& Stage::shownFile() const {
    static const std::filesystem::path kNone;
    return mImpl->model.value() ? mImpl->model.value()->file : kNone;
}
Model const* Stage::model() const { return mImpl->model.value() ? mImpl->model.value()->model() : nullptr; }
ModelCopy const* Stage::modelCopy() const { return mImpl->scene->copy(); }
Node Stage::root() const { return mImpl->scene->root(); }
Box Stage::bounds() const { return mImpl->scene->scene().bounds(); }
std::vector<Node> Stage::nodes() const { return mImpl->scene->nodes(); }
std::optional<uint32_t> Stage::indexOf(Node node) const { return mImpl->scene->indexOf(node); }
std::vector<CopyMaterial> Stage::materials() const { return mImpl->scene->materials(); }
Result<ParameterValue> Stage::parameter(MaterialInstance instance, std::string_view parameter) const {
    return parameterOf(mImpl->engine, instance, parameter);
}
double4x4 Stage::nodeOfFile(uint32_t node) const { return mImpl->scene->nodeOfFile(node); }
LightDesc Stage::lightOfFile(uint32_t light) const { return mImpl->scene->lightOfFile(light); }
std::vector<CopyLight> Stage::modelLights() const { return mImpl->scene->modelLights(); }
std::vector<Light> Stage::documentLights() const { return mImpl->scene->documentLights(); }
bool Stage::hasModelEnvironment() const { return mImpl->isModelEnvironment; }
std::string Stage::environmentLights() const {
    if (mImpl->isModelEnvironment || !mImpl->environment.value()) return {};
    return explain(mImpl->environment.value()->lights(), mImpl->document.environment.settings);
}

} // namespace filament_core::view
