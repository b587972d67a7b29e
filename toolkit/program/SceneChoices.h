// SPDX-License-Identifier: Apache-2.0
/// SceneChoices: what --set names besides the options of View: how files are loaded, the dirt of the lens, and what
/// --sun has no place for.
///   Fails   setSceneChoice(): InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "toolkit/program/SceneOptions.h"

#include <filament_core/Options.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace filament_core::tools {

/// Options of a struct that have a prefix: "sun.haloSize".
struct PrefixedOptions {
    std::string_view prefix;
    std::span<const Option> options;
    void const* defaults; ///< a struct that nobody changed
};
std::span<const PrefixedOptions> prefixedOptions();

/// Nothing: the name is no choice of these.
std::optional<Result<void>> setSceneChoice(SceneOptions& options, std::string const& name, std::string const& value);

} // namespace filament_core::tools
