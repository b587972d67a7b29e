// SPDX-License-Identifier: Apache-2.0
/// TransientPool: the textures, buffers and bind groups behind the transients of frame graphs, reused across passes and
/// frames.
///   In      descriptions and lifetimes.  Out: handles. Equal descriptions with disjoint lifetimes share a texture;
///           others share memory where the device can (DeviceFeatures::sharedMemory). The two textures of a history
///           never do.
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

namespace filament_core::backend {
class CommandStream;
}

namespace filament_core::framegraph {

/// From the first to the last use of a transient: groups of the graph.
struct UseInterval {
    uint32_t first = 0, last = 0;
};

/// A texture of acquire().
struct PooledTransient {
    backend::TextureHandle handle;
    uint32_t memory = 0; ///< equal for textures that share it
};

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
    /// A texture of this description that is free during `use`. Sharing wastes least if a graph requests its largest
    /// textures first (textureBytes()), and equal ones with ascending `first`.
    PooledTransient acquire(backend::DeviceTextureDesc const& desc, UseInterval use);
    /// A buffer that is free from `first` to `last`. Request the lifetimes of one graph with ascending `first`.
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
        uint32_t memory = 0; // of mMemories
        uint64_t lastGraph = 0;
        bool isCreated = false;
    };
    /// Of one texture, or of several that are not used at the same time.
    struct PooledMemory {
        uint64_t bytes = 0;    // of the texture that it was made for
        uint32_t textures = 0; // none: the entry is free
        bool isShareable = false;
        uint64_t lastGraph = 0;
        std::vector<UseInterval> uses; // in graph `lastGraph`
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

    bool isFree(PooledMemory const& memory, UseInterval use) const;
    /// How many groups before or after `use` nothing has it.
    uint32_t idleBeside(PooledMemory const& memory, UseInterval use) const;
    /// Of those that are free and large enough, the one that is idle for the fewest groups beside `use`; a new one, if
    /// there is none.
    uint32_t memoryFor(backend::DeviceTextureDesc const& desc, UseInterval use);
    uint32_t newMemory(uint64_t bytes, bool isShareable);
    /// A texture that the driver knows; none, if there is none yet.
    backend::TextureHandle createdIn(uint32_t memory) const;
    PooledTexture& addTexture(backend::DeviceTextureDesc const& desc, UseInterval use);
    KeptHistory newHistory(backend::DeviceTextureDesc const& desc);
    static void createHistory(backend::CommandBuffer& commands, KeptHistory& history);
    void destroy(backend::CommandBuffer& commands, KeptHistory const& history);

    backend::CommandStream& mStream;
    const uint32_t mKeepFrames;
    uint64_t mGraph = 1;
    std::vector<PooledTexture> mTextures;
    std::vector<PooledMemory> mMemories;
    std::vector<PooledBuffer> mBuffers;
    std::vector<KeptHistory> mHistories;
    std::vector<KeptHistory> mOutdated; // histories whose description changed: destroyed with the next evictions
    std::vector<PooledBindGroup> mBindGroups;
};

} // namespace filament_core::framegraph
