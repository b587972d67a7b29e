// SPDX-License-Identifier: Apache-2.0
/// The tables of the material language as Markdown, made from the tables that the compiler itself reads: for
/// docs/material-language.md, where each stands between <!-- begin: NAME --> and <!-- end: NAME -->. Also the words
/// that an editor should know.
///   Thread  any.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace filament_core::shader {

/// Name and text: properties, lists, types, attributes, filters, members, members-of-vertices, members-of-shading,
/// functions, helpers.
std::vector<std::pair<std::string, std::string>> languageTables();

/// Sorted, each once: properties, their values, types, members, functions of the engine.
std::vector<std::string> languageWords();

} // namespace filament_core::shader
