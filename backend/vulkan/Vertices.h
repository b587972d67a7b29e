// SPDX-License-Identifier: Apache-2.0
/// Vertices: the sources of a program's vertex inputs.
///   Limits  attributes that the program does not read are skipped; those that the layout lacks come from a buffer of
///           zeros with stride 0 at slot kZeroBufferSlot, which makes them (0, 0, 0, 1).
///   Thread  any; a pure function.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Api.h"
#include "backend/vulkan/Spirv.h"

#include <array>
#include <span>

namespace filament_core::backend::vulkan {

inline constexpr uint32_t kZeroBufferSlot = kMaxVertexBuffers;

struct VertexInput {
    std::array<VkVertexInputAttributeDescription, 32> attributes{};
    std::array<VkVertexInputBindingDescription, kMaxVertexBuffers + 1> buffers{};
    uint32_t attributeCount = 0, bufferCount = 0;
    uint8_t bufferMask = 0; ///< bit i: slot i of CmdBindVertexBuffers is read
    bool readsZeros = false;
};
VertexInput vertexInputOf(VertexLayout const& layout, std::span<const ShaderInput> inputs);

} // namespace filament_core::backend::vulkan
