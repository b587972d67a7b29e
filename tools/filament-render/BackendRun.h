// SPDX-License-Identifier: Apache-2.0
/// runBackend: draws the frames of one command line on one backend and returns all measurements.
///   In      checked options, and paths that are not empty if there is something to load.
///   Out     the pixels of the last frame. The first frame is measured separately; the others overlap as in an
///           application: nothing waits for the device between them.
///   Thread  one run at a time.
///   Fails   DeviceUnavailable and errors of the loaders; errors that the device reported while drawing are in
///           `errors`.
#pragma once

#include "base/Result.h"
#include "tools/filament-render/Options.h"

#include <filament_core/EnvironmentLights.h>
#include <filament_core/ExplainPixel.h>
#include <filament_core/QualityBudget.h>
#include <filament_core/Renderer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::tools {

/// Milliseconds that each step of the start took.
struct StartTimes {
    double engine = 0, model = 0, environment = 0;
    double firstFrame = 0;        ///< render() until the device is idle
    double startToFirstFrame = 0; ///< all of the above and the time in between
};

/// One frame as seen by the app thread.
struct FrameSample {
    double milliseconds = 0;      ///< from one render() to the next
    uint64_t heapAllocations = 0; ///< of all threads in that time
};

struct BackendRun {
    Backend backend = Backend::Null;
    DeviceDescription device{};
    Image image{};
    std::vector<Image> aovs{};                   ///< by Options::aovs
    std::optional<Shares> shares{};              ///< of Options::shares
    std::optional<PixelExplanation> explained{}; ///< of Options::explainPixel
    std::string modelName;
    bool usesModelEnvironment = false; ///< the model's own, instead of a file
    EnvironmentLights lights{};        ///< of the environment
    std::vector<std::string> warnings; ///< of the model
    std::vector<std::string> errors;   ///< of the device, one line each
    StartTimes start{};
    std::vector<FrameSample> samples;  ///< without the first frame
    double pipelinedMilliseconds = 0;  ///< average time of those frames, until the device is idle
    std::vector<FrameTimings> timings; ///< one per frame, oldest first
    FrameStatistics statistics{};      ///< of the last frame
    EngineStatistics afterFirstFrame{}, atEnd{};
    std::string explanation;
    std::vector<EffectDecision> decisions;   ///< of the last frame
    std::optional<QualityDecision> decision; ///< with --budget
    std::optional<QualityCosts> costs;       ///< with --measure-costs
};

/// Samples before this one belong to the warm-up. Three frames use every set of frame data once; the driver thread may
/// be two frames behind the app and the device two behind the driver, so their rings have wrapped around by the
/// seventh.
inline constexpr size_t kWarmUpSamples = 7;

/// Used in file names and as keys in reports: "vulkan", "gles".
const char* fileStem(Backend backend);

/// What the command line says about any engine.
EngineOptions engineOptionsOf(Options const& options);

/// Draws the frames of the command line on a given engine, and returns the last one.
Result<Image> drawPicture(Engine& engine, Options const& options, std::filesystem::path const& model,
                          std::filesystem::path const& environment);

Result<BackendRun> runBackend(Options const& options, Backend backend, std::filesystem::path const& model,
                              std::filesystem::path const& environment);

} // namespace filament_core::tools
