// SPDX-License-Identifier: Apache-2.0
#include "framegraph/PassContext.h"

#include "framegraph/CompiledGraph.h"
#include "framegraph/Require.h"

#include <algorithm>

namespace filament_core::framegraph {

void PassContext::requireDeclared(TextureId id) const {
    Pass const& pass = mPlan.graph->passes()[mPass];
    const auto accesses = mPlan.graph->accesses(pass);
    require(id && id.index() < mPlan.textures.size(), "pass '{}': asks for a texture of another graph or frame",
            pass.name);
    const bool declared = std::any_of(accesses.begin(), accesses.end(), [&](Access const& access) {
        return access.texture == id || access.resolve == id;
    });
    require(declared, "pass '{}': uses texture '{}' without having declared it", pass.name,
            mPlan.graph->texture(id).desc.name);
}

backend::CommandStream& PassContext::stream() { return mPlan.pool->stream(); }

backend::TextureHandle PassContext::texture(TextureId id) const {
    requireDeclared(id);
    return mPlan.texture(id);
}

GraphTextureDesc const& PassContext::desc(TextureId id) const {
    requireDeclared(id);
    return mPlan.graph->texture(id).desc;
}

backend::BufferHandle PassContext::buffer(BufferId id) const {
    Pass const& pass = mPlan.graph->passes()[mPass];
    require(id && id.index() < mPlan.buffers.size(), "pass '{}': asks for a buffer of another graph or frame",
            pass.name);
    const auto accesses = mPlan.graph->bufferAccesses(pass);
    const bool declared =
            std::any_of(accesses.begin(), accesses.end(), [&](BufferAccess const& at) { return at.buffer == id; });
    require(declared, "pass '{}': uses buffer '{}' without having declared it", pass.name,
            mPlan.graph->buffer(id).name);
    return mPlan.buffers[id.index()].handle;
}

uint32_t PassContext::historyAge(TextureId previous) const {
    requireDeclared(previous);
    require(mPlan.graph->texture(previous).history == HistoryRole::Previous,
            "pass '{}': texture '{}' is not the previous one of a history", mPlan.graph->passes()[mPass].name,
            mPlan.graph->texture(previous).desc.name);
    return mPlan.textures[previous.index()].historyAge;
}

backend::PassLayout const& PassContext::passLayout() const { return mPlan.groups[mPlan.passes[mPass].group].layout; }

uint8_t PassContext::subpass() const { return mPlan.passes[mPass].subpass; }

backend::Rect PassContext::area() const {
    PassGroup const& group = mPlan.groups[mPlan.passes[mPass].group];
    return { 0, 0, group.width, group.height };
}

bool PassContext::isMerged(TextureId id) const {
    requireDeclared(id);
    const auto accesses = mPlan.graph->accesses(mPlan.graph->passes()[mPass]);
    const bool isInput = std::any_of(accesses.begin(), accesses.end(), [&](Access const& access) {
        return access.texture == id && access.kind == AccessKind::Input;
    });
    return isInput && mPlan.passes[mPass].merge == Merge::Merged;
}

uint8_t PassContext::colorIndex(TextureId id) const {
    requireDeclared(id);
    PassDecision const& decision = mPlan.passes[mPass];
    PassGroup const& group = mPlan.groups[decision.group];
    backend::SubpassDesc const& subpass = group.subpasses[decision.subpass];
    for (uint8_t i = 0; i < group.colorCount; ++i) {
        const bool isMine = ((subpass.colorMask | subpass.inputMask) >> i & 1) != 0;
        if (isMine && group.colors[i].texture == id) return i;
    }
    require(false, "pass '{}': texture '{}' is no colour attachment of it", mPlan.graph->passes()[mPass].name,
            mPlan.graph->texture(id).desc.name);
    return 0;
}

void PassContext::requireDeclaredRange(backend::BindGroupEntry const& entry, std::string_view group) const {
    Pass const& pass = mPlan.graph->passes()[mPass];
    Access const* read = nullptr; // an access to another part of the same texture
    for (Access const& access : mPlan.graph->accesses(pass)) {
        if (mPlan.texture(access.texture) != entry.texture) continue;
        if (access.kind != AccessKind::Sampled && access.kind != AccessKind::Input) continue;
        GraphTextureDesc const& desc = mPlan.graph->texture(access.texture).desc;
        if (contains(access.range, withCounts(entry.range, desc.levels, desc.layers))) return;
        read = &access;
    }
    if (!read) return; // unknown to the graph, or texture() has already reported it
    require(false, "pass '{}': bind group '{}' shows another part of texture '{}' than the pass declared", pass.name,
            group, mPlan.graph->texture(read->texture).desc.name);
}

backend::BindGroupHandle PassContext::bindGroup(backend::BindGroupLayout const& layout,
                                                std::span<const backend::BindGroupEntry> entries,
                                                std::string_view name) {
    require(!mInsidePass, "pass '{}': bind group '{}' is made inside of a pass; make it in beforePass",
            mPlan.graph->passes()[mPass].name, name);
    if (mIsRehearsal) return {};
    for (backend::BindGroupEntry const& entry : entries) {
        if (entry.texture) requireDeclaredRange(entry, name);
    }
    return mPlan.pool->bindGroup(mCommands, { .layout = layout, .entries = entries, .debugName = name });
}

} // namespace filament_core::framegraph
