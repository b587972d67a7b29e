// SPDX-License-Identifier: Apache-2.0
#include "framegraph/TransientPool.h"

#include "backend/stream/CommandStream.h"
#include "backend/stream/RecordingGuards.h"
#include "base/Assert.h"

#include <algorithm>
#include <utility>

namespace filament_core::framegraph {
namespace {

bool isSameButForTheName(backend::DeviceTextureDesc const& a, backend::DeviceTextureDesc const& b) {
    return a.type == b.type && a.format == b.format && a.usage == b.usage && a.samples == b.samples &&
           a.levels == b.levels && a.layers == b.layers && a.width == b.width && a.height == b.height;
}

bool isSameButForTheName(backend::BufferDesc const& a, backend::BufferDesc const& b) {
    return a.size == b.size && a.usage == b.usage;
}

} // namespace

TransientPool::TransientPool(backend::CommandStream& stream, uint32_t keepFrames)
        : mStream(stream), mKeepFrames(keepFrames) {}

TransientPool::~TransientPool() {
    FILAMENT_ASSERT(mTextures.empty() && mBuffers.empty() && mHistories.empty() && mOutdated.empty() &&
                            mBindGroups.empty(),
                    "TransientPool::destroyAll() comes before the destructor");
}

void TransientPool::beginGraph() { ++mGraph; }

bool TransientPool::isFree(PooledMemory const& memory, UseInterval use) const {
    const auto overlaps = [use](UseInterval other) { return use.first <= other.last && other.first <= use.last; };
    return memory.lastGraph != mGraph || std::ranges::none_of(memory.uses, overlaps);
}

uint32_t TransientPool::idleBeside(PooledMemory const& memory, UseInterval use) const {
    uint32_t least = UINT32_MAX;
    if (memory.lastGraph != mGraph) return least;
    for (const UseInterval other : memory.uses)
        least = std::min(least, other.last < use.first ? use.first - other.last : other.first - use.last);
    return least;
}

uint32_t TransientPool::newMemory(uint64_t bytes, bool isShareable) {
    auto found = std::ranges::find(mMemories, 0u, &PooledMemory::textures);
    if (found == mMemories.end()) found = mMemories.emplace(mMemories.end());
    found->bytes = bytes;
    found->isShareable = isShareable;
    found->lastGraph = 0;
    return static_cast<uint32_t>(found - mMemories.begin());
}

uint32_t TransientPool::memoryFor(backend::DeviceTextureDesc const& desc, UseInterval use) {
    const bool isShareable = mStream.info().features.sharedMemory && !has(desc.usage, backend::TextureUsage::Transient);
    const uint64_t bytes = backend::textureBytes(desc);
    auto best = mMemories.end();
    const auto isBetter = [&](PooledMemory const& one, PooledMemory const& other) {
        // The memory whose other uses end closest to this one: what has long gaps stays free for textures with long
        // lives. Then the smallest that is large enough.
        const uint32_t idle = idleBeside(one, use), idleOther = idleBeside(other, use);
        return idle != idleOther ? idle < idleOther : one.bytes < other.bytes;
    };
    for (auto memory = mMemories.begin(); memory != mMemories.end() && isShareable; ++memory) {
        const bool isUsable =
                memory->textures > 0 && memory->isShareable && memory->bytes >= bytes && isFree(*memory, use);
        if (isUsable && (best == mMemories.end() || isBetter(*memory, *best))) best = memory;
    }
    return best != mMemories.end() ? static_cast<uint32_t>(best - mMemories.begin()) : newMemory(bytes, isShareable);
}

TransientPool::PooledTexture& TransientPool::addTexture(backend::DeviceTextureDesc const& desc, UseInterval use) {
    const uint32_t memory = memoryFor(desc, use);
    backend::NewHandle handle(mStream, mStream.allocateTexture());
    mTextures.push_back({ .desc = desc, .handle = handle, .memory = memory });
    handle.keep();
    ++mMemories[memory].textures;
    return mTextures.back();
}

PooledTransient TransientPool::acquire(backend::DeviceTextureDesc const& desc, UseInterval use) {
    const auto found = std::ranges::find_if(mTextures, [&](PooledTexture const& one) {
        return isSameButForTheName(one.desc, desc) && isFree(mMemories[one.memory], use);
    });
    PooledTexture& texture = found != mTextures.end() ? *found : addTexture(desc, use);
    if (!texture.isCreated) texture.desc.debugName = desc.debugName; // keep the name from this graph
    PooledMemory& memory = mMemories[texture.memory];
    if (memory.lastGraph != mGraph) memory.uses.clear();
    memory.uses.push_back(use);
    memory.lastGraph = texture.lastGraph = mGraph;
    return { texture.handle, texture.memory };
}

backend::BufferHandle TransientPool::acquire(backend::BufferDesc const& desc, uint32_t first, uint32_t last) {
    auto found = std::ranges::find_if(mBuffers, [&](PooledBuffer const& one) {
        return (one.lastGraph != mGraph || one.busyUntil < first) && isSameButForTheName(one.desc, desc);
    });
    if (found == mBuffers.end()) {
        backend::NewHandle handle(mStream, mStream.allocateBuffer());
        mBuffers.push_back({ .handle = handle });
        handle.keep();
        found = mBuffers.end() - 1;
    }
    if (!found->isCreated) found->desc = desc; // keep the name from this graph
    found->lastGraph = mGraph;
    found->busyUntil = last;
    return found->handle;
}

TransientPool::KeptHistory TransientPool::newHistory(backend::DeviceTextureDesc const& desc) {
    backend::NewHandle first(mStream, mStream.allocateTexture()), second(mStream, mStream.allocateTexture());
    KeptHistory made{ .name = std::string(desc.debugName), .desc = desc, .handles = { first, second } };
    made.desc.debugName = {}; // the name dies with the graph
    first.keep();
    second.keep();
    return made;
}

PooledHistory TransientPool::history(backend::DeviceTextureDesc const& desc, bool writes) {
    auto found = std::ranges::find(mHistories, desc.debugName, &KeptHistory::name);
    if (found == mHistories.end()) {
        mHistories.reserve(mHistories.size() + 1); // so that newHistory() is the last call that can fail
        mHistories.push_back(newHistory(desc));
        found = mHistories.end() - 1;
    } else if (!isSameButForTheName(found->desc, desc)) {
        mOutdated.reserve(mOutdated.size() + 1);
        mOutdated.push_back(std::exchange(*found, newHistory(desc)));
    }
    found->lastGraph = mGraph;
    found->isWritten = writes;
    const uint64_t age = found->writtenGraph > 0 ? mGraph - found->writtenGraph : 0;
    return { found->handles[found->previous], found->handles[1 - found->previous], static_cast<uint32_t>(age) };
}

void TransientPool::keepHistory() {
    for (KeptHistory& history : mHistories) {
        if (history.lastGraph != mGraph || !history.isWritten) continue;
        history.previous = static_cast<uint8_t>(1 - history.previous);
        history.writtenGraph = mGraph;
        history.isWritten = false;
    }
}

void TransientPool::destroy(backend::CommandBuffer& commands, KeptHistory const& history) {
    for (const backend::TextureHandle handle : history.handles) {
        history.isCreated ? mStream.destroy(commands, handle) : mStream.free(handle);
    }
}

backend::BindGroupHandle TransientPool::bindGroup(backend::CommandBuffer& commands,
                                                  backend::BindGroupDesc const& desc) {
    FILAMENT_ASSERT(desc.entries.size() <= backend::kMaxBindings, "a bind group has at most kMaxBindings entries");
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
        mBindGroups.pop_back(); // the pool must match the driver
        throw;
    }
    return handle.keep();
}

backend::TextureHandle TransientPool::createdIn(uint32_t memory) const {
    const auto found = std::ranges::find_if(
            mTextures, [memory](PooledTexture const& one) { return one.isCreated && one.memory == memory; });
    return found != mTextures.end() ? found->handle : backend::TextureHandle{};
}

void TransientPool::recordCreations(backend::CommandBuffer& commands) {
    for (PooledTexture& pooled : mTextures) {
        if (pooled.isCreated || pooled.lastGraph != mGraph) continue; // its graph was never recorded
        // Textures are requested from the largest down (assignTransients()): the first one of a memory has room for the
        // others.
        pooled.desc.placedOn = createdIn(pooled.memory);
        commands.record(backend::CmdCreateTexture{ pooled.handle, pooled.desc });
        pooled.isCreated = true;
        pooled.desc.debugName = {}; // the name dies with the graph
    }
    for (PooledBuffer& pooled : mBuffers) {
        if (pooled.isCreated || pooled.lastGraph != mGraph) continue;
        commands.record(backend::CmdCreateBuffer{ pooled.handle, pooled.desc });
        pooled.isCreated = true;
        pooled.desc.debugName = {};
    }
    for (KeptHistory& history : mHistories) {
        if (history.isCreated || history.lastGraph != mGraph) continue;
        createHistory(commands, history);
    }
}

void TransientPool::createHistory(backend::CommandBuffer& commands, KeptHistory& history) {
    backend::AllOrNothing both(commands);
    backend::DeviceTextureDesc desc = history.desc;
    desc.debugName = history.name;
    for (const backend::TextureHandle handle : history.handles) {
        commands.record(backend::CmdCreateTexture{ handle, desc });
    }
    both.complete();
    history.isCreated = true;
}

void TransientPool::recordEvictions(backend::CommandBuffer& commands) {
    const auto isStale = [&](auto const& pooled) { return pooled.lastGraph + mKeepFrames < mGraph; };
    // Groups leave before the textures that they name.
    std::erase_if(mBindGroups, [&](PooledBindGroup const& pooled) {
        if (!isStale(pooled)) return false;
        mStream.destroy(commands, pooled.handle);
        return true;
    });
    std::erase_if(mHistories, [&](KeptHistory const& history) {
        if (!isStale(history)) return false;
        destroy(commands, history);
        return true;
    });
    for (KeptHistory const& history : mOutdated) destroy(commands, history);
    mOutdated.clear();
    const auto isEvicted = [&](auto const& pooled) {
        if (!isStale(pooled)) return false;
        pooled.isCreated ? mStream.destroy(commands, pooled.handle) : mStream.free(pooled.handle);
        return true;
    };
    std::erase_if(mTextures, [&](PooledTexture const& pooled) {
        if (!isEvicted(pooled)) return false;
        --mMemories[pooled.memory].textures;
        return true;
    });
    std::erase_if(mBuffers, isEvicted);
}

void TransientPool::destroyAll(backend::CommandBuffer& commands) {
    // Then everything is older than what is kept.
    mGraph += mKeepFrames + 1;
    recordEvictions(commands);
}

} // namespace filament_core::framegraph
