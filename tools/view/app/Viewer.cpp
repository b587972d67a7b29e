// SPDX-License-Identifier: Apache-2.0
// Size: perform() is a table: an action a case.
#include "tools/view/app/Viewer.h"

#include "toolkit/materials/PlainMaterials.h"
#include "tools/view/app/ApiPicture.h"
#include "tools/view/app/OpenFiles.h"
#include "tools/view/panels/AnimationModel.h"
#include "tools/view/panels/CameraModel.h"

#include <filament_core/TextureStreaming.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace filament_core::view {
namespace {

constexpr uint32_t kFramesAfterChange = 3; ///< ImGui settles in two frames, picks and statistics arrive with the next
constexpr uint32_t kFramesOfHistory = 64;  ///< until temporal anti-aliasing has accumulated its image
constexpr double kLongWait = 0.25, kShortWait = 0.002;
constexpr double kProgressSeconds = 0.25; ///< between frames that show only how far loading has come
constexpr double kFovDegrees = 40;        ///< of a camera that was parallel

constexpr float4 kBetweenPanels{ 0.06f, 0.06f, 0.06f, 1 }; ///< of the window; panels lie over it

double secondsNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the image, which begins there.
InputEvent inPicture(InputEvent event, uint2 offset) {
    if (auto* move = std::get_if<MouseMoveEvent>(&event)) move->pixel -= float2(offset);
    return event;
}

KeyModifiers modifiersOf(Modifiers const& modifiers) {
    if (modifiers.control) return modifiers.shift ? KeyModifiers::ControlShift : KeyModifiers::Control;
    return modifiers.shift ? KeyModifiers::Shift : KeyModifiers::None;
}

std::optional<Action> actionOf(KeyEvent const& event) {
    if (!event.isDown || event.modifiers.alt || event.modifiers.super) return std::nullopt;
    return actionOf(static_cast<Key>(event.key), modifiersOf(event.modifiers));
}

void showNextDebugView(Document& document) {
    const size_t next = (static_cast<size_t>(document.view.debugView) + 1) % kDebugViewCount;
    document.view.debugView = static_cast<DebugView>(next);
}

} // namespace

// ---------------------------------------------------------------------------------------------- life time

Viewer::Viewer(ViewerOptions const& options, Document document, ViewerTarget const& target)
        : mOptions(options), mTarget(target), mDocument(std::move(document)), mFirstCamera(mDocument.view.camera),
          mUi(target.scale), mInput(target.clipboard), mHistory(mDocument), mRecent(options.recentFiles) {
    mDocument.view.size = max(target.pixels, uint2(1));
    mSaved = mDocument;
    if (!options.model.empty()) (void)mRecent.add(options.model); // an unwritable list is ignored
    mPanels.fileDialog.recent = mRecent.files();
    mPanels.state.showsPanels = options.panels;
    mCompared.mode = options.compare;
    mGizmo.scale = static_cast<double>(mUi.scale());
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
             .exactShaders = mOptions.exactShaders,
             .traceJobs = mRecordsJobs,
             .debug = { .plainMaterials = &tools::plainMaterial } };
}

Result<void> Viewer::openStage(Backend backend) {
    auto stage = Stage::create({ .engine = engineOptions(backend), .renderer = { .passTimers = true } });
    if (!stage) return stage.error();
    Result<UiRenderer> ui = UiRenderer::create((*stage)->engine());
    if (!ui) return ui.error();
    mStage = std::move(*stage);
    mUiRenderer.emplace(std::move(*ui));
    mUiRenderer->uploadFonts(mUi.fonts());
    mChainPixels = max(mTarget.pixels, uint2(1));
    mChain = mStage->engine().own(mStage->engine().create(SwapChainDesc{
            .size = mChainPixels, .window = mTarget.window, .presentMode = mOptions.presentMode, .name = "viewer" }));
    mPresents = 0;
    mPanels.latency.reset();
    mPick = {};
    touch();
    return {};
}

void Viewer::closeStage() {
    mInstruments.closeEngine(mPanels);
    mCompared.close(mUiRenderer ? &*mUiRenderer : nullptr);
    mPictures.close();
    if (std::exchange(mReadsFrame, false)) note("the frame was not saved: the engine that drew it ended");
    mGizmo.letGo(); // its generations belong to the stage
    mNumerics.close();
    mInspector.close();
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
            saveDocumentFile(); // nothing else has it
            mIsClosed = true;
        }
    }
}

// ---------------------------------------------------------------------------------------------- events

void Viewer::touch() {
    const bool accumulates = mDocument.view.quality.antiAliasing == AntiAliasing::Taa;
    mFramesToDraw = std::max(mFramesToDraw, accumulates ? kFramesOfHistory : kFramesAfterChange);
}

void Viewer::note(std::string message) {
    mPanels.state.addMessage(message);
    mMessages.push_back(std::move(message));
    touch();
}

void Viewer::handle(InputEvent const& event) {
    if (!mStage) return;
    touch();
    mPanels.latency.input(secondsNow());
    if (std::holds_alternative<CloseEvent>(event)) mIsClosed = true;
    if (auto const* sized = std::get_if<ResizeEvent>(&event)) return resize(*sized);
    if (auto const* dropped = std::get_if<DropEvent>(&event)) {
        for (std::filesystem::path const& file : dropped->files) open(file);
        return;
    }
    const bool isTaken = mInput.pass(event);
    auto const* key = std::get_if<KeyEvent>(&event);
    auto const* button = std::get_if<MouseButtonEvent>(&event);
    const bool isRelease = (key && !key->isDown) || (button && !button->isDown); // of what was pressed over the scene
    const bool isForDialog = key && mPanels.fileDialog.isOpen();
    if ((isTaken || isForDialog) && !isRelease && !mHands.isDragging() && !mGizmo.isDragging()) return;
    const InputEvent placed = inPicture(event, mOffset);
    if (auto const* move = std::get_if<MouseMoveEvent>(&placed)) mInspector.point(uint2(max(move->pixel, float2(0))));
    if (!mHands.isDragging() && mGizmo.handle(placed, gizmoScene())) return;
    if (const auto action = key ? actionOf(*key) : std::nullopt) return perform(*action);
    if (mCompared.handle(placed, mDocument.view.size) && !mHands.isDragging()) return;
    mHands.handle(placed, mDocument.view.size, mDocument.view.camera);
    if (const std::optional<uint2> click = mHands.takeClick(); click && all(lessThan(*click, mDocument.view.size)))
        mPick = mStage->renderer().pick(mStage->scene(), mStage->view(), *click);
}

void Viewer::resize(ResizeEvent const& event) {
    const bool isShown = event.pixels.x > 0 && event.pixels.y > 0;
    mGizmo.letGo(); // its pixels are others now
    if (mUi.setScale(event.scale)) mUiRenderer->uploadFonts(mUi.fonts());
    mGizmo.scale = static_cast<double>(mUi.scale());
    if (isShown && event.pixels != mChainPixels) mStage->engine().resize(mChain, mChainPixels = event.pixels);
    mTarget.pixels = event.pixels;
    if (isShown) placePicture();
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
    camera = camera.lens.isOrthographic() ? asPerspective(camera, kFovDegrees, distance) : asParallel(camera, distance);
}

void Viewer::hideSelection() {
    if (mPanels.state.selectedNode) toggleVisible(mDocument, *mPanels.state.selectedNode);
}

void Viewer::changeCompareMode() {
    mCompared.mode = nextMode(mCompared.mode);
    if (mCompared.mode == CompareMode::Off) mCompared.close(&*mUiRenderer);
}

void Viewer::playOrPause() {
    if (!mStage->model() || mStage->model()->animationCount() == 0) return note("this model has no animations");
    togglePlaying(mDocument);
}

void Viewer::perform(Action action) {
    struct Row {
        Action action;
        void (*perform)(Viewer& v);
    };
    static constexpr Row kRows[] = {
        { Action::ShowShortcuts, [](Viewer& v) { v.mPanels.state.showsShortcuts = !v.mPanels.state.showsShortcuts; } },
        { Action::TogglePanels, [](Viewer& v) { v.mPanels.state.showsPanels = !v.mPanels.state.showsPanels; } },
        { Action::ToggleFullScreen, [](Viewer& v) { v.mIsFullScreen = !v.mIsFullScreen; } },
        { Action::Quit, [](Viewer& v) { v.mIsClosed = true; } },
        { Action::Open, [](Viewer& v) { v.mPanels.fileDialog.open(FilePurpose::Open); } },
        { Action::SaveDocument, [](Viewer& v) { v.saveDocumentFile(); } },
        { Action::SaveGltf, [](Viewer& v) { v.saveScene(); } },
        { Action::CopyDocument, [](Viewer& v) { v.copy(toJson(v.mDocument), "document"); } },
        { Action::CopyCamera, [](Viewer& v) { v.copy(toJson(v.mDocument.view.camera), "camera"); } },
        { Action::Paste, [](Viewer& v) { v.paste(); } },
        { Action::Reload, [](Viewer& v) { v.mStage->reload(); } },
        { Action::CancelLoading,
          [](Viewer& v) {
              if (v.isLoading()) v.mStage->cancel();
              v.mPanels.state.selectedNode.reset();
          } },
        { Action::Undo, [](Viewer& v) { v.mHistory.undo(v.mDocument); } },
        { Action::Redo, [](Viewer& v) { v.mHistory.redo(v.mDocument); } },
        { Action::FrameSelection, [](Viewer& v) { v.frame(v.boundsOfSelection()); } },
        { Action::FrameAll, [](Viewer& v) { v.frame(v.mStage->bounds()); } },
        { Action::ResetCamera,
          [](Viewer& v) {
              v.mDocument.view.camera = withPlaceOf(v.mDocument.view.camera, v.mFirstCamera);
              v.mHands.targetWorld = double3(0);
          } },
        { Action::ToggleParallel, [](Viewer& v) { v.toggleParallel(); } },
        { Action::AddBookmark, [](Viewer& v) { addBookmark(v.mDocument); } },
        { Action::AddPathKey,
          [](Viewer& v) {
              addKey(shownPath(v.mDocument, v.mPanels.state.path), v.mPanels.state.path, v.mDocument.view.camera);
          } },
        { Action::PlayPath, [](Viewer& v) { togglePathPlaying(v.mDocument, v.mPanels.state.path); } },
        { Action::HideSelection, [](Viewer& v) { v.hideSelection(); } },
        { Action::IsolateSelection,
          [](Viewer& v) {
              if (v.mPanels.state.selectedNode)
                  isolate(v.mDocument, sceneNodes(*v.mStage), *v.mPanels.state.selectedNode);
          } },
        { Action::ShowAll, [](Viewer& v) { showAll(v.mDocument); } },
        { Action::PlayPause, [](Viewer& v) { v.playOrPause(); } },
        { Action::MoveHandles, [](Viewer& v) { v.mGizmo.mode = GizmoMode::Move; } },
        { Action::RotateHandles, [](Viewer& v) { v.mGizmo.mode = GizmoMode::Rotate; } },
        { Action::ScaleHandles, [](Viewer& v) { v.mGizmo.mode = GizmoMode::Scale; } },
        { Action::NoHandles, [](Viewer& v) { v.mGizmo.mode = GizmoMode::Off; } },
        { Action::HandleAxes,
          [](Viewer& v) { v.mGizmo.axes = v.mGizmo.axes == GizmoAxes::Local ? GizmoAxes::World : GizmoAxes::Local; } },
        { Action::NextDebugView, [](Viewer& v) { showNextDebugView(v.mDocument); } },
        { Action::LockPixel, [](Viewer& v) { v.mInspector.toggleLock(); } },
        { Action::Compare, [](Viewer& v) { v.changeCompareMode(); } },
        { Action::CompareWith,
          [](Viewer& v) {
              v.mCompared.with =
                      v.mCompared.with == CompareWith::OtherApi ? CompareWith::PathTracer : CompareWith::OtherApi;
              if (v.mCompared.mode == CompareMode::Off) v.mCompared.mode = CompareMode::Wipe;
          } },
        { Action::ChangeBackend, [](Viewer& v) { v.setBackend(otherThan(v.mStage->engine().device().backend)); } },
        { Action::SavePicture, [](Viewer& v) { v.savePicture(); } },
        { Action::SavePictureAs,
          [](Viewer& v) {
              v.mPanels.fileDialog.open(FilePurpose::SavePicture, v.freshName(".png").filename().string());
          } },
        { Action::SaveFrame, [](Viewer& v) { v.saveFrame(); } },
    };
    static_assert(std::size(kRows) == static_cast<size_t>(Action::Count), "every action does something");
    touch();
    std::ranges::find(kRows, action, &Row::action)->perform(*this);
}

// ---------------------------------------------------------------------------------------------- time

double Viewer::idleSeconds() const {
    const bool moves = (mFramesToDraw > 0 && !isHidden()) || mHands.isMoving() || mDocument.playback.isPlaying ||
                       isLoading() || mPick || mCompared.isWaiting() || mNumerics.isWaiting() ||
                       (mPanels.requests.inspectsPixel && mInspector.isWaiting());
    const bool saves =
            mPictures.isBusy() || mSaver.isBusy() || mReadsFrame || mRecorder.isBusy() || mLightWork.isBusy();
    PanelState const& state = mPanels.state;
    const bool waits =
            state.path.isPlaying || mPanels.fileDialog.isReading() || mPanels.latency.isWaiting(secondsNow());
    return moves || saves || waits ? kShortWait : kLongWait; // files are looked at four times a second
}

void Viewer::play(double seconds) {
    if (playPath(mDocument, mPanels.state.path, seconds)) touch();
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
    const bool isLoadingNow = isLoading();
    if (std::exchange(mWasLoading, isLoadingNow) && !isLoadingNow) touch();
    if (isLoadingNow && secondsNow() >= mNextProgress) {
        mNextProgress = secondsNow() + kProgressSeconds;
        mFramesToDraw = std::max(mFramesToDraw, 1u);
    }
    if (std::exchange(mGeneration, mStage->generation()) != mStage->generation()) touch();
    if (!textureResidency(mStage->engine()).isSettled) touch(); // streamed textures arrive with frames
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
    const EngineStatistics statistics = mStage->engine().statistics();
    // Without a window frames are there as soon as they are drawn.
    mPanels.latency.look(mTarget.window ? statistics.presents : mPresents, statistics.lastPresentSeconds, secondsNow());
}

/// The inspector works while its panel is seen.
void Viewer::pollInspector() {
    const EngineOptions options = engineOptions(mStage->engine().device().backend);
    if (mInspector.follow(mPanels.requests.inspectsPixel, mDocument, options)) touch();
    for (std::string& message : mInspector.takeMessages()) note(std::move(message));
}

void Viewer::followRequests() {
    PanelRequests& requests = mPanels.requests;
    if (std::exchange(requests.cancelsLoading, false)) mStage->cancel();
    if (std::exchange(requests.framesSelection, false)) frame(boundsOfSelection());
    if (std::exchange(requests.togglesPixelLock, false)) mInspector.toggleLock();
    if (std::exchange(requests.togglesPixelExplanation, false)) mInspector.toggleExplanation();
    if (std::exchange(requests.recordsPath, false)) recordPath();
    if (std::exchange(requests.stopsRecording, false)) mRecorder.cancel();
    followFileDialog();
}

/// Between frames, since an action may end what the last one shows.
void Viewer::followActions() {
    for (const Action action : std::exchange(mPanels.requests.actions, {}))
        if (mStage) perform(action);
}

/// The engine is opened again with a trace of its jobs, or without: comparisons continue.
void Viewer::followRecording() {
    if (mRecordsJobs == mPanels.state.recordsJobs) return;
    mRecordsJobs = mPanels.state.recordsJobs;
    const CompareMode mode = mCompared.mode;
    setBackend(mStage->engine().device().backend);
    mCompared.mode = mode;
}

bool Viewer::step(double seconds) {
    const double begin = threadSeconds();
    if (mStage) followActions();
    if (mStage) followRecording();
    if (!mStage) return false;
    if (mInstruments.poll(mPanels, *mStage)) mFramesToDraw = std::max(mFramesToDraw, 1u);
    if (mHands.advance(seconds, mDocument.view.camera)) touch();
    play(seconds);
    pollLoads();
    pollSaving();
    pollPick();
    pollLatency();
    pollInspector();
    if (mLightWork.poll(mPanels, mDocument)) touch();
    for (std::string& message : mLightWork.takeMessages()) note(std::move(message));
    if (mNumerics.poll(*mStage)) touch();
    if (mPanels.poll()) touch();
    const double polled = threadSeconds();
    const bool hasDrawn = drawIfDue(seconds);
    mStepTime = { .other = polled - begin, .drawing = hasDrawn ? threadSeconds() - polled : 0 };
    return hasDrawn;
}

bool Viewer::drawIfDue(double seconds) {
    const bool hasWork = mFramesToDraw > 0 || mCompared.isWaiting() || mPanels.fileDialog.isReading();
    if (!hasWork || isHidden() || !mStage->renderer().canPresent(mChain)) return false;
    if (mFramesToDraw > 0) --mFramesToDraw;
    draw(seconds);
    if (!isLoading()) ++mCompleteFrames;
    if (mStage->shownFile() == mDocument.model.file) ++mModelFrames;
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
    if (std::optional<size_t> const& probe = mPanels.state.selectedProbe; probe && *probe < mDocument.probes.size()) {
        DocumentProbe const& shown = mDocument.probes[*probe];
        mOutline.box({ shown.centerWorld - double3(shown.halfExtentMeters),
                       shown.centerWorld + double3(shown.halfExtentMeters) },
                     { .color = { 0.3f, 0.7f, 1, 1 }, .widthPixels = 1, .depth = DebugDepth::Through });
    }
    if (!mPanels.state.selectedNode || mDocument.view.debugView == DebugView::Numerics) return; // it covers marks
    mOutline.box(boundsOfSelection(),
                 { .color = { 1, 0.62f, 0.1f, 1 }, .widthPixels = 2, .depth = DebugDepth::Through });
}

void Viewer::placePicture() {
    const float scale = mUi.fonts().Fonts.front()->FontSize / 13; // as Panels
    const PanelRect picture = layOutPanels(mTarget.pixels, scale, mPanels.state.showsPanels).picture;
    mOffset = uint2(picture.position);
    mDocument.view.size = max(uint2(picture.size), uint2(1));
}

FrameExtras Viewer::extras() const {
    FrameExtras extras;
    if (!mOutline.empty() && mCompared.mode == CompareMode::Off) extras.debugDraw = &mOutline;
    if (mDocument.view.size != mTarget.pixels)
        extras.viewport =
                Viewport{ .offset = mOffset, .contents = TargetContents::Clear, .clearColor = kBetweenPanels };
    return extras;
}

/// A frame around the pixel that stays.
void Viewer::drawLockedPixel() const {
    if (!mPanels.requests.inspectsPixel || !mInspector.locked()) return;
    const float2 at = float2(*mInspector.locked() + mOffset);
    ImGui::GetBackgroundDrawList()->AddRect({ at.x - 3, at.y - 3 }, { at.x + 4, at.y + 4 }, IM_COL32(0, 0, 0, 255));
    ImGui::GetBackgroundDrawList()->AddRect({ at.x - 2, at.y - 2 }, { at.x + 3, at.y + 3 },
                                            IM_COL32(255, 255, 255, 255));
}

void Viewer::draw(double seconds) {
    if (mInput.beginFrame()) touch(); // the rest of the events
    mUi.newFrame(mTarget.pixels, static_cast<float>(seconds));
    placePicture();
    mInstruments.beforePanels(mPanels, mDocument, *mStage, mCompared);
    mCompared.draw(*mUiRenderer, mStage->engine(), mOffset, mDocument.view.size);
    mNumerics.draw(mOffset, mDocument.view.size);
    mPanels.requests.inspectsPixel = false;
    mPanels.pixel = mInspector.report();
    mPanels.draw(mDocument, *mStage);
    followRequests();
    drawLockedPixel();
    mGizmo.draw(gizmoScene(), *ImGui::GetBackgroundDrawList(), mOffset, ImGui::GetIO().WantCaptureMouse);
    ImGui::Render();
    mHistory.note(mDocument, ImGui::IsAnyItemActive() || mGizmo.isDragging());
    mStage->apply(mDocument); // with what the panels changed
    drawOutline();
    mStage->render(mChain, extras());
    mNumerics.follow(*mStage, mChain, mOffset);
    const EngineOptions options = engineOptions(mStage->engine().device().backend);
    if (mCompared.follow(mDocument, *mStage, mChain, mOffset, options)) touch();
    mInstruments.afterFrame(mPanels, mDocument, mCompared, options);
    mLightWork.follow(mPanels, mDocument, *mStage, options, mOptions.out);
    mUiRenderer->render(*ImGui::GetDrawData(), mChain, mTarget.pixels);
    mStage->renderer().present(mChain);
    mPanels.collect(*mStage);
    ++mPresents;
    mPanels.latency.sent(secondsNow());
}

Result<Image> Viewer::screenshot() {
    if (!mStage) return fail(ErrorCode::DeviceUnavailable, "there is no picture: the viewer has no device any more");
    return mStage->renderer().waitPixels(mStage->renderer().readPixels(mChain));
}

} // namespace filament_core::view
