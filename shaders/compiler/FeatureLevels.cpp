// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/FeatureLevels.h"

#include "shaders/compiler/CodeScan.h"

namespace filament_core::shader {
namespace {

// ESSL 3.10 specification, chapter 8: functions that earlier versions lack.
constexpr std::string_view kOfEssl310[] = {
    "bitCount",       "bitfieldExtract", "bitfieldInsert",      "bitfieldReverse", "findLSB",
    "findMSB",        "frexp",           "imulExtended",        "ldexp",           "packSnorm4x8",
    "packUnorm4x8",   "textureGather",   "textureGatherOffset", "uaddCarry",       "umulExtended",
    "unpackSnorm4x8", "unpackUnorm4x8",  "usubBorrow",
};

Result<void> checkBlock(GlslBlock const& block, uint32_t level) {
    const CodeScan code(block.text);
    for (const std::string_view word : kOfEssl310) {
        const std::optional<uint32_t> line = code.lineOfCall(word);
        if (!line) continue;
        return errorAt(
                { block.at.file, block.at.line + *line },
                fmt::format("'{}' came with ESSL 3.10, which featureLevel {} does not have; use featureLevel : 2", word,
                            level));
    }
    return {};
}

} // namespace

Result<void> checkFeatureLevel(MaterialDefinition const& definition) {
    const uint32_t level = definition.package.featureLevel;
    if (level >= 2) return {};
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        if (definition.package.parameters[i].type == ParameterType::SamplerCubeArray)
            return errorAt(definition.parameterSources[i].at,
                           "a samplerCubemapArray needs featureLevel : 2 (table 13 of the guide)");
    }
    if (Result<void> fragment = checkBlock(definition.fragment, level); !fragment) return fragment;
    return definition.vertex ? checkBlock(*definition.vertex, level) : Result<void>{};
}

} // namespace filament_core::shader
