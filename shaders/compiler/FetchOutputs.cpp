// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/FetchOutputs.h"

#include "shaders/compiler/SpirvWords.h"

#include <map>
#include <set>
#include <vector>

namespace filament_core::shader {
namespace {

/// Positions in the module, as word indices, and what it declares.
struct Survey {
    size_t entryPoint = 0, annotationsEnd = 0, functions = 0;
    uint32_t vec4 = 0, outputVec4 = 0; ///< type ids
    std::set<uint32_t> inputIndices;
    std::set<uint32_t> outputLocations;
};

Survey survey(std::span<const uint32_t> words) {
    Survey found;
    std::map<uint32_t, uint32_t> locationOf;
    uint32_t float32 = 0;
    for (size_t at = kModuleHeaderWords; at < words.size() && found.functions == 0; at += words[at] >> 16) {
        const auto op = static_cast<spv::Op>(words[at] & 0xFFFF);
        const std::span<const uint32_t> operands = words.subspan(at + 1, (words[at] >> 16) - 1);
        if (found.annotationsEnd == 0 && op >= spv::OpTypeVoid && op <= spv::OpTypeForwardPointer)
            found.annotationsEnd = at;
        if (op == spv::OpEntryPoint) found.entryPoint = at;
        if (op == spv::OpFunction) found.functions = at;
        if (op == spv::OpDecorate && operands[1] == spv::DecorationInputAttachmentIndex)
            found.inputIndices.insert(operands[2]);
        if (op == spv::OpDecorate && operands[1] == spv::DecorationLocation) locationOf[operands[0]] = operands[2];
        if (op == spv::OpTypeFloat && operands[1] == 32) float32 = operands[0];
        if (op == spv::OpTypeVector && operands[1] == float32 && operands[2] == 4) found.vec4 = operands[0];
        const bool isOutputPointer = op == spv::OpTypePointer && operands[1] == spv::StorageClassOutput;
        if (isOutputPointer && operands[2] == found.vec4) found.outputVec4 = operands[0];
        const bool isOutput = op == spv::OpVariable && operands[2] == spv::StorageClassOutput;
        if (isOutput && locationOf.contains(operands[1])) found.outputLocations.insert(locationOf[operands[1]]);
    }
    return found;
}

constexpr uint32_t head(uint32_t wordCount, spv::Op op) { return wordCount << 16 | op; }

void copy(std::vector<uint32_t>& out, std::span<const uint32_t> words, size_t begin, size_t end) {
    const auto part = words.subspan(begin, end - begin);
    out.insert(out.end(), part.begin(), part.end());
}

} // namespace

std::vector<uint32_t> withFetchOutputs(std::span<const uint32_t> spirv) {
    Survey at = survey(spirv);
    uint32_t bound = spirv[kModuleBoundWord];
    std::vector<uint32_t> interface, annotations, globals;
    for (const uint32_t location : at.inputIndices) {
        if (at.outputLocations.contains(location)) continue;
        if (at.outputVec4 == 0) { // a subpass load returns vec4, so the type exists
            at.outputVec4 = bound++;
            globals.insert(globals.end(),
                           { head(4, spv::OpTypePointer), at.outputVec4, spv::StorageClassOutput, at.vec4 });
        }
        const uint32_t variable = bound++;
        interface.push_back(variable);
        annotations.insert(annotations.end(),
                           { head(4, spv::OpDecorate), variable, spv::DecorationLocation, location });
        globals.insert(globals.end(), { head(4, spv::OpVariable), at.outputVec4, variable, spv::StorageClassOutput });
    }

    const size_t entryEnd = at.entryPoint + (spirv[at.entryPoint] >> 16);
    std::vector<uint32_t> out;
    copy(out, spirv, 0, entryEnd);
    out.insert(out.end(), interface.begin(), interface.end());
    copy(out, spirv, entryEnd, at.annotationsEnd);
    out.insert(out.end(), annotations.begin(), annotations.end());
    copy(out, spirv, at.annotationsEnd, at.functions);
    out.insert(out.end(), globals.begin(), globals.end());
    copy(out, spirv, at.functions, spirv.size());
    out[at.entryPoint] += static_cast<uint32_t>(interface.size()) << 16;
    out[kModuleBoundWord] = bound;
    return out;
}

} // namespace filament_core::shader
