// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-bake.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"

#include <filament_core/Light.h>

#include <filesystem>
#include <optional>

namespace filament_core::bake {

struct Options {
    std::filesystem::path model;
    std::filesystem::path out = "out";
    int workers = -1; ///< as JobSystemOptions::workers
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::bake
