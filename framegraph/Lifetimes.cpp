// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"
#include "framegraph/Memory.h"

#include <algorithm>

namespace filament_core::framegraph {
namespace {

using backend::BufferUsage;
using backend::TextureUsage;

TextureUsage usageOf(AccessKind kind, bool isMerged) {
    switch (kind) {
    case AccessKind::Color:
        return TextureUsage::ColorAttachment;
    case AccessKind::Depth:
    case AccessKind::DepthTest:
        return TextureUsage::DepthAttachment;
    case AccessKind::Sampled:
        return TextureUsage::Sampled;
    case AccessKind::Input:
        return isMerged ? TextureUsage::InputAttachment : TextureUsage::Sampled;
    case AccessKind::TransferRead:
        return TextureUsage::TransferSource;
    case AccessKind::TransferWrite:
        return TextureUsage::TransferTarget;
    }
    return {};
}

BufferUsage usageOf(BufferAccess const& access) {
    switch (access.use) {
    case BufferUse::Storage:
        return BufferUsage::Storage;
    case BufferUse::Uniform:
        return BufferUsage::Uniform;
    case BufferUse::Vertex:
        return BufferUsage::Vertex;
    case BufferUse::Index:
        return BufferUsage::Index;
    case BufferUse::Transfer:
        break;
    }
    return access.writes ? BufferUsage{} : BufferUsage::TransferSource; // any buffer can be updated
}

/// Indices of the textures, the largest first, and of the same size the one that is used first: the order of requests
/// to the pool. What is small then finds room in the memory of what is large.
std::span<uint32_t> bySize(FrameGraph const& graph, std::span<const Lifetime> lifetimes) {
    const std::span<uint32_t> numbers = graph.arena().array<uint32_t>(lifetimes.size());
    const std::span<uint64_t> bytes = graph.arena().array<uint64_t>(lifetimes.size());
    for (uint32_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = i;
        bytes[i] = bytesOf(graph.textures()[i].desc);
    }
    std::sort(numbers.begin(), numbers.end(), [&](uint32_t a, uint32_t b) {
        if (bytes[a] != bytes[b]) return bytes[a] > bytes[b];
        return lifetimes[a].first != lifetimes[b].first ? lifetimes[a].first < lifetimes[b].first : a < b;
    });
    return numbers;
}

/// Indices into `lifetimes`, ordered by first use.
std::span<uint32_t> byFirstUse(Arena& arena, std::span<const Lifetime> lifetimes) {
    const std::span<uint32_t> numbers = arena.array<uint32_t>(lifetimes.size());
    for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
    std::sort(numbers.begin(), numbers.end(), [&](uint32_t a, uint32_t b) {
        return lifetimes[a].first != lifetimes[b].first ? lifetimes[a].first < lifetimes[b].first : a < b;
    });
    return numbers;
}

// Whether it may live in tile memory: used only as an attachment of one group, and not needed afterwards.
bool isTransient(Texture const& texture, Lifetime const& lifetime, TextureUsage usage) {
    constexpr auto kElsewhere = TextureUsage::Sampled | TextureUsage::TransferSource | TextureUsage::TransferTarget;
    return !texture.isOutput && lifetime.isUsed() && lifetime.first == lifetime.last && !has(usage, kElsewhere) &&
           texture.desc.levels == 1 && texture.desc.layers == 1;
}

backend::DeviceTextureDesc descOf(GraphTextureDesc const& desc, TextureUsage usage) {
    return { .type = desc.type,
             .format = desc.format,
             .usage = usage,
             .samples = desc.samples,
             .levels = desc.levels,
             .layers = desc.layers,
             .width = desc.width,
             .height = desc.height,
             .debugName = desc.name };
}

// The two textures swap roles every frame, and the passes that run may change: include every usage that they may have.
TextureUsage historyUsage(backend::Format format) {
    using enum TextureUsage;
    return backend::hasDepth(format) ? Sampled | DepthAttachment | TransferSource
                                     : Sampled | ColorAttachment | InputAttachment | TransferSource | TransferTarget;
}

void assignHistory(FrameGraph const& graph, size_t previous, std::span<TexturePlan> plans, TransientPool& pool) {
    TexturePlan& from = plans[previous];
    TexturePlan& to = plans[previous + 1];
    if (!from.lifetime.isUsed() && !to.lifetime.isUsed()) return;
    GraphTextureDesc const& desc = graph.textures()[previous + 1].desc;
    from.usage = to.usage = historyUsage(desc.format);
    const PooledHistory pair = pool.history(descOf(desc, to.usage), to.lifetime.isUsed());
    from.handle = pair.previous;
    from.historyAge = graph.textures()[previous].beginsAnew ? 0 : pair.age;
    to.handle = pair.current;
}

} // namespace

std::span<Lifetime> firstAndLastUse(FrameGraph const& graph, PassOrder const& order,
                                    std::span<const PassGroup> groups) {
    const std::span<Lifetime> lifetimes = graph.arena().array<Lifetime>(graph.textures().size());
    const auto touch = [&](TextureId texture, uint32_t group) {
        if (!texture) return;
        Lifetime& lifetime = lifetimes[texture.index()];
        lifetime.first = std::min(lifetime.first, group);
        lifetime.last = std::max(lifetime.last, group);
    };
    for (uint32_t group = 0; group < groups.size(); ++group) {
        for (const uint32_t pass : order.order.subspan(groups[group].first, groups[group].count)) {
            for (Access const& access : graph.accesses(graph.passes()[pass])) {
                touch(access.texture, group);
                touch(access.resolve, group);
            }
        }
    }
    return lifetimes;
}

std::span<TextureUsage> deriveUsage(FrameGraph const& graph, PassOrder const& order,
                                    std::span<const Lifetime> lifetimes) {
    const std::span<TextureUsage> usage = graph.arena().array<TextureUsage>(graph.textures().size());
    const std::span<bool> isResolved = graph.arena().array<bool>(usage.size());
    for (const uint32_t pass : order.order) {
        const bool merged = order.decisions[pass].merge == Merge::Merged;
        for (Access const& access : graph.accesses(graph.passes()[pass])) {
            TextureUsage& of = usage[access.texture.index()];
            of = of | usageOf(access.kind, merged);
            if (!access.resolve) continue;
            usage[access.resolve.index()] = usage[access.resolve.index()] | usageOf(access.kind, false);
            isResolved[access.resolve.index()] = true;
        }
    }
    for (size_t i = 0; i < usage.size(); ++i) {
        if (isTransient(graph.textures()[i], lifetimes[i], usage[i]) && !isResolved[i])
            usage[i] = usage[i] | TextureUsage::Transient;
    }
    return usage;
}

std::span<TexturePlan> assignTransients(FrameGraph const& graph, std::span<const Lifetime> lifetimes,
                                        std::span<const TextureUsage> usage, TransientPool& pool) {
    const std::span<TexturePlan> plans = graph.arena().array<TexturePlan>(lifetimes.size());
    for (const uint32_t i : bySize(graph, lifetimes)) {
        Texture const& texture = graph.textures()[i];
        plans[i] = { lifetimes[i], usage[i], texture.imported };
        const bool isPooled = !texture.isImported && texture.history == HistoryRole::None;
        if (!isPooled || !lifetimes[i].isUsed()) continue;
        const uint32_t last = texture.isOutput ? kNone : lifetimes[i].last; // an output outlives the last group
        const PooledTransient pooled = pool.acquire(descOf(texture.desc, usage[i]), { lifetimes[i].first, last });
        plans[i].handle = pooled.handle;
        plans[i].memory = pooled.memory;
    }
    for (size_t i = 0; i < plans.size(); ++i) {
        // Histories last: their pairs of textures are never shared, so they take no part in the order by size.
        if (graph.textures()[i].history == HistoryRole::Previous) assignHistory(graph, i, plans, pool);
    }
    return plans;
}

std::span<BufferPlan> assignBuffers(FrameGraph const& graph, PassOrder const& order, std::span<const PassGroup> groups,
                                    TransientPool& pool) {
    const std::span<BufferPlan> plans = graph.arena().array<BufferPlan>(graph.buffers().size());
    const std::span<Lifetime> lifetimes = graph.arena().array<Lifetime>(plans.size());
    for (uint32_t group = 0; group < groups.size(); ++group) {
        for (const uint32_t pass : order.order.subspan(groups[group].first, groups[group].count)) {
            for (BufferAccess const& access : graph.bufferAccesses(graph.passes()[pass])) {
                const uint32_t i = access.buffer.index();
                lifetimes[i].first = std::min(lifetimes[i].first, group);
                lifetimes[i].last = std::max(lifetimes[i].last, group);
                plans[i].usage = plans[i].usage | usageOf(access);
            }
        }
    }
    for (const uint32_t i : byFirstUse(graph.arena(), lifetimes)) {
        Buffer const& buffer = graph.buffers()[i];
        plans[i].lifetime = lifetimes[i];
        plans[i].handle = buffer.imported;
        if (buffer.isImported || !lifetimes[i].isUsed()) continue;
        if (plans[i].usage == BufferUsage{}) plans[i].usage = BufferUsage::TransferSource; // only uploaded to
        const uint32_t last = buffer.isOutput ? kNone : lifetimes[i].last;
        plans[i].handle = pool.acquire({ buffer.size, plans[i].usage, buffer.name }, lifetimes[i].first, last);
    }
    return plans;
}

} // namespace filament_core::framegraph
