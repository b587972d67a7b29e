// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompiledGraph.h"

#include "backend/stream/CommandStream.h"
#include "backend/stream/RecordingGuards.h"
#include "framegraph/Require.h"

#include <algorithm>

namespace filament_core::framegraph {
namespace {

using namespace backend;

Attachment attachmentOf(CompiledGraph const& plan, GroupAttachment const& attachment) {
    return { .texture = plan.texture(attachment.texture),
             .level = attachment.level,
             .layer = attachment.layer,
             .load = attachment.load,
             .store = attachment.store,
             .clear = attachment.clear,
             .resolve = attachment.resolve ? plan.texture(attachment.resolve) : TextureHandle{} };
}

PassDesc passDescOf(CompiledGraph const& plan, PassGroup const& group) {
    PassDesc desc;
    desc.layout = group.layout;
    for (uint32_t i = 0; i < group.colorCount; ++i) desc.colors[i] = attachmentOf(plan, group.colors[i]);
    if (group.depth.texture) desc.depth = attachmentOf(plan, group.depth);
    desc.area = { 0, 0, group.width, group.height };
    desc.debugName = group.name;
    return desc;
}

void executePass(CommandBuffer& commands, CompiledGraph const& plan, PassContext& context, uint32_t pass,
                 bool insidePass) {
    Pass const& of = plan.graph->passes()[pass];
    commands.record(CmdPushGroup{ of.name });
    const InReserve<CmdPopGroup> pop{ commands, {} };
    context.enter(pass, insidePass);
    of.code.execute(of.code.object, context);
}

void recordGroup(CommandBuffer& commands, CompiledGraph const& plan, PassGroup const& group, RangeRecorder* ranges) {
    PassContext context(plan, commands, ranges);
    const std::span<const uint32_t> passes = plan.order.subspan(group.first, group.count);
    // What passes create and upload comes before the backend pass, inside of which the backend accepts draws only; for
    // merged passes, before the first of them.
    for (const uint32_t pass : passes) {
        PassCode const& code = plan.graph->passes()[pass].code;
        context.enter(pass, false);
        code.beforePass(code.object, context);
    }
    if (!group.hasAttachments()) {
        executePass(commands, plan, context, passes[0], false);
        return;
    }
    // If memory runs out inside of the pass, its beginning is taken back: the command buffer can still be submitted.
    AllOrNothing wholePass(commands);
    commands.record(CmdBeginPass{ passDescOf(plan, group) });
    for (size_t subpass = 0; subpass < passes.size(); ++subpass) {
        if (subpass > 0) commands.record(CmdNextSubpass{});
        executePass(commands, plan, context, passes[subpass], true);
    }
    commands.record(CmdEndPass{});
    wholePass.complete();
}

// Histories without a previous frame: their previous textures are cleared, level by level.
void clearHistory(CommandBuffer& commands, Texture const& texture, TextureHandle handle) {
    GraphTextureDesc const& desc = texture.desc;
    PassDesc pass;
    const bool isDepth = hasDepth(desc.format);
    Attachment& attachment = isDepth ? pass.depth : pass.colors[0];
    pass.layout.colorCount = isDepth ? 0 : 1;
    (isDepth ? pass.layout.depthFormat : pass.layout.colorFormats[0]) = desc.format;
    pass.debugName = desc.name;
    for (uint8_t level = 0; level < desc.levels; ++level) {
        const uint32_t layers = layersOfLevel({ .type = desc.type, .layers = desc.layers }, level);
        for (uint16_t layer = 0; layer < layers; ++layer) {
            attachment = { .texture = handle, .level = level, .layer = layer, .clear = texture.clear };
            pass.area = { 0, 0, std::max(1u, desc.width >> level), std::max(1u, desc.height >> level) };
            AllOrNothing wholePass(commands);
            commands.record(CmdBeginPass{ pass });
            commands.record(CmdEndPass{});
            wholePass.complete();
        }
    }
}

void clearHistories(CommandBuffer& commands, CompiledGraph const& plan) {
    for (size_t i = 0; i < plan.textures.size(); ++i) {
        Texture const& texture = plan.graph->textures()[i];
        const bool isNew = texture.history == HistoryRole::Previous && plan.textures[i].historyAge == 0;
        if (isNew && plan.textures[i].lifetime.isUsed()) clearHistory(commands, texture, plan.textures[i].handle);
    }
}

} // namespace

void record(CommandBuffer& commands, CompiledGraph const& plan, std::vector<PassTimer>* timers, RangeRecorder* ranges) {
    // Only textures of graphs that are recorded exist on the device. Compiling alone creates nothing.
    plan.pool->recordCreations(commands);
    clearHistories(commands, plan);
    if (timers) timers->clear();
    for (PassGroup const& group : plan.groups) {
        if (!timers) {
            recordGroup(commands, plan, group, ranges);
            continue;
        }
        const Ticket ticket = plan.pool->stream().nextTicket();
        timers->push_back({ group.name, ticket });
        commands.record(CmdBeginTimer{ ticket });
        const InReserve<CmdEndTimer> end{ commands, { ticket } };
        recordGroup(commands, plan, group, ranges);
    }
    // The pairs change places once the whole graph is recorded. If it fails before, the next frame has the same
    // previous ones.
    plan.pool->keepHistory();
    // After the last pass that may use what leaves.
    plan.pool->recordEvictions(commands);
}

void rehearse(CompiledGraph const& plan) {
    CommandBuffer nothing;
    PassContext context(plan, nothing, nullptr, true);
    for (const uint32_t index : plan.order) {
        Pass const& pass = plan.graph->passes()[index];
        context.enter(index, false);
        pass.code.beforePass(pass.code.object, context);
        require(nothing.commandCount() == 0,
                "pass '{}': records commands in a rehearsal; leave them out where PassContext::isRehearsal() is true",
                pass.name);
    }
}

} // namespace filament_core::framegraph
