// SPDX-License-Identifier: Apache-2.0
/// outlineOf: what a piece of GLSL declares outside of its functions, and which macros it defines.
///   Out     in the order of the text, each with the line that `#line` directives give it.
///   Limits  no preprocessing: declarations count in all branches of #if.
///   Thread  any. Memory: the result. Never fails: of text that is no GLSL, something is returned.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

struct GlslDeclaration {
    enum class Kind : uint8_t { Function, Struct, Variable, Block, Macro };
    Kind kind = Kind::Variable;
    std::string name;
    std::string type{};                    ///< of functions: what they return, without qualifiers
    std::vector<std::string> parameters{}; ///< of functions: the types, without qualifiers; float3 is vec3
    bool isDefinition = true;              ///< false: a prototype of a function
    std::string file{};
    uint32_t line = 0;
};

std::vector<GlslDeclaration> outlineOf(std::string_view glsl, std::string_view file);

/// `#line NUMBER "file"`, after its first word. Leaves `file` as it is if the directive names none.
void readLineDirective(std::string_view rest, uint32_t& line, std::string_view& file);

} // namespace filament_core::shader
