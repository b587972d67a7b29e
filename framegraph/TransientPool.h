// SPDX-License-Identifier: Apache-2.0
/// TransientPool: the textures, buffers and bind groups behind the transients of frame graphs, reused across passes and
/// frames.
///   In      descriptions and lifetimes.  Out: handles. Equal descriptions with disjoint lifetimes share a texture;
///           the two textures of a history are never shared.
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
#include <string>
#include <string_view>
#include <vector>

namespace filament::backend {
class CommandStream;
}

namespace filament::framegraph {

/// The textures of FrameGraph::history().
struct PooledHistory {
    backend::TextureHandle previous, current;
    uint32_t age = 0; ///< see PassContext::historyAge()
};

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
    /// The same for a buffer.
    backend::BufferHandle acquire(backend::BufferDesc const& desc, uint32_t first, uint32_t last);
    /// The textures kept under desc.debugName, new ones if the description changed. `writes`: this graph writes the
    /// current one, which becomes the previous one at keepHistory().
    PooledHistory history(backend::DeviceTextureDesc const& desc, bool writes);
    /// See PassContext::bindGroup(). Records the creation if it is new.
    backend::BindGroupHandle bindGroup(backend::CommandBuffer& commands, backend::BindGroupDesc const& desc);

    /// Creates what acquire() promised since the last call.
    void recordCreations(backend::CommandBuffer& commands);
    /// All of the graph is recorded: what it wrote is what the next graph calls previous.
    void keepHistory();
    /// Destroys what has not been used for too long.
    void recordEvictions(backend::CommandBuffer& commands);
    void destroyAll(backend::CommandBuffer& commands);

    uint32_t textureCount() const { return static_cast<uint32_t>(mTextures.size()); } ///< without histories
    uint32_t bufferCount() const { return static_cast<uint32_t>(mBuffers.size()); }
    uint32_t historyCount() const { return static_cast<uint32_t>(mHistories.size()); }
    uint32_t bindGroupCount() const { return static_cast<uint32_t>(mBindGroups.size()); }

private:
    struct PooledTexture {
        backend::DeviceTextureDesc desc;
        backend::TextureHandle handle;
        uint64_t lastGraph = 0;
        uint32_t busyUntil = 0; // in graph `lastGraph`
        bool isCreated = false;
    };
    struct PooledBuffer {
        backend::BufferDesc desc;
        backend::BufferHandle handle;
        uint64_t lastGraph = 0;
        uint32_t busyUntil = 0; // in graph `lastGraph`
        bool isCreated = false;
    };
    struct KeptHistory {
        std::string name;
        backend::DeviceTextureDesc desc;
        std::array<backend::TextureHandle, 2> handles{};
        uint8_t previous = 0; // of the handles
        bool isCreated = false, isWritten = false;
        uint64_t lastGraph = 0, writtenGraph = 0; // 0: never
    };
    struct PooledBindGroup {
        backend::BindGroupLayout layout;
        std::array<backend::BindGroupEntry, backend::kMaxBindings> entries{};
        uint8_t count = 0;
        backend::BindGroupHandle handle;
        uint64_t lastGraph = 0;
    };

    template <class Pooled, class Desc>
    auto acquireFrom(std::vector<Pooled>& pooled, Desc const& desc, uint32_t first, uint32_t last);
    KeptHistory newHistory(backend::DeviceTextureDesc const& desc);
    static void createHistory(backend::CommandBuffer& commands, KeptHistory& history);
    void destroy(backend::CommandBuffer& commands, KeptHistory const& history);

    backend::CommandStream& mStream;
    const uint32_t mKeepFrames;
    uint64_t mGraph = 1;
    std::vector<PooledTexture> mTextures;
    std::vector<PooledBuffer> mBuffers;
    std::vector<KeptHistory> mHistories;
    std::vector<KeptHistory> mOutdated; // histories whose description changed: destroyed with the next evictions
    std::vector<PooledBindGroup> mBindGroups;
};

} // namespace filament::framegraph
