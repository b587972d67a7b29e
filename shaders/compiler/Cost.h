// SPDX-License-Identifier: Apache-2.0
/// Cost: counts the operations of a material's fragment stages, compared with the cheapest lit material.
///   Out     instructions of the optimised SPIR-V by kind, each counted once: regardless of loops, and before the
///           driver folds specialisation constants.
///   Thread  any. Fails: as compileMaterial(). Cost: two materials compiled.
#pragma once

#include "shaders/compiler/MaterialCompiler.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace filament_core::shader {

struct InstructionCounts {
    uint32_t arithmetic = 0;     ///< includes comparisons, conversions and selections without a branch
    uint32_t transcendental = 0; ///< includes roots and functions that contain them: normalize, length
    uint32_t control = 0;        ///< branches, calls, discards
    uint32_t memory = 0;         ///< loads and stores: uniforms, interpolants, outputs
    uint32_t fetches = 0;        ///< of textures; those of surfaces are there twice (BiasTextures.h), and one is run

    uint32_t sum() const { return arithmetic + transcendental + control + memory + fetches; }
    friend bool operator==(InstructionCounts const&, InstructionCounts const&) = default;
};

/// Of a valid SPIR-V module.
InstructionCounts countInstructions(std::span<const uint32_t> module);

/// A table as text: the terms in the material, and a row for each variant.
Result<std::string> costReport(std::string_view text, std::string_view fileName, CompileOptions options = {});

} // namespace filament_core::shader
