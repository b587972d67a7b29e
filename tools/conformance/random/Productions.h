// SPDX-License-Identifier: Apache-2.0
/// Productions: the expressions of the material language, as a table: the type of the result, the text, the types of
/// its arguments. The generator draws from it.
///   Out     one row per type: "F" in the table below stands for float, vec2, vec3 and vec4, and so on.
///   Left out  what an author cannot write in a material, and code whose meaning GLSL gives up on purpose and
///           docs/materials-undefined.md does not define (its last paragraph).
///   Thread  any; pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace filament_core::conformance {

struct Production {
    std::string type;                   ///< of the result
    std::string text;                   ///< $0 to $9: the arguments
    std::vector<std::string> arguments; ///< types, or "index": an int that may not be a constant out of range
    bool inVertex = true;               ///< all are in fragment blocks
    int featureLevel = 1;
};

/// Operators and built-in functions, for both stages unless they say otherwise.
std::vector<Production> const& languageProductions();

/// "F" of 3 components is vec3; letters: F float, I int, U uint, B bool; M mat of 2 to 4 columns.
std::string typeName(char family, int components);
/// "vec3": 3; "float": 1.
int componentsOf(std::string_view type);

} // namespace filament_core::conformance
