// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/RunViewer.h"

#include "toolkit/program/Console.h"
#include "toolkit/program/Program.h"
#include "toolkit/program/SceneFiles.h"
#include "tools/view/app/RecentFiles.h"
#include "tools/view/app/Viewer.h"
#include "tools/view/app/Window.h"
#include "tools/view/document/TextForms.h"

#include <filament_core/Image.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <future>
#include <optional>

namespace filament_core::view {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

Result<Document> documentOf(ViewerOptions const& options) {
    if (!options.document.empty()) return loadDocument(options.document);
    if (Result<void> made = tools::makeOutFolder(options); !made) return made.error();
    const Result<showcase::Files> files = tools::chooseFiles(options);
    if (!files) return files.error();
    return makeDocument(options, files->model, files->environment);
}

/// The camera path of the command line is its last one.
Result<Document> documentFor(ViewerOptions const& options) {
    if (options.cameraPath.empty()) return documentOf(options);
    Result<CameraPath> path = loadCameraPath(options.cameraPath);
    if (!path) return path.error();
    Result<Document> document = documentOf(options);
    if (document) document->paths.push_back(std::move(*path));
    return document;
}

/// Draws on a thread of its own; this one shows how far it is, and stops it on Ctrl-C.
Result<PathResult> drawWithProgress(PathRequest const& request) {
    const tools::StopOnInterrupt tidily;
    PathProgress progress;
    auto drawn = std::async(std::launch::async, [&] { return drawPath(request, progress); });
    while (drawn.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
        if (tools::isInterrupted()) progress.isCancelled = true;
        if (progress.total > 0)
            tools::showProgress(fmt::format("{} of {} frames", progress.done.load(), progress.total.load()));
    }
    tools::clearProgress();
    return drawn.get();
}

int drawFrames(ViewerOptions const& options) {
    Result<Document> document = documentFor(options);
    if (!document) return tools::failed(document.error());
    document->view.size = options.view.size;
    const PathRequest request{ .document = *document,
                               .path = document->paths.back(),
                               .series = options.series,
                               .engine = { .backend = options.backend,
                                           .workers = options.workers,
                                           .validation = options.validation,
                                           .exactShaders = options.exactShaders } };
    const Result<PathResult> drawn = drawWithProgress(request);
    if (!drawn && drawn.error().code == ErrorCode::Cancelled) { // by a signal, the only source
        tools::printError(drawn.error().message);
        return tools::kInterruptedStatus;
    }
    if (!drawn) return tools::failed(drawn.error());
    for (std::string const& message : drawn->messages) tools::printWarning(message);
    for (std::filesystem::path const& made : { options.series.folder, options.series.video })
        if (!made.empty()) std::printf("%u frames: %s\n", drawn->frames, made.c_str());
    return 0;
}

/// Of a run that ends by itself: whether its files could be loaded. At a window people see the message and go on.
Result<void> checkLoaded(ViewerOptions const& options, Viewer& viewer) {
    if (options.frames == 0 || viewer.isClosed() || !viewer.stage().loadError()) return {};
    return *viewer.stage().loadError();
}

/// Tells of frames, and prints what happened.
class Loop {
public:
    Loop(ViewerOptions const& options, Window& window, Viewer& viewer, Clock::time_point begin)
            : mOptions(options), mWindow(window), mViewer(viewer), mBegin(begin) {}

    void run() {
        Clock::time_point last = Clock::now();
        while (!isDone() && !tools::isInterrupted()) {
            for (InputEvent const& event : mWindow.takeEvents(mViewer.idleSeconds())) mViewer.handle(event);
            const Clock::time_point now = Clock::now();
            if (mOptions.frames > 0 && !mViewer.isLoading()) mViewer.redraw();
            if (!mViewer.isClosed()) openPanels();
            mViewer.step(std::chrono::duration<double>(now - last).count());
            last = now;
            printMessages();
            if (mViewer.isClosed()) break; // its stage may be gone
            followFullScreen();
            noteFrames();
        }
        mViewer.keepEdits();
        printMessages();
        if (mViewer.isClosed()) return;
        mViewer.stage().engine().waitIdle();
        noteFrames();
    }

private:
    /// The last frame shows what the comparison has found.
    bool isDone() {
        if (mOptions.frames == 0) return false;
        const bool isComparing = mOptions.compare != CompareMode::Off && mViewer.compared().isWaiting();
        if (isComparing) mLeastFrames = mViewer.completeFrames() + 2;
        return !isComparing && mViewer.completeFrames() >= std::max(mOptions.frames, mLeastFrames);
    }

    /// One at a time: the panels say when it is in front. A node is selected once the model is there.
    void openPanels() {
        PanelState& state = mViewer.panels().state;
        if (state.opensPanel.empty() && mOpened < mOptions.openPanels.size())
            state.opensPanel = mOptions.openPanels[mOpened++];
        if (mOptions.select.empty() || mHasSelected || mViewer.isLoading() || mViewer.stage().nodes().empty()) return;
        mHasSelected = true;
        const std::vector<SceneNode> nodes = sceneNodes(mViewer.stage());
        const auto found = std::ranges::find(nodes, mOptions.select, &SceneNode::name);
        if (found == nodes.end())
            tools::printWarning(fmt::format("--select {}: the model has no node of this name", mOptions.select));
        else
            state.selectedNode = static_cast<uint32_t>(found - nodes.begin());
    }

    void followFullScreen() {
        if (mIsFullScreen == mViewer.wantsFullScreen()) return;
        mIsFullScreen = mViewer.wantsFullScreen();
        mWindow.setFullScreen(mIsFullScreen);
    }

    /// The error of a load is the last line of a run that ends by itself.
    void printMessages() {
        const Result<void> loaded = checkLoaded(mOptions, mViewer);
        for (std::string const& message : mViewer.takeMessages())
            if (loaded || message != loaded.error().message) tools::printWarning(message);
    }

    /// When a frame came into the window, at most a step late.
    void noteFrames() {
        for (Milestone& each : mMilestones) {
            if (!each.presents && each.frames(mViewer) > 0) each.presents = mViewer.askedPresents();
            if (!each.presents || each.isNoted) continue;
            if (mViewer.stage().engine().statistics().presents < *each.presents) continue;
            each.isNoted = true;
            std::printf("%s in the window after %.3f s (%.3f s of all processors)\n", each.what, secondsSince(mBegin),
                        static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
            std::fflush(stdout);
        }
    }

    ViewerOptions const& mOptions;
    Window& mWindow;
    Viewer& mViewer;
    const Clock::time_point mBegin;
    struct Milestone {
        const char* what;
        uint32_t (*frames)(Viewer const&);
        std::optional<uint64_t> presents{}; ///< of the engine, once it is in the window
        bool isNoted = false;
    };
    std::array<Milestone, 3> mMilestones{
        Milestone{ "first frame", [](Viewer const& viewer) { return static_cast<uint32_t>(viewer.askedPresents()); } },
        Milestone{ "first frame with the model", [](Viewer const& viewer) { return viewer.modelFrames(); } },
        Milestone{ "first complete frame", [](Viewer const& viewer) { return viewer.completeFrames(); } },
    };
    bool mIsFullScreen = false, mHasSelected = false;
    size_t mOpened = 0;        ///< of ViewerOptions::openPanels
    uint32_t mLeastFrames = 0; ///< as ViewerOptions::frames
};

Result<void> show(ViewerOptions const& options) {
    const Clock::time_point begin = Clock::now();
    Result<Document> document = documentFor(options);
    if (!document) return document.error();
    Result<std::unique_ptr<Window>> window = Window::open("filament-view", options.view.size);
    if (!window) return window.error();
    const ViewerTarget target{ (*window)->display(), (*window)->native(), (*window)->pixels(), (*window)->scale(),
                               (*window)->clipboard() };
    Result<std::unique_ptr<Viewer>> viewer = Viewer::create(options, std::move(*document), target);
    if (!viewer) return viewer.error();
    if (!options.cameraPath.empty()) // the last one
        (*viewer)->panels().state.path.path = (*viewer)->document().paths.size() - 1;
    const tools::StopOnInterrupt tidily;
    Loop(options, **window, **viewer, begin).run();
    if (Result<void> loaded = checkLoaded(options, **viewer); !loaded) return loaded;
    if (options.screenshot.empty()) return {};
    const Result<Image> image = (*viewer)->screenshot();
    if (!image) return image.error();
    return savePng(options.screenshot, *image, OutputSpace::Srgb);
}

} // namespace

int runViewer(ViewerOptions const& given) {
    if (given.drawsPath()) return drawFrames(given);
    ViewerOptions options = given;
    options.recentFiles = recentFilesPath();
    const Result<void> shown = show(options);
    return shown ? 0 : tools::failed(shown.error());
}

} // namespace filament_core::view
