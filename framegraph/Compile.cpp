// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"

#include "backend/stream/CommandStream.h"

#include <cstring>

namespace filament_core::framegraph {
namespace {

using backend::DeviceInfo;

// "color + tone map"
std::string_view joinNames(FrameGraph const& graph, std::span<const uint32_t> passes) {
    constexpr std::string_view kPlus = " + ";
    if (passes.size() == 1) return graph.passes()[passes[0]].name;
    size_t length = (passes.size() - 1) * kPlus.size();
    for (const uint32_t pass : passes) length += graph.passes()[pass].name.size();
    const std::span<char> text = graph.arena().array<char>(length);
    char* at = text.data();
    const auto put = [&](std::string_view part) {
        std::memcpy(at, part.data(), part.size());
        at += part.size();
    };
    for (size_t i = 0; i < passes.size(); ++i) {
        if (i > 0) put(kPlus);
        put(graph.passes()[passes[i]].name);
    }
    return { text.data(), text.size() };
}

backend::PassLayout layoutOf(FrameGraph const& graph, PassGroup const& group) {
    backend::PassLayout layout;
    layout.colorCount = group.colorCount;
    layout.samples = group.samples;
    layout.subpassCount = static_cast<uint8_t>(group.count);
    layout.subpasses = group.subpasses;
    for (uint32_t i = 0; i < group.colorCount; ++i) {
        layout.colorFormats[i] = graph.texture(group.colors[i].texture).desc.format;
        if (group.colors[i].resolve) layout.resolveMask = static_cast<uint8_t>(layout.resolveMask | 1u << i);
    }
    if (group.depth.texture) layout.depthFormat = graph.texture(group.depth.texture).desc.format;
    layout.resolvesDepth = static_cast<bool>(group.depth.resolve);
    return layout;
}

} // namespace

CompiledGraph compile(FrameGraph const& graph, TransientPool& pool) {
    DeviceInfo const& device = pool.stream().info();
    checkDeclarations(graph);
    const PassOrder order = cullUnreadPasses(graph);
    // Merging comes before all that counts uses: lifetimes and load operations are those of groups, and an input that
    // is merged needs another usage, and perhaps no memory at all.
    const auto groups = mergePasses(graph, order, { device.features.mergedPasses, device.limits.maxColorAttachments });
    const auto lifetimes = firstAndLastUse(graph, order, groups);
    deriveLoadAndStore(graph, order, groups);
    const auto usage = deriveUsage(graph, order, lifetimes);
    // The pool is asked last: nothing after this can refuse the graph.
    pool.beginGraph();
    const auto textures = assignTransients(graph, lifetimes, usage, pool);
    const auto buffers = assignBuffers(graph, order, groups, pool);
    describePasses(graph, order, groups);
    return { &graph, &pool, order.decisions, order.order, groups, textures, buffers };
}

void describePasses(FrameGraph const& graph, PassOrder const& order, std::span<PassGroup> groups) {
    for (PassGroup& group : groups) {
        group.name = joinNames(graph, order.order.subspan(group.first, group.count));
        if (group.hasAttachments()) group.layout = layoutOf(graph, group);
    }
}

} // namespace filament_core::framegraph
