// SPDX-License-Identifier: Apache-2.0
/// What the compiler tests share: validation and disassembly of SPIR-V.
#pragma once

#include <spirv-tools/libspirv.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace filament::shader::test {

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

} // namespace filament::shader::test
