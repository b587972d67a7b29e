// SPDX-License-Identifier: Apache-2.0
/// What the compiler tests share: validation, disassembly and one analysis of SPIR-V.
#pragma once

#include <spirv-tools/libspirv.hpp>
#include <spirv_cross/spirv.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::shader::test {

/// Empty if SPIRV-Tools finds the module valid for Vulkan 1.1, else its complaint.
inline std::string validationErrors(std::span<const uint32_t> spirv) {
    std::string errors;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, spv_position_t const& at, const char* text) {
        errors += std::to_string(at.index) + ": " + text + "\n";
    });
    const bool valid = tools.Validate(spirv.data(), spirv.size());
    if (!valid && errors.empty()) errors = "invalid without a message";
    return errors;
}

inline std::string disassembly(std::span<const uint32_t> spirv) {
    std::string text;
    spvtools::SpirvTools(SPV_ENV_VULKAN_1_1)
            .Disassemble(spirv.data(), spirv.size(), &text, SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES);
    return text;
}

/// Of a fragment stage: its derivatives, and its fetches that need one for their level.
struct DerivativeUse {
    bool hasDiscard = false;
    size_t beforeDiscard = 0, afterDiscard = 0; ///< in the order of the text, with calls in place
};

class DerivativeSearch {
public:
    explicit DerivativeSearch(std::span<const uint32_t> spirv) {
        uint32_t function = 0;
        for (size_t at = 5; at < spirv.size() && spirv[at] >> 16 != 0; at += spirv[at] >> 16) {
            const auto op = static_cast<spv::Op>(spirv[at] & 0xffff);
            if (op == spv::OpEntryPoint) mMain = spirv[at + 2];
            if (op == spv::OpFunction) function = spirv[at + 2];
            mFunctions[function].push_back({ op, op == spv::OpFunctionCall ? spirv[at + 3] : 0 });
        }
    }

    DerivativeUse search() {
        visit(mMain);
        return mUse;
    }

private:
    static bool differentiates(spv::Op op) {
        return (op >= spv::OpDPdx && op <= spv::OpFwidthCoarse) || op == spv::OpImageQueryLod ||
               op == spv::OpImageSampleImplicitLod || op == spv::OpImageSampleDrefImplicitLod ||
               op == spv::OpImageSampleProjImplicitLod || op == spv::OpImageSampleProjDrefImplicitLod;
    }

    void visit(uint32_t function) {
        for (auto const& [op, called] : mFunctions[function]) {
            if (op == spv::OpFunctionCall) visit(called);
            if (op == spv::OpKill) mUse.hasDiscard = true;
            if (differentiates(op)) ++(mUse.hasDiscard ? mUse.afterDiscard : mUse.beforeDiscard);
        }
    }

    uint32_t mMain = 0;
    std::map<uint32_t, std::vector<std::pair<spv::Op, uint32_t>>> mFunctions; ///< 0: what stands before them
    DerivativeUse mUse;
};

inline DerivativeUse derivativeUse(std::span<const uint32_t> spirv) { return DerivativeSearch(spirv).search(); }

} // namespace filament_core::shader::test
