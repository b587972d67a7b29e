// SPDX-License-Identifier: Apache-2.0
/// PathFrames: draws a document along a camera path, at a fixed frame rate, to numbered images or to a video.
///   Frames   frame k shows the time k / framesPerSecond: the camera of the path, View::timeSeconds and a playing
///            animation move by that, whatever the drawing takes. Temporal effects accumulate these. So the same
///            document and path have the same bits on both APIs and on every run.
///   Out      frame-00000.png and so on, in a folder that is made if it is missing. Older files with such names are
///            replaced; others stay.
///   Thread   any: it makes an engine of its own, without a window, that ends before it returns.
///   Memory   two frames that are being encoded, beside the engine.
///   Fails    one line: what the engine, the files, the disk or ffmpeg refused; Cancelled.
#pragma once

#include "tools/view/app/PictureFile.h"
#include "tools/view/document/Document.h"
#include "tools/view/stage/Background.h"

#include <filament_core/Engine.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

inline constexpr uint32_t kMostFrames = 100'000;
inline constexpr double kLeastFrameRate = 0.01, kMostFrameRate = 1000;

struct FrameSeries {
    std::filesystem::path folder{}; ///< of the images; empty: only the video is kept
    std::filesystem::path video{};  ///< VideoFile.h; empty: none. It needs PNG
    PictureFormat format = PictureFormat::Png;
    double framesPerSecond = 30; ///< [kLeastFrameRate, kMostFrameRate]
};

struct PathRequest {
    Document document{}; ///< view.size is that of the frames
    CameraPath path{};
    FrameSeries series{};
    EngineOptions engine{}; ///< without a display
};

/// Shared with readers on other threads.
struct PathProgress {
    std::atomic<uint32_t> done{ 0 }, total{ 0 }; ///< frames; total 0: not known yet
    std::atomic<bool> isCancelled{ false };      ///< set: it ends with Cancelled
};

struct PathResult {
    uint32_t frames = 0;
    std::vector<std::string> messages{}; ///< of the stage: what a file lacks, say
};

/// "frame-00012.png"
std::string frameName(uint32_t frame, PictureFormat format);
/// InvalidArgument: the path has no keys, too many frames, a rate or a size out of range; NotFound: no ffmpeg.
Result<void> check(PathRequest const& request);
Result<PathResult> drawPath(PathRequest const& request, PathProgress& progress);

/// drawPath() beside a viewer.
///   Thread  one.   Life  the destructor cancels and waits for the frame that is being drawn or encoded.
class PathRecorder {
public:
    ~PathRecorder();
    bool start(PathRequest request); ///< false: one is being recorded
    void cancel() { mProgress.isCancelled = true; }
    bool isBusy() const { return mLines.has_value(); }
    PathProgress const& progress() const { return mProgress; }
    /// Once it is done: a line for each thing to know.
    std::optional<std::vector<std::string>> poll() { return takeFinished(mLines); }

private:
    PathProgress mProgress;
    std::optional<Background<std::vector<std::string>>> mLines;
};

} // namespace filament_core::view
