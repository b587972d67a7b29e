// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"

namespace filament_core::framegraph {
namespace {

using backend::LoadOp;
using backend::StoreOp;

std::span<const uint32_t> passesOf(PassOrder const& order, PassGroup const& group) {
    return order.order.subspan(group.first, group.count);
}

bool overlaps(Access const& access, GroupAttachment const& attachment) {
    return access.texture == attachment.texture &&
           backend::contains(access.range, { attachment.level, 1, attachment.layer, 1 });
}

bool isResolvedTo(Access const& access, GroupAttachment const& attachment) {
    return access.resolve && access.resolve == attachment.texture && attachment.level == 0 && attachment.layer == 0;
}

bool isWrittenBefore(FrameGraph const& graph, PassOrder const& order, std::span<const PassGroup> earlier,
                     GroupAttachment const& attachment) {
    if (graph.texture(attachment.texture).contents == InitialContents::Keep) return true;
    for (PassGroup const& group : earlier) {
        for (const uint32_t pass : passesOf(order, group)) {
            for (Access const& access : graph.accesses(graph.passes()[pass])) {
                if (isPureRead(access.kind)) continue;
                if (overlaps(access, attachment) || isResolvedTo(access, attachment)) return true;
            }
        }
    }
    return false;
}

bool isWantedAfter(FrameGraph const& graph, PassOrder const& order, std::span<const PassGroup> later,
                   GroupAttachment const& attachment) {
    for (PassGroup const& group : later) {
        for (const uint32_t pass : passesOf(order, group)) {
            for (Access const& access : graph.accesses(graph.passes()[pass])) {
                if (isResolvedTo(access, attachment)) return false; // replaced before anything reads it
                if (overlaps(access, attachment)) return isPureRead(access.kind) || access.previous == Previous::Keep;
            }
        }
    }
    return graph.texture(attachment.texture).isOutput;
}

LoadOp loadOpOf(Previous previous, bool isWritten) {
    if (previous == Previous::Clear) return LoadOp::Clear;
    return previous == Previous::Keep && isWritten ? LoadOp::Load : LoadOp::Discard;
}

} // namespace

// Quadratic in the groups of a frame, of which there are tens.
void deriveLoadAndStore(FrameGraph const& graph, PassOrder const& order, std::span<PassGroup> groups) {
    for (size_t i = 0; i < groups.size(); ++i) {
        const auto derive = [&](GroupAttachment& attachment) {
            attachment.load = loadOpOf(attachment.previous, isWrittenBefore(graph, order, groups.first(i), attachment));
            const bool wanted = isWantedAfter(graph, order, groups.subspan(i + 1), attachment);
            attachment.store = wanted ? StoreOp::Store : StoreOp::Discard;
        };
        for (uint32_t color = 0; color < groups[i].colorCount; ++color) derive(groups[i].colors[color]);
        if (groups[i].depth.texture) derive(groups[i].depth);
    }
}

} // namespace filament_core::framegraph
