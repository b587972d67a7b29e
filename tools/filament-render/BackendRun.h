// SPDX-License-Identifier: Apache-2.0
/// runBackend: the frames of one command line on one backend, and all that was measured on the way.
///   In      checked options, paths that are not empty where there is something to load.
///   Out     the pixels of the last frame; the first frame is measured apart, the others overlap as they do in an
///           application: nothing waits for the device between them.
///   Thread  one run at a time.
///   Fails   DeviceUnavailable and what the loaders say; errors that the device reported while it drew are in `errors`.
#pragma once

#include "base/Result.h"
#include "tools/filament-render/Options.h"

#include <filament/QualityBudget.h>
#include <filament/Renderer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace filament::tools {

/// Milliseconds from the start of the run's step to its end.
struct StartTimes {
    double engine = 0, model = 0, environment = 0;
    double firstFrame = 0;        ///< render() until the device is idle
    double startToFirstFrame = 0; ///< all of the above and what is between them
};

/// One frame as the app thread saw it.
struct FrameSample {
    double milliseconds = 0;      ///< from one render() to the next
    uint64_t heapAllocations = 0; ///< of all threads in that time
};

struct BackendRun {
    Backend backend = Backend::Null;
    DeviceDescription device{};
    Image image{};
    std::string modelName;
    std::vector<std::string> warnings; ///< of the model
    std::vector<std::string> errors;   ///< of the device, one line each
    StartTimes start{};
    std::vector<FrameSample> samples;  ///< without the first frame
    double pipelinedMilliseconds = 0;  ///< a frame of those on average, until the device is idle
    std::vector<FrameTimings> timings; ///< one a frame, oldest first
    FrameStatistics statistics{};      ///< of the last frame
    EngineStatistics afterFirstFrame{}, atEnd{};
    std::string explanation;
    std::optional<QualityDecision> decision; ///< with --budget
    std::optional<QualityCosts> costs;       ///< with --measure-costs
};

/// Samples before this one belong to the warm-up. Three frames use every set of frame data once; the driver thread may
/// be two frames behind the app and the device two behind the driver, so that their rings have gone round by the
/// seventh.
inline constexpr size_t kWarmUpSamples = 7;

/// The names of files and of keys in reports: "vulkan", "gles".
const char* fileStem(Backend backend);

Result<BackendRun> runBackend(Options const& options, Backend backend, std::filesystem::path const& model,
                              std::filesystem::path const& environment);

} // namespace filament::tools
