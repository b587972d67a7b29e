// SPDX-License-Identifier: Apache-2.0
/// The steps of compile(), each a function of the results of earlier steps; Compile.cpp is their table of contents.
///   Memory  results live in the graph's arena.
///   Fails   checkDeclarations() asserts; the others rely on it.
#pragma once

#include "framegraph/CompiledGraph.h"

namespace filament_core::framegraph {

/// Every rule that a graph must keep, checked once (Check.cpp).
void checkDeclarations(FrameGraph const& graph);

struct PassOrder {
    std::span<PassDecision> decisions;
    std::span<const uint32_t> order;
};
/// Walks back from the outputs and side effects: a pass runs if its results reach one of them (Cull.cpp).
PassOrder cullUnreadPasses(FrameGraph const& graph);

struct MergeLimits {
    bool mergedPasses = true; ///< DeviceFeatures::mergedPasses
    uint32_t maxColorAttachments = backend::kMaxColorAttachments;
};
/// Groups consecutive passes of which the later one reads the earlier one's colour only at the current pixel, and lists
/// the attachments of each group. Writes merge, group and subpass of the decisions (Merge.cpp).
std::span<PassGroup> mergePasses(FrameGraph const& graph, PassOrder const& order, MergeLimits const& limits);

/// In groups (Lifetimes.cpp).
std::span<Lifetime> firstAndLastUse(FrameGraph const& graph, PassOrder const& order, std::span<const PassGroup> groups);

/// What each attachment loads and stores (LoadStore.cpp).
void deriveLoadAndStore(FrameGraph const& graph, PassOrder const& order, std::span<PassGroup> groups);

/// How each texture is used by the passes that run; those that never leave one group become transient (Lifetimes.cpp).
std::span<backend::TextureUsage> deriveUsage(FrameGraph const& graph, PassOrder const& order,
                                             std::span<const Lifetime> lifetimes);

/// First and last use, usage and handles of the buffers (Lifetimes.cpp).
std::span<BufferPlan> assignBuffers(FrameGraph const& graph, PassOrder const& order, std::span<const PassGroup> groups,
                                    TransientPool& pool);

/// Handles: the imported ones, and textures of the pool for the rest; disjoint lifetimes share (Lifetimes.cpp).
std::span<TexturePlan> assignTransients(FrameGraph const& graph, std::span<const Lifetime> lifetimes,
                                        std::span<const backend::TextureUsage> usage, TransientPool& pool);

/// Names and pass layouts of the groups (Compile.cpp).
void describePasses(FrameGraph const& graph, PassOrder const& order, std::span<PassGroup> groups);

} // namespace filament_core::framegraph
