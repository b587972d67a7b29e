// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Quirks.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

uint32_t uniformBuffersIn(BindGroupLayout const& layout, ShaderStage stage, bool dynamicOnly) {
    const auto bindings = std::span(layout.bindings).first(layout.count);
    return static_cast<uint32_t>(std::ranges::count_if(bindings, [&](BindingDesc const& each) {
        const bool isUniform = each.type == BindingType::DynamicUniformBuffer ||
                               (each.type == BindingType::UniformBuffer && !dynamicOnly);
        return isUniform && (native(each.stages) & native(stage)) != 0;
    }));
}

} // namespace

Quirks Quirks::of(VkDriverId driver) {
    const bool isLavapipe = driver == VK_DRIVER_ID_MESA_LLVMPIPE;
    return { .spoilsFourthUniforms = isLavapipe,
             .inlinesUniforms = isLavapipe,
             .clearsIndependentBlend = isLavapipe,
             .convertsSrgbOfBlocks = isLavapipe };
}

uint32_t spareBindings(BindGroupLayout const& layout,
                       std::span<VkDescriptorSetLayoutBinding, kMaxSpareBindings> bindings) {
    constexpr uint32_t kSpoilt = 4;
    const auto spare = [&](ShaderStage stage) {
        const uint32_t used = uniformBuffersIn(layout, stage, false);
        return uniformBuffersIn(layout, stage, true) == 0 || used >= kSpoilt ? 0 : kSpoilt - used;
    };
    const uint32_t vertex = spare(ShaderStage::Vertex);
    const uint32_t fragment = spare(ShaderStage::Fragment);
    uint32_t next = 0; // drivers number buffers in binding order: after all others
    for (uint32_t i = 0; i < layout.count; ++i) next = std::max(next, layout.bindings[i].binding + 1u);
    uint32_t count = 0;
    const auto add = [&](uint32_t descriptors, ShaderStage stages) {
        if (descriptors == 0) return;
        bindings[count] = { next + count, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, descriptors, native(stages), nullptr };
        ++count;
    };
    const uint32_t both = std::min(vertex, fragment);
    add(both, ShaderStage::Both);
    add(std::max(vertex, fragment) - both, vertex > fragment ? ShaderStage::Vertex : ShaderStage::Fragment);
    return count;
}

uint32_t colorReferences(Quirks const& quirks, PassLayout const& layout) {
    return quirks.clearsIndependentBlend && layout.colorCount == 0 ? 1 : layout.colorCount;
}

} // namespace filament_core::backend::vulkan
