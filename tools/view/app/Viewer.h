// SPDX-License-Identifier: Apache-2.0
/// Viewer: one window: the document that it shows, the stage that draws it, hands on its camera, and the panels over
/// it.
///   In       events and time. Nothing here knows GLFW: without a native window it draws into a headless swap chain,
///            and tests act by events.
///   Draws    only what has changed: step() does nothing without input, motion or loading. While files load
///            and nothing else happens it draws their progress four times a second: the device may be the processor
///            that loads them.
///   Picture  Document::view.size is what the panels leave free of the window; events count pixels of the window.
///   Waits    for nothing: if the window lags behind, step() comes back without drawing.
///   Thread   the main thread.
///   Fails    create(): as Stage::create(). Everything later becomes a message.
#pragma once

#include "tools/view/app/CameraHands.h"
#include "tools/view/app/ComparedPictures.h"
#include "tools/view/app/FrameSaver.h"
#include "tools/view/app/GizmoHands.h"
#include "tools/view/app/History.h"
#include "tools/view/app/Instruments.h"
#include "tools/view/app/LightWork.h"
#include "tools/view/app/NumericsCounter.h"
#include "tools/view/app/PathFrames.h"
#include "tools/view/app/PictureSaver.h"
#include "tools/view/app/PixelInspector.h"
#include "tools/view/app/RecentFiles.h"
#include "tools/view/app/StepTime.h"
#include "tools/view/app/UiInput.h"
#include "tools/view/app/ViewerOptions.h"
#include "tools/view/panels/Panels.h"
#include "tools/view/panels/Shortcuts.h"
#include "tools/view/stage/Stage.h"
#include "tools/view/ui/UiContext.h"
#include "tools/view/ui/UiRenderer.h"

#include <filament_core/DebugDraw.h>

#include <memory>
#include <string>

namespace filament_core::view {

/// Where a viewer draws.
struct ViewerTarget {
    NativeDisplay display{};
    NativeWindow window{}; ///< none: headless
    uint2 pixels{ 1280, 720 };
    float scale = 1;
    Clipboard clipboard{}; ///< none: texts are copied within the viewer
};

class Viewer {
public:
    static Result<std::unique_ptr<Viewer>> create(ViewerOptions const& options, Document document,
                                                  ViewerTarget const& target);
    ~Viewer();
    Viewer(Viewer const&) = delete;
    Viewer& operator=(Viewer const&) = delete;

    void handle(InputEvent const& event);
    /// Lets time pass, and draws a frame if something has changed. Whether it did.
    bool step(double seconds);
    StepTime const& lastStep() const { return mStepTime; }
    /// How long nothing changes without input: a caller may wait for events so long.
    double idleSeconds() const;

    void perform(Action action);
    void redraw() { touch(); } ///< the next step() draws
    /// The same document on this API. It keeps the old one, with a message, if that fails; if neither can be opened any
    /// more, it saves the document, says where, and is closed.
    void setBackend(Backend backend);
    bool isClosed() const { return mIsClosed; }
    /// For the end of a window: a document with edits that no file has goes to last.json beside the recent files; a
    /// message reports it.
    void keepEdits();
    bool isLoading() const { return mStage && mStage->progress().isLoading; }
    bool wantsFullScreen() const { return mIsFullScreen; }

    Document& document() { return mDocument; }
    /// This and what needs it: not after setBackend() has closed the viewer.
    Stage& stage() { return *mStage; }
    Panels& panels() { return mPanels; }
    GizmoHands& gizmo() { return mGizmo; }
    GizmoScene gizmoScene() { return { mDocument, *mStage, mPanels.state, mHands.targetWorld }; }
    ComparedPictures const& compared() const { return mCompared; }
    LightWork const& lightWork() const { return mLightWork; }
    NumericsCounter const& numerics() const { return mNumerics; }
    PixelInspector const& inspector() const { return mInspector; }
    /// Lines for people since the last call: failed loads, misuse of files, errors of the device.
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }
    uint32_t completeFrames() const { return mCompleteFrames; } ///< drawn while nothing was loading
    uint32_t modelFrames() const { return mModelFrames; }       ///< drawn with the model of the document
    /// From an input until its frame was in the window, in milliseconds.
    Percentiles latency() const { return mPanels.latency.milliseconds(); }
    /// Frames of this engine that were sent to the window; EngineStatistics::presents says how many are there.
    uint64_t askedPresents() const { return mPresents; }
    /// The last frame as the window has it, with the panels. Waits for it. DeviceUnavailable: it was closed by
    /// setBackend().
    Result<Image> screenshot();

private:
    Viewer(ViewerOptions const& options, Document document, ViewerTarget const& target);
    EngineOptions engineOptions(Backend backend) const;
    Result<void> openStage(Backend backend);
    void closeStage();
    void resize(ResizeEvent const& event);
    void open(std::filesystem::path const& file);
    void openPicture(std::filesystem::path const& file);
    void followFileDialog();
    void copy(std::string const& text, const char* what);
    void paste();
    void note(std::string message);
    bool isHidden() const { return mTarget.pixels.x == 0 || mTarget.pixels.y == 0; }
    void touch(); ///< something has changed: frames are to be drawn
    void play(double seconds);
    void pollLoads();
    void pollPick();
    void pollLatency();
    void pollSaving();
    void pollInspector();
    void drawLockedPixel() const;
    void followRequests();
    void placePicture(); ///< between the panels
    FrameExtras extras() const;
    void followActions();
    void followRecording();
    bool drawIfDue(double seconds);
    void draw(double seconds);
    void drawOutline();
    void hideSelection();
    Box boundsOfSelection() const;
    void frame(Box const& box);
    void toggleParallel();
    void playOrPause();
    void changeCompareMode();
    void saveDocumentFile();
    void saveScene();
    void savePicture();
    void saveFrame();
    void recordPath();
    std::filesystem::path freshName(const char* ending) const;

    ViewerOptions mOptions;
    ViewerTarget mTarget;
    Document mDocument;
    Document mSaved; ///< as it was opened, or saved last
    Camera mFirstCamera{};
    std::unique_ptr<Stage> mStage;
    Owned<SwapChain> mChain;
    UiContext mUi;
    UiInput mInput; ///< of the context
    std::optional<UiRenderer> mUiRenderer;
    Panels mPanels;
    History mHistory;
    ComparedPictures mCompared;
    RecentFiles mRecent;
    PictureSaver mPictures;
    NumericsCounter mNumerics;
    PixelInspector mInspector;
    FrameSaver mSaver;
    PathRecorder mRecorder;
    Instruments mInstruments;
    LightWork mLightWork;
    CameraHands mHands;
    GizmoHands mGizmo;
    DebugDraw mOutline;
    PickTicket mPick{};
    uint64_t mGeneration = 0;
    std::vector<std::string> mMessages;
    uint32_t mFramesToDraw = 0, mCompleteFrames = 0, mModelFrames = 0;
    double mNextProgress = 0; ///< when the progress of loads is drawn again, by secondsNow()
    StepTime mStepTime;
    uint2 mOffset{ 0 };       ///< of the image in the window
    uint2 mChainPixels{ 0 };  ///< of the swap chain
    uint64_t mPresents = 0;   ///< asked for, of this engine
    bool mReadsFrame = false; ///< that is to be saved
    bool mIsClosed = false, mIsFullScreen = false, mWasLoading = false;
    bool mRecordsJobs = false; ///< the engine does
};

} // namespace filament_core::view
