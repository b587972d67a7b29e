// SPDX-License-Identifier: Apache-2.0
#include "backend/api/Descriptions.h"

#include <algorithm>

namespace filament_core::backend {
namespace {

bool isUniform(BindingType type) {
    return type == BindingType::UniformBuffer || type == BindingType::DynamicUniformBuffer;
}

} // namespace

uint32_t layersOfLevel(DeviceTextureDesc const& desc, uint32_t level) {
    return desc.type == TextureKind::Texture3D ? std::max(1u, uint32_t{ desc.layers } >> level) : desc.layers;
}

uint32_t fullMipCount(DeviceTextureDesc const& desc) {
    const uint32_t depth = desc.type == TextureKind::Texture3D ? desc.layers : 1;
    return fullMipCount(std::max(desc.width, depth), desc.height);
}

uint64_t textureBytes(DeviceTextureDesc const& desc) {
    uint64_t bytes = 0;
    for (uint32_t level = 0; level < std::min<uint32_t>(desc.levels, 32); ++level) {
        const uint32_t width = std::max(1u, desc.width >> level), height = std::max(1u, desc.height >> level);
        bytes += imageBytes(desc.format, width, height) * layersOfLevel(desc, level);
    }
    return bytes * desc.samples;
}

uint8_t flatBinding(ProgramLayout const& layout, uint32_t group, uint8_t binding) {
    uint8_t uniforms = 0, textures = 0, storage = 0;
    for (uint32_t g = 0; g < kMaxBindGroups; ++g) {
        for (uint32_t i = 0; i < layout[g].count; ++i) {
            BindingDesc const& at = layout[g].bindings[i];
            const bool wanted = g == group && at.binding == binding;
            if (isUniform(at.type)) {
                if (wanted) return uniforms;
                ++uniforms;
            } else if (at.type == BindingType::SampledTexture) {
                if (wanted) return textures;
                ++textures;
            } else if (at.type == BindingType::StorageBuffer) {
                if (wanted) return storage;
                ++storage;
            }
        }
    }
    return 0xFF;
}

} // namespace filament_core::backend
