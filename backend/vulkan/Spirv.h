// SPDX-License-Identifier: Apache-2.0
/// Spirv: the inputs and outputs of a shader module, read from its words.
///   In      any bytes; a truncated or inconsistent module gives an error, never a crash or a hang.
///   Out     the locations and types of vertex inputs, the locations of fragment outputs.
///   Source  SPIR-V 1.6 specification, sections 2.3 (physical layout) and 3.52 (instructions).
///   Thread  any; a pure function.
///   Limits  the entry point is "main"; inputs are scalars, vectors, matrices and arrays of them, at locations 0..31.
///   Cost    one walk over the words.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::backend::vulkan {

enum class ScalarKind : uint8_t { Float, Int, UInt };

struct ShaderInput {
    uint32_t location = 0;
    ScalarKind kind = ScalarKind::Float;
    friend bool operator==(ShaderInput const&, ShaderInput const&) = default;
};

struct ShaderEdges {
    std::vector<ShaderInput> inputs; ///< ascending by location; a matrix has one per column
    uint32_t outputMask = 0;         ///< bit i: something is written at location i
};

/// `stage` is Vertex, Fragment or Compute, which has no edges. Corrupt names what is wrong with the module.
Result<ShaderEdges> readEdges(std::span<const uint32_t> words, ShaderStage stage);

} // namespace filament_core::backend::vulkan
