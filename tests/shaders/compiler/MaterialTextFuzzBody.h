// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer (tests/fuzz/MaterialTextFuzz.cpp) and the replay test: any text gives a material, or an error
/// with its position. Runs up to the GLSL that would be passed to glslang.
#pragma once

#include "base/Assert.h"
#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/Reflection.h"

#include <optional>
#include <string_view>

namespace filament_core::shader::test {

/// Every include exists and has the same text, so a file may include itself.
inline std::optional<std::string> includedByEverybody(std::string_view) {
    return "\"culling\" : \"none\", #include \"again.inc\"\n";
}

/// "file:line: reason"; the file may be an included one, whose name is as arbitrary as the text.
inline void expectReason(Error const& error) {
    const size_t reason = error.message.find(": ");
    FILAMENT_ASSERT(reason != std::string::npos && reason + 2 < error.message.size(),
                    "every refusal says where and why");
}

/// Whether GLSL was produced.
inline bool fuzzMaterialText(std::string_view text) {
    Result<MaterialText> parsed = parseMaterialText(text, "fuzz.mat", includedByEverybody);
    if (!parsed) return expectReason(parsed.error()), false;
    const Result<MaterialDefinition> definition = defineMaterial(std::move(*parsed), "fuzz.mat");
    if (!definition) return expectReason(definition.error()), false;
    FILAMENT_ASSERT(!parametersAsJson(*definition).empty(), "what is declared can be listed");
    const Result<MaterialNeeds> needs = findNeeds(*definition, includedByEverybody);
    if (!needs) return expectReason(needs.error()), false;
    const Result<std::string> vertex = generateVertex(*definition, *needs, 0, includedByEverybody);
    const Result<std::string> fragment = generateFragment(*definition, *needs, 0, includedByEverybody);
    return vertex.ok() && fragment.ok();
}

} // namespace filament_core::shader::test
