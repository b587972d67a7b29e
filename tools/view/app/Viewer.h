// SPDX-License-Identifier: Apache-2.0
/// Viewer: one window: the document that it shows, the stage that draws it, hands on its camera, and the panels over it.
///   In       events and time. Nothing here knows GLFW: without a native window it draws into a headless swap chain, and
///            tests act by events.
///   Draws    only what has changed: step() does nothing while nobody acts and nothing moves or loads.
///   Waits    not for the window: if it lags behind, step() comes back without drawing. Saving a picture waits for its
///            pixels, and a FLIP map is computed in step().
///   Thread   the main thread.
///   Fails    create(): as Stage::create(). Everything later becomes a message.
#pragma once

#include "tools/view/app/CameraHands.h"
#include "tools/view/app/ComparedPictures.h"
#include "tools/view/app/FrameSaver.h"
#include "tools/view/app/History.h"
#include "tools/view/app/ViewerOptions.h"
#include "tools/view/panels/Panels.h"
#include "tools/view/panels/Shortcuts.h"
#include "tools/view/stage/Stage.h"
#include "tools/view/ui/UiContext.h"
#include "tools/view/ui/UiRenderer.h"

#include <filament/DebugDraw.h>

#include <chrono>
#include <deque>
#include <memory>
#include <string>

namespace filament::view {

/// Where a viewer draws.
struct ViewerTarget {
    NativeDisplay display{};
    NativeWindow window{}; ///< none: headless
    uint2 pixels{ 1280, 720 };
    float scale = 1;
};

/// From the moment of an event until its frame was seen to be in the window, over the last frames, in milliseconds.
struct InputLatency {
    uint32_t frames = 0;
    double median = 0, worst = 0;
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
    /// How long nothing changes unless somebody acts: a caller may wait for events so long.
    double idleSeconds() const;

    void perform(Action action);
    void redraw() { touch(); } ///< the next step() draws
    /// The same document on the other API. It keeps the old one, with a message, if that fails.
    void setBackend(Backend backend);
    bool isClosed() const { return mIsClosed; }
    bool isLoading() const { return mStage->progress().isLoading; }
    bool wantsFullScreen() const { return mIsFullScreen; }

    Document& document() { return mDocument; }
    Stage& stage() { return *mStage; }
    Panels& panels() { return mPanels; }
    ComparedPictures const& compared() const { return mCompared; }
    /// Lines for people since the last call: failed loads, misuse of files, errors of the device.
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }
    uint32_t completeFrames() const { return mCompleteFrames; } ///< drawn while nothing was loading
    InputLatency latency() const;
    /// The last frame as the window has it, with the panels. Waits for it.
    Result<Image> screenshot();

private:
    using Clock = std::chrono::steady_clock;

    Viewer(ViewerOptions const& options, Document document, ViewerTarget const& target);
    EngineOptions engineOptions(Backend backend) const;
    Result<void> openStage(Backend backend);
    void closeStage();
    void resize(ResizeEvent const& event);
    void drop(DropEvent const& event);
    void open(std::filesystem::path const& file);
    void note(std::string message);
    void touch(); ///< something has changed: frames are to be drawn
    void play(double seconds);
    void pollLoads();
    void pollPick();
    void pollLatency();
    void followRequests();
    void draw(double seconds);
    void drawOutline();
    void hideSelection();
    Box boundsOfSelection() const;
    void frame(Box const& box);
    void toggleParallel();
    void playOrPause();
    void changeCompareMode();
    void saveDocumentFile();
    void savePicture();
    void saveFrame();
    std::filesystem::path freshName(const char* ending) const;

    ViewerOptions mOptions;
    ViewerTarget mTarget;
    Document mDocument;
    Camera mFirstCamera{};
    std::unique_ptr<Stage> mStage;
    Owned<SwapChain> mChain;
    UiContext mUi;
    std::optional<UiRenderer> mUiRenderer;
    Panels mPanels;
    History mHistory;
    ComparedPictures mCompared;
    FrameSaver mSaver;
    CameraHands mHands;
    DebugDraw mOutline;
    PickTicket mPick{};
    uint64_t mGeneration = 0;
    std::vector<std::string> mMessages;
    uint32_t mFramesToDraw = 0, mCompleteFrames = 0;
    std::optional<Clock::time_point> mOldestEvent; ///< that no frame shows yet
    struct Sent {
        uint64_t presents = 0; ///< EngineStatistics::presents once it is in the window
        Clock::time_point event{};
    };
    std::deque<Sent> mSent;
    uint64_t mPresents = 0; ///< asked for, of this engine
    std::deque<double> mLatencies;
    bool mIsClosed = false, mIsFullScreen = false, mWasLoading = false;
};

} // namespace filament::view
