// SPDX-License-Identifier: Apache-2.0
/// Options: what filament-render's command line asks for, checked.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what would be right.
#pragma once

#include "base/Result.h"
#include "tools/common/SceneOptions.h"

#include <filament/Engine.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament::tools {

enum class PictureFormat : uint8_t { Png, Exr };

struct Options : SceneOptions {
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    std::string requireDevice;
    uint32_t frames = 1;
    std::vector<std::pair<std::string, std::string>> values; ///< of the parameters of a material
    uint32_t copies = 1;                                     ///< of the model, on a grid
    uint32_t tolerance = 0;                                  ///< in 1/255
    PictureFormat format = PictureFormat::Png;
    std::optional<double> seconds; ///< of the animation and of what materials see as time; none: at rest, 0
    std::string animation;         ///< name or index; empty: the first, if there is a time
    bool timing = false, explain = false, trace = false;
    std::filesystem::path traceJobs; ///< empty: none
    int workers = -1;                ///< as EngineOptions::workers
    ThreadAffinity affinity = ThreadAffinity::None;
    bool listDevices = false;
    std::optional<double> budgetMilliseconds; ///< device time of a frame: the quality is chosen to fit
    std::filesystem::path costs;              ///< table for that; empty: the library's
    std::filesystem::path measureCosts;       ///< where to write such a table of this scene; empty: nowhere
};

/// No value: the help text was asked for and is printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament::tools
