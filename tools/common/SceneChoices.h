// SPDX-License-Identifier: Apache-2.0
/// SceneChoices: what --set names besides the options of View: how files are loaded, the dirt of the lens, and what
/// --sun has no place for.
///   Fails   setSceneChoice(): InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "tools/common/SceneOptions.h"

#include <span>
#include <string_view>

namespace filament::tools {

struct SceneChoice {
    std::string_view name;
    std::string_view values;  ///< for documents: "on, off"
    std::string_view initial; ///< the value without --set, as text; empty: none
    std::string_view effect;  ///< for documents: one phrase of Markdown
};

std::span<const SceneChoice> sceneChoices();

/// Nothing: the name is no choice of these.
std::optional<Result<void>> setSceneChoice(SceneOptions& options, std::string const& name, std::string const& value);

} // namespace filament::tools
