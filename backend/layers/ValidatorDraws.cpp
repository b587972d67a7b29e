// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validator.h"

#include <algorithm>
#include <cmath>

namespace filament_core::backend {

// ---------------------------------------------------------------------------------------------- state

void Validator::execute(CmdSetViewport const& command) {
    enter<CmdSetViewport>(Place::InsidePass);
    Viewport const& v = command.viewport;
    const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.width) && std::isfinite(v.height);
    require(finite && v.width > 0 && v.height > 0, Harm::Crash, "viewport {},{} {} x {}; finite and not empty", v.x,
            v.y, v.width, v.height);
}

void Validator::execute(CmdSetScissor const& command) {
    enter<CmdSetScissor>(Place::InsidePass);
    Rect const& r = command.rect;
    constexpr uint32_t kMax = 0x7FFFFFFF;
    require(r.x >= 0 && r.y >= 0 && r.width <= kMax - static_cast<uint32_t>(r.x & 0x7FFFFFFF) &&
                    r.height <= kMax - static_cast<uint32_t>(r.y & 0x7FFFFFFF),
            Harm::Crash, "scissor {},{} {} x {} begins outside; clamp it to the area", r.x, r.y, r.width, r.height);
}

void Validator::execute(CmdSetStencilReference const&) { enter<CmdSetStencilReference>(Place::InsidePass); }

void Validator::execute(CmdBindPipeline const& command) {
    enter<CmdBindPipeline>(Place::Anywhere);
    PipelineModel const* pipeline = need(mPipelines, command.pipeline, "pipeline");
    if (!pipeline) return;
    mObject = pipeline->name;
    if (!require(pipeline->isCompute == !mPass, Harm::Crash, "{}",
                 mPass ? "the pipeline is for dispatches; bind it outside of passes"
                       : "the pipeline is for draws; bind it inside of a pass")) {
        return;
    }
    if (mPass) {
        require(pipeline->desc.pass == mPass->desc.layout, Harm::Crash,
                "the pipeline was made for another PassLayout; create it with the layout of this pass");
        require(pipeline->desc.subpass == mPass->subpass, Harm::Crash,
                "the pipeline was made for subpass {}, the current one is {}", pipeline->desc.subpass, mPass->subpass);
    }
    if (PipelineModel const* before = mPipelines.find(mBound.pipeline)) {
        // Bindings stay valid only up to the first group in which the two programs differ.
        const auto differs = std::ranges::mismatch(before->layout, pipeline->layout).in1 - before->layout.begin();
        std::fill(mBound.groups.begin() + differs, mBound.groups.end(), BindGroupHandle{});
    }
    mBound.pipeline = command.pipeline;
}

void Validator::execute(CmdBindGroup const& command) {
    enter<CmdBindGroup>(Place::Anywhere);
    BindGroupModel const* group = need(mBindGroups, command.group, "bind group");
    if (!group) return;
    mObject = group->name;
    if (!require(command.index < kMaxBindGroups, Harm::Crash, "group index {}; 0..{}", command.index,
                 kMaxBindGroups - 1))
        return;
    const uint32_t expected = group->layout.dynamicCount();
    if (!require(command.dynamicCount == expected, Harm::Crash, "{} dynamic offsets; the layout has {}",
                 command.dynamicCount, expected)) {
        return;
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < group->layout.count; ++i) {
        BindingDesc const& binding = group->layout.bindings[i];
        if (binding.type != BindingType::DynamicUniformBuffer) continue;
        const uint32_t offset = command.dynamicOffsets[next++];
        require(offset % mInfo.limits.uniformOffsetAlignment == 0, Harm::Crash,
                "dynamic offset {} is no multiple of {} (DeviceLimits::uniformOffsetAlignment)", offset,
                mInfo.limits.uniformOffsetAlignment);
        BindGroupEntry const& entry = *std::ranges::find(group->entries, binding.binding, &BindGroupEntry::binding);
        BufferModel const* buffer = need(mBuffers, entry.buffer, "uniform buffer");
        if (!buffer) continue;
        require(entry.offset + offset + entry.size <= buffer->desc.size, Harm::Crash,
                "dynamic offset {} + offset {} + size {} leave buffer '{}' of {} bytes", offset, entry.offset,
                entry.size, buffer->name, buffer->desc.size);
    }
    mBound.groups[command.index] = command.group;
}

void Validator::execute(CmdBindVertexBuffers const& command) {
    enter<CmdBindVertexBuffers>(Place::InsidePass);
    if (!require(command.count <= kMaxVertexBuffers, Harm::Crash, "{} vertex buffers; at most {}", command.count,
                 kMaxVertexBuffers)) {
        return;
    }
    for (uint32_t i = 0; i < command.count; ++i) {
        BufferModel const* buffer = need(mBuffers, command.buffers[i], fmt::format("vertex buffer {}", i));
        if (!buffer) continue;
        require(has(buffer->desc.usage, BufferUsage::Vertex), Harm::Crash, "buffer '{}' lacks BufferUsage::Vertex",
                buffer->name);
        require(command.offsets[i] < buffer->desc.size, Harm::Crash, "offset {} leaves buffer '{}' of {} bytes",
                command.offsets[i], buffer->name, buffer->desc.size);
    }
    mBound.vertices = command;
}

void Validator::execute(CmdBindIndexBuffer const& command) {
    enter<CmdBindIndexBuffer>(Place::InsidePass);
    BufferModel const* buffer = need(mBuffers, command.buffer, "index buffer");
    if (!buffer) return;
    mObject = buffer->name;
    const uint32_t unit = command.type == IndexFormat::UInt16 ? 2 : 4;
    require(has(buffer->desc.usage, BufferUsage::Index), Harm::Crash, "the buffer lacks BufferUsage::Index");
    require(command.offset % unit == 0 && command.offset < buffer->desc.size, Harm::Crash,
            "offset {} is no multiple of {} inside {} bytes", command.offset, unit, buffer->desc.size);
    mBound.indices = command;
}

// ---------------------------------------------------------------------------------------------- draws

void Validator::execute(CmdDraw const& command) {
    enter<CmdDraw>(Place::InsidePass);
    PipelineModel const* pipeline = mPass ? checkBoundState() : nullptr;
    if (!pipeline || command.vertexCount == 0 || command.instanceCount == 0) return;
    checkVertexRange(*pipeline, uint64_t{ command.firstVertex } + command.vertexCount - 1,
                     uint64_t{ command.firstInstance } + command.instanceCount - 1);
}

void Validator::execute(CmdDrawIndexed const& command) {
    enter<CmdDrawIndexed>(Place::InsidePass);
    PipelineModel const* pipeline = mPass ? checkBoundState() : nullptr;
    if (!pipeline) return;
    if (!require(static_cast<bool>(mBound.indices.buffer), Harm::Crash, "no index buffer is bound")) return;
    BufferModel const* indices = need(mBuffers, mBound.indices.buffer, "index buffer");
    if (!indices || command.indexCount == 0 || command.instanceCount == 0) return;
    const uint64_t unit = mBound.indices.type == IndexFormat::UInt16 ? 2 : 4;
    const uint64_t end = mBound.indices.offset + (uint64_t{ command.firstIndex } + command.indexCount) * unit;
    require(end <= indices->desc.size, Harm::Crash, "indices {}..{} leave index buffer '{}' of {} bytes",
            command.firstIndex, uint64_t{ command.firstIndex } + command.indexCount, indices->name, indices->desc.size);
    // The vertices that the indices refer to are unknown here; the instances are known.
    checkVertexRange(*pipeline, 0, uint64_t{ command.firstInstance } + command.instanceCount - 1);
}

Validator::PipelineModel const* Validator::checkBoundState() {
    if (!require(static_cast<bool>(mBound.pipeline), Harm::Crash, "no pipeline is bound; record CmdBindPipeline"))
        return nullptr;
    PipelineModel const* pipeline = need(mPipelines, mBound.pipeline, "pipeline");
    if (!pipeline) return nullptr;
    mObject = pipeline->name;
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        if (pipeline->layout[i].count > 0) checkGroup(*pipeline, i);
    }
    return pipeline;
}

void Validator::execute(CmdDispatch const& command) {
    enter<CmdDispatch>(Place::OutsidePasses);
    if (mPass || !checkBoundState()) return;
    const uint32_t most = mInfo.limits.maxDispatchGroups;
    for (const uint32_t groups : { command.groupsX, command.groupsY, command.groupsZ }) {
        require(groups >= 1 && groups <= most, Harm::Crash, "{} work groups; 1..{} (DeviceLimits::maxDispatchGroups)",
                groups, most);
    }
}

void Validator::checkGroup(PipelineModel const& pipeline, uint32_t index) {
    BindGroupModel const* group = mBindGroups.find(mBound.groups[index]);
    if (!require(group != nullptr, Harm::Crash,
                 "group {} is not bound, or was lost by a pipeline of another layout; record CmdBindGroup", index)) {
        return;
    }
    if (!require(group->layout == pipeline.layout[index], Harm::Crash,
                 "group {} '{}' has another layout than the program", index, group->name)) {
        return;
    }
    checkGroupTextures(*group, index);
}

void Validator::checkGroupTextures(BindGroupModel const& group, uint32_t index) {
    for (uint32_t i = 0; i < group.layout.count; ++i) {
        BindingDesc const& binding = group.layout.bindings[i];
        BindGroupEntry const& entry = *std::ranges::find(group.entries, binding.binding, &BindGroupEntry::binding);
        if (entry.buffer) {
            need(mBuffers, entry.buffer,
                 fmt::format("buffer at binding {} of group {} '{}'", entry.binding, index, group.name));
            continue;
        }
        TextureModel const* texture =
                need(mTextures, entry.texture,
                     fmt::format("texture at binding {} of group {} '{}'", entry.binding, index, group.name));
        if (!texture || !mPass) continue;
        const TextureRange range = withCounts(entry.range, texture->desc.levels, texture->desc.layers);
        if (binding.type == BindingType::InputAttachment) {
            Attachment const& color = mPass->desc.colors[binding.inputAttachment % kMaxColorAttachments];
            require(color.texture == entry.texture && color.level == range.level && color.layer == range.layer,
                    Harm::Crash, "binding {} of group {} '{}': input attachment '{}' is not colour {} of this pass",
                    entry.binding, index, group.name, texture->name, binding.inputAttachment);
        } else {
            require(!isAttached(entry.texture, range), Harm::WrongResult,
                    "binding {} of group {} '{}' samples '{}', an attachment of this pass; copy it or use a subpass "
                    "input",
                    entry.binding, index, group.name, texture->name);
        }
    }
}

void Validator::checkVertexRange(PipelineModel const& pipeline, uint64_t lastVertex, uint64_t lastInstance) {
    VertexLayout const& layout = pipeline.desc.vertices;
    for (uint32_t i = 0; i < layout.attributeCount; ++i) {
        VertexAttribute const& attribute = layout.attributes[i];
        const uint32_t slot = attribute.buffer;
        if (!require(slot < mBound.vertices.count, Harm::Crash,
                     "attribute {} reads vertex buffer {}, which is not bound", attribute.location, slot)) {
            continue;
        }
        BufferModel const* buffer =
                need(mBuffers, mBound.vertices.buffers[slot], fmt::format("vertex buffer {}", slot));
        if (!buffer) continue;
        const uint64_t last = layout.buffers[slot].perInstance ? lastInstance : lastVertex;
        const uint64_t end = mBound.vertices.offsets[slot] + last * layout.buffers[slot].stride + attribute.offset +
                             vertexFormatInfo(attribute.format).bytes;
        require(end <= buffer->desc.size, Harm::Crash,
                "attribute {} of {} {} ends at byte {} of vertex buffer '{}' of {}", attribute.location,
                layout.buffers[slot].perInstance ? "instance" : "vertex", last, end, buffer->name, buffer->desc.size);
    }
}

} // namespace filament_core::backend
