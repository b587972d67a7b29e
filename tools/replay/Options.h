// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-replay.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"

#include <filament_core/Backend.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::replay {

struct Options {
    std::filesystem::path folder;
    std::vector<Backend> backends;            ///< empty: every API that the folder has a trace of
    std::string requireDevice;                ///< part of the device's name
    std::filesystem::path out;                ///< images go here; empty: none are written
    std::filesystem::path step;               ///< what every draw left goes here; empty: no stepping
    std::optional<std::string> stopAfterPass; ///< number from 1, or name
    std::optional<uint32_t> stopAfterDraw;    ///< number within the frame, from 1
    std::optional<uint32_t> frame;            ///< number from 1; none: the last one of the trace
    bool list = false;
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::replay
