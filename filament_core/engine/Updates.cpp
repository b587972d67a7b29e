// SPDX-License-Identifier: Apache-2.0
// New contents of buffers and textures that exist: recorded as uploads, which run between the frames before and after.
#include "backend/stream/RecordingGuards.h"
#include "filament_core/assets/image/MipMaps.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/scene/VertexPositions.h"

#include <algorithm>

namespace filament_core {

using namespace backend;
using engine::PublicCall;

namespace {

/// `part` elements from `first` lie in `count`.
void requireInside(uint64_t first, uint64_t part, uint64_t count, const char* what) {
    if (first > count || part > count - first)
        misused(fmt::format("{} {} to {} are changed, but there are {}", what, first, first + part, count));
}

void requireWhole(size_t bytes, size_t each, const char* what) {
    if (bytes == 0 || bytes % each != 0)
        misused(fmt::format("`data` has {} bytes, which is no whole number of {} of {} bytes", bytes, what, each));
}

/// The part of a texture that an update covers.
struct Region {
    Rect rect;
    uint32_t level, layer, layers;

    bool isWholeLevel0(DeviceTextureDesc const& desc) const {
        return level == 0 && layers == desc.layers && rect == Rect{ 0, 0, desc.width, desc.height };
    }
};

Region regionOf(DeviceTextureDesc const& desc, TextureUpdate const& update) {
    requireInside(update.level, 1, desc.levels, "levels");
    requireInside(update.firstLayer, update.layerCount, layersOfLevel(desc, update.level), "layers");
    const uint2 size(std::max(1u, desc.width >> update.level), std::max(1u, desc.height >> update.level));
    const uint2 part(update.size.x ? update.size.x : size.x - std::min(update.offset.x, size.x),
                     update.size.y ? update.size.y : size.y - std::min(update.offset.y, size.y));
    requireInside(update.offset.x, part.x, size.x, "columns");
    requireInside(update.offset.y, part.y, size.y, "rows");
    if (isCompressed(desc.format)) misused("a compressed texture is not changed in part; create another one");
    return { { static_cast<int32_t>(update.offset.x), static_cast<int32_t>(update.offset.y), part.x, part.y },
             update.level,
             update.firstLayer,
             update.layerCount };
}

CmdUploadTexture uploadOf(TextureHandle texture, Region const& region, std::span<const std::byte> bytes) {
    return { texture,
             static_cast<uint8_t>(region.level),
             static_cast<uint16_t>(region.layer),
             static_cast<uint16_t>(region.layers),
             region.rect,
             bytes };
}

/// sRGB is not encoded by drivers (Textures.cpp).
void uploadLevelsMadeHere(CommandBuffer& commands, TextureHandle texture, DeviceTextureDesc const& desc,
                          std::span<const std::byte> level0) {
    assets::Image base{ .width = desc.width, .height = desc.height, .layers = desc.layers };
    base.data.assign(level0.begin(), level0.end());
    const assets::Image mips = assets::withMipMaps(std::move(base), true);
    size_t offset = 0;
    for (uint32_t level = 0; level < desc.levels; ++level) {
        const uint32_t width = std::max(1u, desc.width >> level), height = std::max(1u, desc.height >> level);
        const Region region{ { 0, 0, width, height }, level, 0, desc.layers };
        const size_t bytes = imageBytes(desc.format, width, height) * desc.layers;
        commands.record(uploadOf(texture, region, std::span(mips.data).subspan(offset, bytes)));
        offset += bytes;
    }
}

} // namespace

void Engine::Impl::updateBuffer(BufferHandle buffer, uint64_t offset, std::span<const std::byte> data) {
    AllOrNothing all(pending);
    pending.record(CmdUpdateBuffer{ buffer, offset, data });
    // Before the commands are complete, since it may fail.
    contentVersions.changed(buffer);
    all.complete();
    ++instanceChanges;
}

void Engine::Impl::update(engine::VertexBufferState& state, std::span<const std::byte> data, uint32_t firstVertex,
                          uint32_t part) {
    requireInside(part, 1, state.layout.bufferCount, "streams");
    const size_t stride = state.layout.buffers[part].stride;
    requireWhole(data.size(), stride, "vertices");
    requireInside(firstVertex, data.size() / stride, state.vertexCount, "vertices");
    updateBuffer(part == 0 ? state.handle : state.streams[part - 1], firstVertex * stride, data);
    if (!scene::hasPositions(state.layout, static_cast<uint8_t>(part))) return;
    const scene::MinMax changed = scene::boundsOf(state.layout, data, static_cast<uint8_t>(part));
    // After a change in part, bounds only grow: which vertex reached the old ones is not known.
    if (data.size() / stride == state.vertexCount) state.bounds = {};
    if (!changed.empty()) state.bounds.add(changed.min), state.bounds.add(changed.max);
    state.boundsVersion = ++boundsChanges;
}

void Engine::Impl::update(engine::IndexBufferState const& state, std::span<const std::byte> data, uint32_t firstIndex) {
    const size_t each = state.format == IndexFormat::UInt16 ? 2 : 4;
    requireWhole(data.size(), each, "indices");
    requireInside(firstIndex, data.size() / each, state.indexCount, "indices");
    updateBuffer(state.handle, firstIndex * each, data);
}

void Engine::Impl::update(engine::TextureState& state, TextureUpdate const& update) {
    backend::DeviceTextureDesc const& desc = state.desc;
    const Region region = regionOf(desc, update);
    const uint64_t bytes = imageBytes(desc.format, region.rect.width, region.rect.height) * region.layers;
    if (update.pixels.size() != bytes)
        misused(fmt::format("`pixels` has {} bytes, but the part that is changed has {}", update.pixels.size(), bytes));
    if (update.generateMips && desc.type == TextureKind::Texture3D)
        misused("the mip levels of a 3D texture are not computed; give each level");
    const bool isSrgb = formatInfo(desc.format).isSrgb;
    if (update.generateMips && isSrgb && !region.isWholeLevel0(desc))
        misused("the mip levels of an sRGB texture are computed from all of level 0; give all of it, or each level");
    if (!state.handle) return; // larger than the device allows: create() reported it
    AllOrNothing all(pending);
    if (update.generateMips && isSrgb) {
        uploadLevelsMadeHere(pending, state.handle, desc, update.pixels);
    } else {
        pending.record(uploadOf(state.handle, region, update.pixels));
        if (update.generateMips && desc.levels > 1) pending.record(CmdGenerateMips{ state.handle });
    }
    contentVersions.changed(state.handle);
    all.complete();
    state.hasContents = true;
    ++instanceChanges;
}

void Engine::update(VertexBuffer buffer, std::span<const std::byte> data, uint32_t firstVertex, uint32_t stream) {
    const PublicCall call(mImpl, "Engine::update(VertexBuffer, span<byte>, uint32_t, uint32_t)");
    engine::VertexBufferState& state = mImpl->vertexBuffers.get(buffer);
    mImpl->orReport("updating vertex buffer", state.name, [&] { mImpl->update(state, data, firstVertex, stream); });
}

void Engine::update(IndexBuffer buffer, std::span<const std::byte> data, uint32_t firstIndex) {
    const PublicCall call(mImpl, "Engine::update(IndexBuffer, span<byte>, uint32_t)");
    engine::IndexBufferState const& state = mImpl->indexBuffers.get(buffer);
    mImpl->orReport("updating index buffer", state.name, [&] { mImpl->update(state, data, firstIndex); });
}

void Engine::update(Texture texture, TextureUpdate const& update) {
    const PublicCall call(mImpl, "Engine::update(Texture, TextureUpdate)");
    engine::TextureState& state = mImpl->textures.get(texture);
    mImpl->orReport("updating texture", state.name, [&] { mImpl->update(state, update); });
}

} // namespace filament_core
