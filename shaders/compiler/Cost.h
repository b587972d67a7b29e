// SPDX-License-Identifier: Apache-2.0
/// Cost: what the fragment stages of a material do, counted, beside the cheapest lit material.
///   Out     instructions of the optimised SPIR-V by kind, each once: not how often a loop runs, and not what a driver
///           folds when the specialisation constants are known.
///   Thread  any. Fails: as compileMaterial(). Cost: two materials compiled.
#pragma once

#include "shaders/compiler/MaterialCompiler.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace filament::shader {

struct InstructionCounts {
    uint32_t arithmetic = 0;     ///< also comparisons, conversions and choices without a branch
    uint32_t transcendental = 0; ///< also roots, and what is made of them: normalize, length
    uint32_t control = 0;        ///< branches, calls, discards
    uint32_t memory = 0;         ///< loads and stores: uniforms, interpolants, outputs
    uint32_t fetches = 0;        ///< of textures

    uint32_t sum() const { return arithmetic + transcendental + control + memory + fetches; }
    friend bool operator==(InstructionCounts const&, InstructionCounts const&) = default;
};

/// Of a valid SPIR-V module.
InstructionCounts countInstructions(std::span<const uint32_t> module);

/// A table for people: the terms that are in, and a row for each variant.
Result<std::string> costReport(std::string_view text, std::string_view fileName, CompileOptions options = {});

} // namespace filament::shader
