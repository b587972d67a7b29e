// SPDX-License-Identifier: Apache-2.0
#include "framegraph/Memory.h"

#include <algorithm>

namespace filament_core::framegraph {

namespace {

/// Of one layer.
uint64_t bytesOfLevel(GraphTextureDesc const& desc, uint32_t level) {
    const uint64_t texels = uint64_t{ std::max(1u, desc.width >> level) } * std::max(1u, desc.height >> level);
    return texels * desc.samples * backend::formatInfo(desc.format).bytesPerBlock;
}

/// Of the textures before this one that are in its memory; 0 if there are none.
uint64_t largestBefore(CompiledGraph const& plan, size_t texture) {
    uint64_t largest = 0;
    for (size_t i = 0; i < texture && plan.textures[texture].memory != kNone; ++i) {
        if (plan.textures[i].memory == plan.textures[texture].memory)
            largest = std::max(largest, bytesOf(plan.graph->textures()[i].desc));
    }
    return largest;
}

} // namespace

uint64_t bytesOf(GraphTextureDesc const& desc) {
    uint64_t bytes = 0;
    for (uint32_t level = 0; level < desc.levels; ++level) bytes += bytesOfLevel(desc, level);
    return bytes * desc.layers;
}

AttachmentMemory attachmentMemory(CompiledGraph const& plan) {
    AttachmentMemory memory;
    for (size_t i = 0; i < plan.textures.size(); ++i) {
        TexturePlan const& texture = plan.textures[i];
        Texture const& declared = plan.graph->textures()[i];
        if (declared.isImported || !texture.lifetime.isUsed()) continue;
        const uint64_t bytes = bytesOf(declared.desc), largest = largestBefore(plan, i);
        const uint64_t shared = std::min(bytes, largest);
        memory.bytes += bytes - shared;
        memory.saved += shared;
        if (has(texture.usage, backend::TextureUsage::Transient)) memory.inTile += bytes - shared;
    }
    return memory;
}

uint64_t attachmentBytes(CompiledGraph const& plan, size_t pass) {
    if (!plan.passes[pass].runs()) return 0;
    uint64_t bytes = 0;
    for (Access const& access : plan.graph->accesses(plan.graph->passes()[pass])) {
        if (isAttachment(access.kind))
            bytes += bytesOfLevel(plan.graph->texture(access.texture).desc, access.range.level);
    }
    return bytes;
}

} // namespace filament_core::framegraph
