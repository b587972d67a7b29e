// SPDX-License-Identifier: Apache-2.0
/// A study as text: for the terminal, for docs/numerics.md, and for programs.
///   Thread  pure functions. Memory: the text. Deterministic for equal studies. Fails: never.
#pragma once

#include "tools/numerics/Study.h"

#include <string>

namespace filament_core::shader::numerics {

/// One line per row: the largest error of each column, followed by broken promises.
std::string terminalTable(Study const& study);
/// One line per row and column, with every count.
std::string csvOf(Study const& study);
std::string jsonOf(Study const& study);
/// docs/numerics.md.
std::string markdownOf(Study const& study);

/// "pow5(float)", "toneMap(vec3, int), ACES": the name of a row in the tables.
std::string titleOf(Row const& row);
/// All rows and columns together.
size_t violationCount(Study const& study);

} // namespace filament_core::shader::numerics
