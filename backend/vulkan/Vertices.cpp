// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Vertices.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

VkFormat zeroFormat(ScalarKind kind) {
    switch (kind) {
    case ScalarKind::Int:
        return VK_FORMAT_R32_SINT;
    case ScalarKind::UInt:
        return VK_FORMAT_R32_UINT;
    case ScalarKind::Float:
        break;
    }
    return VK_FORMAT_R32_SFLOAT;
}

void addBuffer(VertexInput& input, VertexLayout const& layout, uint8_t slot) {
    if ((input.bufferMask >> slot & 1) != 0) return;
    input.bufferMask = static_cast<uint8_t>(input.bufferMask | 1u << slot);
    VertexBufferLayout const& buffer = layout.buffers[slot];
    input.buffers[input.bufferCount++] = { slot, buffer.stride,
                                           buffer.perInstance ? VK_VERTEX_INPUT_RATE_INSTANCE
                                                              : VK_VERTEX_INPUT_RATE_VERTEX };
}

} // namespace

VertexInput vertexInputOf(VertexLayout const& layout, std::span<const ShaderInput> inputs) {
    VertexInput result;
    const auto attributes = std::span(layout.attributes).first(layout.attributeCount);
    for (ShaderInput const& input : inputs) {
        const auto source = std::ranges::find(attributes, input.location, &VertexAttribute::location);
        VkVertexInputAttributeDescription& target = result.attributes[result.attributeCount++];
        if (source != attributes.end()) {
            target = { input.location, source->buffer, native(source->format), source->offset };
            addBuffer(result, layout, source->buffer);
        } else {
            target = { input.location, kZeroBufferSlot, zeroFormat(input.kind), 0 };
            result.readsZeros = true;
        }
    }
    if (result.readsZeros) result.buffers[result.bufferCount++] = { kZeroBufferSlot, 0, VK_VERTEX_INPUT_RATE_VERTEX };
    return result;
}

} // namespace filament_core::backend::vulkan
