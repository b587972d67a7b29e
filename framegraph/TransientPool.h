// SPDX-License-Identifier: Apache-2.0
/// TransientPool: the textures and bind groups behind the transients of frame graphs, reused across passes and frames.
///   In      descriptions and lifetimes.  Out: handles. Equal descriptions with disjoint lifetimes share a texture.
///   Thread  one at a time.
///   Memory  device memory of everything used by one of the last `keepFrames` graphs; small lists on the heap that stop
///           growing after warm-up.
///   Fails   std::bad_alloc: the pool is unchanged except for promises to that graph. destroyAll() never fails; call it
///           before the end, or the destructor asserts.
///   Cost    a linear search over a few dozen entries for each transient.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/stream/CommandBuffer.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament::backend {
class CommandStream;
}

namespace filament::framegraph {

class TransientPool {
public:
    /// `keepFrames`: the number of consecutive graphs that may not use an object before it is destroyed.
    explicit TransientPool(backend::CommandStream& stream, uint32_t keepFrames = 16);
    ~TransientPool();
    TransientPool(TransientPool const&) = delete;
    TransientPool& operator=(TransientPool const&) = delete;

    backend::CommandStream& stream() { return mStream; }

    /// Starts a graph: every texture is free again.
    void beginGraph();
    /// A texture of this description that is free from `first` to `last`. Request the lifetimes of one graph with
    /// ascending `first`.
    backend::TextureHandle acquire(backend::DeviceTextureDesc const& desc, uint32_t first, uint32_t last);
    /// See PassContext::bindGroup(). Records the creation if it is new.
    backend::BindGroupHandle bindGroup(backend::CommandBuffer& commands, backend::BindGroupDesc const& desc);

    /// Creates what acquire() promised since the last call.
    void recordCreations(backend::CommandBuffer& commands);
    /// Destroys what has not been used for too long.
    void recordEvictions(backend::CommandBuffer& commands);
    void destroyAll(backend::CommandBuffer& commands);

    uint32_t textureCount() const { return static_cast<uint32_t>(mTextures.size()); }
    uint32_t bindGroupCount() const { return static_cast<uint32_t>(mBindGroups.size()); }

private:
    struct PooledTexture {
        backend::DeviceTextureDesc desc;
        backend::TextureHandle handle;
        uint64_t lastGraph = 0;
        uint32_t busyUntil = 0; // in graph `lastGraph`
        bool isCreated = false;
    };
    struct PooledBindGroup {
        backend::BindGroupLayout layout;
        std::array<backend::BindGroupEntry, backend::kMaxBindings> entries{};
        uint8_t count = 0;
        backend::BindGroupHandle handle;
        uint64_t lastGraph = 0;
    };

    backend::CommandStream& mStream;
    const uint32_t mKeepFrames;
    uint64_t mGraph = 1;
    std::vector<PooledTexture> mTextures;
    std::vector<PooledBindGroup> mBindGroups;
};

} // namespace filament::framegraph
