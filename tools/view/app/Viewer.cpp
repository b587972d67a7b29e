// SPDX-License-Identifier: Apache-2.0
// Size: perform() is a table: an action a case.
#include "tools/view/app/Viewer.h"

#include "tools/view/app/UiInput.h"
#include "tools/view/panels/AnimationModel.h"
#include "tools/view/panels/CameraModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace filament::view {
namespace {

constexpr size_t kLatencies = 120;
constexpr uint32_t kFramesAfterChange = 3; ///< ImGui settles in two frames, picks and statistics arrive with the next
constexpr uint32_t kFramesOfHistory = 64;  ///< until temporal anti-aliasing has gathered its picture
constexpr double kLongWait = 0.25, kShortWait = 0.002;
constexpr double kFovDegrees = 40; ///< of a camera that was parallel
constexpr DebugView kLastDebugView = DebugView::WireframeAlone;

/// What a file is to a viewer, by its ending.
enum class FileKind : uint8_t { Model, Environment, Document, Unknown };

FileKind kindOf(std::filesystem::path const& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto isOneOf = [&](auto... endings) { return ((ending == endings) || ...); };
    if (isOneOf(".gltf", ".glb", ".mat", ".fmat")) return FileKind::Model;
    if (isOneOf(".hdr", ".exr", ".fenv")) return FileKind::Environment;
    return ending == ".json" ? FileKind::Document : FileKind::Unknown;
}

KeyModifiers modifiersOf(Modifiers const& modifiers) {
    if (modifiers.control) return modifiers.shift ? KeyModifiers::ControlShift : KeyModifiers::Control;
    return modifiers.shift ? KeyModifiers::Shift : KeyModifiers::None;
}

std::optional<Action> actionOf(KeyEvent const& event) {
    if (!event.isDown || event.modifiers.alt || event.modifiers.super) return std::nullopt;
    return actionOf(static_cast<Key>(event.key), modifiersOf(event.modifiers));
}

void showModel(Document& document, std::filesystem::path const& file) {
    document.model.file = file;
    document.model.variant.clear();
    document.nodes.clear();
    document.materials.clear();
    document.modelLights.clear();
    document.morphs.clear();
    document.playback = {};
}

void showNextDebugView(Document& document) {
    const auto next = static_cast<DebugView>(static_cast<int>(document.view.debugView) + 1);
    document.view.debugView = next > kLastDebugView ? DebugView::None : next;
}

} // namespace

// ---------------------------------------------------------------------------------------------- life time

Viewer::Viewer(ViewerOptions const& options, Document document, ViewerTarget const& target)
        : mOptions(options), mTarget(target), mDocument(std::move(document)), mFirstCamera(mDocument.view.camera),
          mUi(target.scale), mHistory(mDocument) {
    prepareUiInput();
    mDocument.view.size = max(target.pixels, uint2(1));
    mPanels.state.showsPanels = options.panels;
}

Viewer::~Viewer() { closeStage(); }

Result<std::unique_ptr<Viewer>> Viewer::create(ViewerOptions const& options, Document document,
                                               ViewerTarget const& target) {
    std::unique_ptr<Viewer> viewer(new Viewer(options, std::move(document), target));
    if (Result<void> opened = viewer->openStage(options.backend); !opened) return opened.error();
    return viewer;
}

EngineOptions Viewer::engineOptions(Backend backend) const {
    return { .backend = backend,
             .workers = mOptions.workers,
             .display = mTarget.display,
             .validation = mOptions.validation,
             .exactShaders = mOptions.exactShaders };
}

Result<void> Viewer::openStage(Backend backend) {
    auto stage = Stage::create({ .engine = engineOptions(backend), .renderer = { .passTimers = true } });
    if (!stage) return stage.error();
    Result<UiRenderer> ui = UiRenderer::create((*stage)->engine());
    if (!ui) return ui.error();
    mStage = std::move(*stage);
    mUiRenderer.emplace(std::move(*ui));
    mUiRenderer->uploadFonts(mUi.fonts());
    mChain = mStage->engine().own(mStage->engine().create(SwapChainDesc{ .size = mDocument.view.size,
                                                                         .window = mTarget.window,
                                                                         .presentMode = mOptions.presentMode,
                                                                         .name = "viewer" }));
    mPresents = 0;
    mSent.clear();
    mPick = {};
    touch();
    return {};
}

void Viewer::closeStage() {
    mCompared.close(mUiRenderer ? &*mUiRenderer : nullptr);
    mUiRenderer.reset();
    mChain.reset();
    mStage.reset();
}

void Viewer::setBackend(Backend backend) {
    const Backend before = mStage->engine().device().backend;
    mCompared.mode = CompareMode::Off; // the other API becomes this one
    closeStage();                      // a window belongs to one API at a time
    if (Result<void> opened = openStage(backend); !opened) {
        note(opened.error().message);
        if (Result<void> back = openStage(before); !back) {
            note(back.error().message);
            mIsClosed = true;
        }
    }
}

// ---------------------------------------------------------------------------------------------- events

void Viewer::touch() {
    const bool gathers = mDocument.view.quality.antiAliasing == AntiAliasing::Taa;
    mFramesToDraw = std::max(mFramesToDraw, gathers ? kFramesOfHistory : kFramesAfterChange);
}

void Viewer::note(std::string message) {
    mPanels.state.addMessage(message);
    mMessages.push_back(std::move(message));
    touch();
}

void Viewer::handle(InputEvent const& event) {
    touch();
    if (!mOldestEvent) mOldestEvent = Clock::now();
    if (std::holds_alternative<CloseEvent>(event)) mIsClosed = true;
    if (auto const* sized = std::get_if<ResizeEvent>(&event)) return resize(*sized);
    if (auto const* dropped = std::get_if<DropEvent>(&event)) return drop(*dropped);
    const bool isTaken = passToUi(event);
    auto const* key = std::get_if<KeyEvent>(&event);
    auto const* button = std::get_if<MouseButtonEvent>(&event);
    const bool isRelease = (key && !key->isDown) || (button && !button->isDown); // of what was pressed over the scene
    if (isTaken && !isRelease && !mHands.isDragging()) return;
    if (const auto action = key ? actionOf(*key) : std::nullopt) return perform(*action);
    if (mCompared.handle(event, mDocument.view.size) && !mHands.isDragging()) return;
    mHands.handle(event, mDocument.view.size, mDocument.view.camera);
    if (const std::optional<uint2> click = mHands.takeClick(); click && all(lessThan(*click, mDocument.view.size)))
        mPick = mStage->renderer().pick(mStage->scene(), mStage->view(), *click);
}

void Viewer::resize(ResizeEvent const& event) {
    mTarget.pixels = event.pixels;
    if (mUi.setScale(event.scale)) mUiRenderer->uploadFonts(mUi.fonts());
    if (event.pixels.x == 0 || event.pixels.y == 0 || event.pixels == mDocument.view.size) return;
    mDocument.view.size = event.pixels;
    mStage->engine().resize(mChain, event.pixels);
}

void Viewer::drop(DropEvent const& event) {
    for (std::filesystem::path const& file : event.files) open(file);
}

void Viewer::open(std::filesystem::path const& file) {
    switch (kindOf(file)) {
    case FileKind::Model:
        return showModel(mDocument, file);
    case FileKind::Environment:
        mDocument.environment.file = file;
        mDocument.environment.prefersModels = false;
        return;
    case FileKind::Document: {
        Result<Document> loaded = loadDocument(file);
        if (!loaded) return note(loaded.error().message);
        mDocument = std::move(*loaded);
        mDocument.view.size = max(mTarget.pixels, uint2(1));
        return;
    }
    case FileKind::Unknown:
        return note(fmt::format("'{}' is nothing to show: drop .glb, .gltf, .mat, .hdr, .exr or .json", file.string()));
    }
}

// ---------------------------------------------------------------------------------------------- actions

void Viewer::frame(Box const& box) {
    const double aspect = static_cast<double>(mDocument.view.size.x) / mDocument.view.size.y;
    mDocument.view.camera = framed(mDocument.view.camera, box, aspect);
    if (!box.empty()) mHands.targetWorld = box.center();
}

void Viewer::toggleParallel() {
    Camera& camera = mDocument.view.camera;
    const double distance = distanceTo(camera, mHands.targetWorld);
    camera = camera.lens.isParallel() ? asPerspective(camera, kFovDegrees, distance) : asParallel(camera, distance);
}

void Viewer::hideSelection() {
    if (mPanels.state.selectedNode) toggleVisible(mDocument, *mPanels.state.selectedNode);
}

void Viewer::changeCompareMode() {
    mCompared.mode = nextMode(mCompared.mode);
    if (mCompared.mode == CompareMode::Off) mCompared.close(&*mUiRenderer);
}

/// "viewer-3.png": the first that is not there yet.
std::filesystem::path Viewer::freshName(const char* ending) const {
    for (uint32_t i = 1;; ++i) {
        std::filesystem::path file = mOptions.out / fmt::format("viewer-{}{}", i, ending);
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) return file;
    }
}

void Viewer::saveDocumentFile() {
    const std::filesystem::path file = freshName(".json");
    const Result<void> saved = saveDocument(file, mDocument);
    note(saved ? fmt::format("saved {}", file.string()) : saved.error().message);
}

void Viewer::savePicture() {
    const std::filesystem::path file = freshName(".png");
    Result<Image> image = mStage->renderToImage(); // without the panels
    if (!image) return note(image.error().message);
    const Result<void> saved = savePng(file, *image, mDocument.view.colorGrading.outputSpace);
    note(saved ? fmt::format("saved {}", file.string()) : saved.error().message);
}

void Viewer::playOrPause() {
    if (!mStage->model() || mStage->model()->animationCount() == 0) return note("this model has no animations");
    togglePlaying(mDocument);
}

void Viewer::saveFrame() {
    if (mSaver.isBusy()) return note("a frame is being saved");
    mStage->forgetFrames(); // as a new stage will draw it
    Result<Image> image = mStage->renderToImage();
    if (!image) return note(image.error().message);
    mSaver.start(freshName(".frame"), mDocument, std::move(*image), mOptions.workers);
    note("saving the frame ...");
}

void Viewer::perform(Action action) {
    touch();
    switch (action) {
    case Action::ShowShortcuts:
        mPanels.state.showsShortcuts = !mPanels.state.showsShortcuts;
        break;
    case Action::TogglePanels:
        mPanels.state.showsPanels = !mPanels.state.showsPanels;
        break;
    case Action::ToggleFullScreen:
        mIsFullScreen = !mIsFullScreen;
        break;
    case Action::Quit:
        mIsClosed = true;
        break;
    case Action::Open:
        note("drop a file on the window: .glb, .gltf, .mat, .hdr, .exr or .json");
        break;
    case Action::SaveDocument:
        saveDocumentFile();
        break;
    case Action::Reload:
        mStage->reload();
        break;
    case Action::CancelLoading:
        if (isLoading()) mStage->cancel();
        mPanels.state.selectedNode.reset();
        break;
    case Action::Undo:
        mHistory.undo(mDocument);
        break;
    case Action::Redo:
        mHistory.redo(mDocument);
        break;
    case Action::FrameSelection:
        frame(boundsOfSelection());
        break;
    case Action::FrameAll:
        frame(mStage->bounds());
        break;
    case Action::ResetCamera:
        mDocument.view.camera = withPlaceOf(mDocument.view.camera, mFirstCamera);
        mHands.targetWorld = double3(0);
        break;
    case Action::ToggleParallel:
        toggleParallel();
        break;
    case Action::AddBookmark:
        addBookmark(mDocument);
        break;
    case Action::HideSelection:
        hideSelection();
        break;
    case Action::IsolateSelection:
        if (mPanels.state.selectedNode) isolate(mDocument, sceneNodes(*mStage), *mPanels.state.selectedNode);
        break;
    case Action::ShowAll:
        showAll(mDocument);
        break;
    case Action::PlayPause:
        playOrPause();
        break;
    case Action::NextDebugView:
        showNextDebugView(mDocument);
        break;
    case Action::Compare:
        changeCompareMode();
        break;
    case Action::CompareWith:
        mCompared.with = mCompared.with == CompareWith::OtherApi ? CompareWith::PathTracer : CompareWith::OtherApi;
        if (mCompared.mode == CompareMode::Off) mCompared.mode = CompareMode::Wipe;
        break;
    case Action::ChangeBackend:
        setBackend(mStage->engine().device().backend == Backend::Vulkan ? Backend::Gles : Backend::Vulkan);
        break;
    case Action::SavePicture:
        savePicture();
        break;
    case Action::SaveFrame:
        saveFrame();
        break;
    case Action::Count:
        break;
    }
}

// ---------------------------------------------------------------------------------------------- time

double Viewer::idleSeconds() const {
    const bool moves = mFramesToDraw > 0 || mHands.isMoving() || mDocument.playback.isPlaying || isLoading() || mPick ||
                       mCompared.isWaiting() || mSaver.isBusy();
    return moves ? kShortWait : kLongWait; // files are looked at four times a second
}

void Viewer::play(double seconds) {
    Playback& playback = mDocument.playback;
    Model const* const model = mStage->model();
    if (!playback.isPlaying || !model || !playback.animation) return;
    if (*playback.animation >= model->animationCount()) return;
    playback = advanced(playback, seconds, model->animationSeconds(*playback.animation));
    touch();
}

void Viewer::pollLoads() {
    mStage->apply(mDocument);
    mStage->poll();
    for (std::string& message : mStage->takeMessages()) note(std::move(message));
    for (std::string& message : mCompared.takeMessages()) note(std::move(message));
    if (auto lines = mSaver.poll())
        for (std::string& line : *lines) note(std::move(line));
    const bool isLoadingNow = isLoading();
    if (std::exchange(mWasLoading, isLoadingNow) || isLoadingNow) touch();
    if (std::exchange(mGeneration, mStage->generation()) != mStage->generation()) touch();
}

void Viewer::pollPick() {
    if (!mPick) return;
    const std::optional<PickHit> hit = mStage->renderer().takePick(mPick);
    if (!hit) return;
    mPick = {};
    mPanels.state.selectedNode = *hit && hit->node ? mStage->indexOf(hit->node) : std::nullopt;
    if (*hit) mHands.targetWorld = hit->positionWorld;
    touch();
}

void Viewer::pollLatency() {
    const uint64_t shown = mTarget.window ? mStage->engine().statistics().presents : mPresents;
    while (!mSent.empty() && mSent.front().presents <= shown) {
        mLatencies.push_back(std::chrono::duration<double, std::milli>(Clock::now() - mSent.front().event).count());
        if (mLatencies.size() > kLatencies) mLatencies.pop_front();
        mSent.pop_front();
    }
}

InputLatency Viewer::latency() const {
    if (mLatencies.empty()) return {};
    std::vector<double> sorted(mLatencies.begin(), mLatencies.end());
    std::ranges::sort(sorted);
    return { static_cast<uint32_t>(sorted.size()), sorted[sorted.size() / 2], sorted.back() };
}

void Viewer::followRequests() {
    PanelRequests& requests = mPanels.requests;
    if (std::exchange(requests.cancelsLoading, false)) mStage->cancel();
    if (std::exchange(requests.framesSelection, false)) frame(boundsOfSelection());
}

bool Viewer::step(double seconds) {
    if (mHands.advance(seconds, mDocument.view.camera)) touch();
    play(seconds);
    pollLoads();
    pollPick();
    pollLatency();
    const bool isHidden = mTarget.pixels.x == 0 || mTarget.pixels.y == 0;
    const bool hasWork = mFramesToDraw > 0 || mCompared.isWaiting();
    if (!hasWork || isHidden || !mStage->renderer().mayPresent(mChain)) return false;
    if (mFramesToDraw > 0) --mFramesToDraw;
    draw(seconds);
    if (!isLoading()) ++mCompleteFrames;
    return true;
}

// ---------------------------------------------------------------------------------------------- frames

Box Viewer::boundsOfSelection() const {
    const std::vector<Node> nodes = mStage->nodes();
    std::optional<uint32_t> const& selected = mPanels.state.selectedNode;
    if (!selected || *selected >= nodes.size() || !mStage->modelCopy()) return mStage->bounds();
    Box all;
    for (CopyRenderable const& each : mStage->modelCopy()->renderables()) {
        Node node = each.node;
        while (node && !(node == nodes[*selected])) node = mStage->scene().parent(node);
        if (node) all.add(mStage->scene().bounds(each.renderable));
    }
    return all.empty() ? mStage->bounds() : all;
}

void Viewer::drawOutline() {
    mOutline.clear();
    if (!mPanels.state.selectedNode) return;
    mOutline.box(boundsOfSelection(),
                 { .color = { 1, 0.62f, 0.1f, 1 }, .widthPixels = 2, .depth = DebugDepth::Through });
}

void Viewer::draw(double seconds) {
    mUi.newFrame(mDocument.view.size, static_cast<float>(seconds));
    mCompared.draw(*mUiRenderer, mStage->engine(), mDocument.view.size);
    mPanels.draw(mDocument, *mStage);
    followRequests();
    ImGui::Render();
    mHistory.note(mDocument, ImGui::IsAnyItemActive());
    mStage->apply(mDocument); // with what the panels changed
    drawOutline();
    mStage->render(mChain,
                   { .debugDraw = mOutline.empty() || mCompared.mode != CompareMode::Off ? nullptr : &mOutline });
    if (mCompared.follow(mDocument, *mStage, mChain, engineOptions(mStage->engine().device().backend))) touch();
    mUiRenderer->render(*ImGui::GetDrawData(), mChain, mDocument.view.size);
    mStage->renderer().present(mChain);
    mPanels.collect(*mStage);
    ++mPresents;
    if (mOldestEvent) mSent.push_back({ mPresents, *std::exchange(mOldestEvent, std::nullopt) });
}

Result<Image> Viewer::screenshot() { return mStage->renderer().waitPixels(mStage->renderer().readPixels(mChain)); }

} // namespace filament::view
