// SPDX-License-Identifier: Apache-2.0
#include "framegraph/TransientPool.h"

#include "backend/stream/CommandStream.h"
#include "base/Assert.h"

#include <algorithm>

namespace filament::framegraph {
namespace {

bool isSameButForTheName(backend::DeviceTextureDesc const& a, backend::DeviceTextureDesc const& b) {
    return a.type == b.type && a.format == b.format && a.usage == b.usage && a.samples == b.samples &&
           a.levels == b.levels && a.layers == b.layers && a.width == b.width && a.height == b.height;
}

} // namespace

TransientPool::TransientPool(backend::CommandStream& stream, uint32_t keepFrames)
        : mStream(stream), mKeepFrames(keepFrames) {}

TransientPool::~TransientPool() {
    FILAMENT_ASSERT(mTextures.empty() && mBindGroups.empty(),
                    "TransientPool::destroyAll() comes before the destructor");
}

void TransientPool::beginGraph() { ++mGraph; }

backend::TextureHandle TransientPool::acquire(backend::DeviceTextureDesc const& desc, uint32_t first, uint32_t last) {
    const auto isFree = [&](PooledTexture const& pooled) {
        return (pooled.lastGraph != mGraph || pooled.busyUntil < first) && isSameButForTheName(pooled.desc, desc);
    };
    auto found = std::find_if(mTextures.begin(), mTextures.end(), isFree);
    if (found == mTextures.end()) {
        backend::NewHandle handle(mStream, mStream.allocateTexture());
        mTextures.push_back({ .handle = handle });
        handle.keep();
        found = mTextures.end() - 1;
    }
    if (!found->isCreated) found->desc = desc; // its name is of this graph
    found->lastGraph = mGraph;
    found->busyUntil = last;
    return found->handle;
}

backend::BindGroupHandle TransientPool::bindGroup(backend::CommandBuffer& commands,
                                                  backend::BindGroupDesc const& desc) {
    FILAMENT_ASSERT(desc.entries.size() <= backend::kMaxBindings, "a bind group has at most 16 entries");
    const auto isSame = [&](PooledBindGroup const& pooled) {
        return pooled.layout == desc.layout &&
               std::equal(desc.entries.begin(), desc.entries.end(), pooled.entries.begin(),
                          pooled.entries.begin() + pooled.count);
    };
    const auto found = std::find_if(mBindGroups.begin(), mBindGroups.end(), isSame);
    if (found != mBindGroups.end()) {
        found->lastGraph = mGraph;
        return found->handle;
    }
    backend::NewHandle handle(mStream, mStream.allocateBindGroup());
    PooledBindGroup made{
        .layout = desc.layout, .count = static_cast<uint8_t>(desc.entries.size()), .handle = handle, .lastGraph = mGraph
    };
    std::copy(desc.entries.begin(), desc.entries.end(), made.entries.begin());
    mBindGroups.push_back(made);
    try {
        commands.record(backend::CmdCreateBindGroup{ made.handle, desc });
    } catch (...) {
        mBindGroups.pop_back(); // in the pool is what the driver has
        throw;
    }
    return handle.keep();
}

void TransientPool::recordCreations(backend::CommandBuffer& commands) {
    for (PooledTexture& pooled : mTextures) {
        if (pooled.isCreated || pooled.lastGraph != mGraph) continue; // of a graph that was never recorded
        commands.record(backend::CmdCreateTexture{ pooled.handle, pooled.desc });
        pooled.isCreated = true;
        pooled.desc.debugName = {}; // lives no longer than the graph
    }
}

void TransientPool::recordEvictions(backend::CommandBuffer& commands) {
    const auto isStale = [&](auto const& pooled) { return pooled.lastGraph + mKeepFrames < mGraph; };
    std::erase_if(mBindGroups, [&](PooledBindGroup const& pooled) {
        if (!isStale(pooled)) return false;
        mStream.destroy(commands, pooled.handle);
        return true;
    });
    std::erase_if(mTextures, [&](PooledTexture const& pooled) {
        if (!isStale(pooled)) return false;
        pooled.isCreated ? mStream.destroy(commands, pooled.handle) : mStream.free(pooled.handle);
        return true;
    });
}

void TransientPool::destroyAll(backend::CommandBuffer& commands) {
    mGraph += mKeepFrames + 1;
    recordEvictions(commands);
}

} // namespace filament::framegraph
