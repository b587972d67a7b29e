// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/FullPrecision.h"

#include "shaders/compiler/SpirvWords.h"

namespace filament_core::shader {
namespace {

bool isRelaxed(std::span<const uint32_t> instruction) {
    const auto op = static_cast<spv::Op>(instruction[0] & 0xFFFF);
    return (op == spv::OpDecorate && instruction[2] == spv::DecorationRelaxedPrecision) ||
           (op == spv::OpMemberDecorate && instruction[3] == spv::DecorationRelaxedPrecision);
}

} // namespace

std::vector<uint32_t> fullPrecision(std::span<const uint32_t> spirv) {
    std::vector<uint32_t> out(spirv.begin(), spirv.begin() + kModuleHeaderWords);
    for (size_t at = kModuleHeaderWords; at < spirv.size(); at += spirv[at] >> 16) {
        const auto instruction = spirv.subspan(at, spirv[at] >> 16);
        if (!isRelaxed(instruction)) out.insert(out.end(), instruction.begin(), instruction.end());
    }
    return out;
}

} // namespace filament_core::shader
