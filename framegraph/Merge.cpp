// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"

#include <algorithm>

namespace filament_core::framegraph {
namespace {

uint8_t withBit(uint8_t mask, uint32_t bit) { return static_cast<uint8_t>(mask | 1u << bit); }

bool isSame(GroupAttachment const& attachment, Access const& access) {
    return attachment.texture == access.texture && attachment.level == access.range.level &&
           attachment.layer == access.range.layer;
}

uint32_t findColor(PassGroup const& group, Access const& access) {
    const auto end = group.colors.begin() + group.colorCount;
    const auto found =
            std::find_if(group.colors.begin(), end, [&](auto const& color) { return isSame(color, access); });
    return found == end ? kNone : static_cast<uint32_t>(found - group.colors.begin());
}

/// Whether the group attaches anything that the access touches.
bool attaches(PassGroup const& group, Access const& access) {
    const auto touches = [&](GroupAttachment const& at) {
        return at.texture == access.texture && backend::contains(access.range, { at.level, 1, at.layer, 1 });
    };
    const auto end = group.colors.begin() + group.colorCount;
    return touches(group.depth) || std::any_of(group.colors.begin(), end, touches);
}

GroupAttachment attachmentOf(Access const& access) {
    return { .texture = access.texture,
             .level = access.range.level,
             .layer = access.range.layer,
             .previous = access.previous,
             .clear = access.clear,
             .resolve = access.resolve };
}

void takeSize(PassGroup& group, GraphTextureDesc const& desc, uint8_t level) {
    group.width = std::max(1u, desc.width >> level);
    group.height = std::max(1u, desc.height >> level);
    group.samples = desc.samples;
}

/// A group of one pass; its colours keep their declared slots.
PassGroup groupOf(FrameGraph const& graph, uint32_t pass, uint32_t at) {
    PassGroup group;
    group.first = at;
    group.count = 1;
    backend::SubpassDesc& subpass = group.subpasses[0];
    subpass = { .colorMask = 0, .inputMask = 0, .usesDepth = false };
    for (Access const& access : graph.accesses(graph.passes()[pass])) {
        if (!isAttachment(access.kind)) continue;
        takeSize(group, graph.texture(access.texture).desc, access.range.level);
        if (isDepth(access.kind)) {
            group.depth = attachmentOf(access);
            subpass.usesDepth = true;
        } else {
            group.colors[access.slot] = attachmentOf(access);
            group.colorCount = std::max<uint8_t>(group.colorCount, static_cast<uint8_t>(access.slot + 1));
            subpass.colorMask = withBit(subpass.colorMask, access.slot);
        }
    }
    return group;
}

/// Adds one access to the subpass that is about to join the group.
Merge addAccess(PassGroup& group, Access const& access, uint32_t maxColors) {
    backend::SubpassDesc& subpass = group.subpasses[group.count];
    if (access.kind == AccessKind::Input) {
        const uint32_t color = findColor(group, access);
        if (color == kNone) return Merge::NotBefore;
        subpass.inputMask = withBit(subpass.inputMask, color);
    } else if (access.kind == AccessKind::Color) {
        uint32_t color = findColor(group, access);
        if (color != kNone && access.previous == Previous::Clear) return Merge::ClearsAgain;
        if (color == kNone) {
            if (group.colorCount == maxColors) return Merge::TooManyAttachments;
            color = group.colorCount++;
            group.colors[color] = attachmentOf(access);
        }
        subpass.colorMask = withBit(subpass.colorMask, color);
    } else if (isDepth(access.kind)) {
        if (!group.depth.texture)
            group.depth = attachmentOf(access);
        else if (!isSame(group.depth, access))
            return Merge::DifferentDepth;
        else if (access.previous == Previous::Clear)
            return Merge::ClearsAgain;
        subpass.usesDepth = true;
    }
    return Merge::Merged;
}

/// Whether merging would change the attachment numbers of a program that has fixed ones (inputs from 0, then its own
/// colours).
bool isNumberedOtherwise(FrameGraph const& graph, PassGroup const& group, uint32_t pass) {
    const auto accesses = graph.accesses(graph.passes()[pass]);
    uint32_t inputs = 0;
    for (Access const& access : accesses) {
        if (access.kind != AccessKind::Input || access.slot == kAnyAttachment) continue;
        if (findColor(group, access) != access.slot) return true;
        ++inputs;
    }
    return inputs > 0 && std::any_of(accesses.begin(), accesses.end(), [&](Access const& access) {
               return access.kind == AccessKind::Color && findColor(group, access) != inputs + access.slot;
           });
}

bool readsInput(FrameGraph const& graph, uint32_t pass) {
    const auto accesses = graph.accesses(graph.passes()[pass]);
    return std::any_of(accesses.begin(), accesses.end(), [](Access const& a) { return a.kind == AccessKind::Input; });
}

// No pass of the merged group may sample or copy an attachment of any of them.
bool readsAttachmentsElsewhere(FrameGraph const& graph, PassGroup const& group, std::span<const uint32_t> passes) {
    for (const uint32_t pass : passes) {
        for (Access const& access : graph.accesses(graph.passes()[pass])) {
            if (!isAttachment(access.kind) && access.kind != AccessKind::Input && attaches(group, access)) return true;
        }
    }
    return false;
}

/// Makes the next pass in order a subpass of `group`, or returns why not and leaves the group unchanged.
Merge tryJoin(FrameGraph const& graph, PassOrder const& order, MergeLimits const& limits, PassGroup& group) {
    const uint32_t at = group.first + group.count, pass = order.order[at];
    if (!readsInput(graph, pass)) return Merge::NotAsked;
    if (!limits.mergedPasses) return Merge::DeviceCannot;
    if (!group.hasAttachments()) return Merge::NotBefore;
    const PassGroup alone = groupOf(graph, pass, at);
    if (alone.samples != 1 || group.samples != 1) return Merge::Multisampled;
    if (alone.width != group.width || alone.height != group.height) return Merge::DifferentSize;
    if (group.count == backend::kMaxSubpasses) return Merge::TooManySubpasses;

    // A copy, since a pass may turn out not to fit after half of its attachments have been added.
    PassGroup joined = group;
    joined.subpasses[group.count] = { .colorMask = 0, .inputMask = 0, .usesDepth = false };
    const uint32_t maxColors = std::min(limits.maxColorAttachments, backend::kMaxColorAttachments);
    for (Access const& access : graph.accesses(graph.passes()[pass])) { // inputs first: they refer to earlier subpasses
        if (access.kind != AccessKind::Input) continue;
        if (const Merge result = addAccess(joined, access, maxColors); result != Merge::Merged) return result;
    }
    for (Access const& access : graph.accesses(graph.passes()[pass])) {
        if (!isAttachment(access.kind)) continue;
        if (const Merge result = addAccess(joined, access, maxColors); result != Merge::Merged) return result;
    }
    if (isNumberedOtherwise(graph, joined, pass)) return Merge::OtherAttachments;
    if (readsAttachmentsElsewhere(graph, joined, order.order.subspan(group.first, group.count + 1)))
        return Merge::ReadsElsewhere;
    ++joined.count;
    group = joined;
    return Merge::Merged;
}

} // namespace

std::span<PassGroup> mergePasses(FrameGraph const& graph, PassOrder const& order, MergeLimits const& limits) {
    const std::span<PassGroup> groups = graph.arena().array<PassGroup>(order.order.size());
    uint32_t count = 0;
    for (uint32_t at = 0; at < order.order.size(); ++at) {
        const uint32_t pass = order.order[at];
        PassDecision& decision = order.decisions[pass];
        if (count > 0)
            decision.merge = tryJoin(graph, order, limits, groups[count - 1]);
        else if (readsInput(graph, pass))
            decision.merge = limits.mergedPasses ? Merge::NotBefore : Merge::DeviceCannot;
        if (decision.merge != Merge::Merged) groups[count++] = groupOf(graph, pass, at);
        decision.group = count - 1;
        decision.subpass = static_cast<uint8_t>(groups[count - 1].count - 1);
    }
    return groups.first(count);
}

} // namespace filament_core::framegraph
