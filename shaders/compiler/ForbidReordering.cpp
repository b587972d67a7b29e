// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ForbidReordering.h"

#include "shaders/compiler/SpirvWords.h"

#include <set>

namespace filament_core::shader {
namespace {

/// Operations that a driver could compute in another way. They include functions: a driver may turn pow(x, 2) into x *
/// x, and in ESSL `precise` also affects the arguments of an expression, so both languages must forbid it.
bool canBeReordered(spv::Op op) {
    switch (op) {
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFNegate:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpExtInst:
        return true;
    default:
        return false;
    }
}

} // namespace

std::vector<uint32_t> forbidReordering(std::span<const uint32_t> spirv) {
    size_t firstType = 0;
    std::set<uint32_t> decorated, results;
    for (size_t at = kModuleHeaderWords; at < spirv.size(); at += spirv[at] >> 16) {
        const auto op = static_cast<spv::Op>(spirv[at] & 0xFFFF);
        if (firstType == 0 && isTypeDeclaration(op)) firstType = at;
        if (op == spv::OpDecorate && spirv[at + 2] == spv::DecorationNoContraction) decorated.insert(spirv[at + 1]);
        if (canBeReordered(op)) results.insert(spirv[at + 2]);
    }
    std::vector<uint32_t> out(spirv.begin(), spirv.begin() + static_cast<ptrdiff_t>(firstType));
    for (const uint32_t id : results) {
        // A second decoration of the same kind would make the module invalid.
        if (decorated.contains(id)) continue;
        out.insert(out.end(), { 3u << 16 | spv::OpDecorate, id, spv::DecorationNoContraction });
    }
    out.insert(out.end(), spirv.begin() + static_cast<ptrdiff_t>(firstType), spirv.end());
    return out;
}

} // namespace filament_core::shader
