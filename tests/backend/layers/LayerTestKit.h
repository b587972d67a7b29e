// SPDX-License-Identifier: Apache-2.0
/// A small valid stream that uses every command, for tests to break in one place.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandBuffer.h"

#include <string>
#include <utility>
#include <vector>

namespace filament_core::backend::kit {

struct Errors final : ResultSink {
    std::vector<std::string> messages;
    std::vector<DriverErrorKind> kinds;
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind kind, std::string_view message) override {
        kinds.push_back(kind);
        messages.emplace_back(message);
    }
};

inline constexpr uint32_t kAlign = 256;
inline const BufferHandle kVertices = BufferHandle::make(0, 1), kIndices = BufferHandle::make(1, 1),
                          kUniforms = BufferHandle::make(2, 1), kBins = BufferHandle::make(3, 1);
inline const TextureHandle kColor = TextureHandle::make(0, 1), kDepth = TextureHandle::make(1, 1),
                           kImage = TextureHandle::make(2, 1), kSamples4 = TextureHandle::make(3, 1);
inline const SamplerHandle kSampler = SamplerHandle::make(0, 1), kCompare = SamplerHandle::make(1, 1);
inline const SurfaceHandle kWindow = SurfaceHandle::make(0, 1);
inline const ProgramHandle kProgram = ProgramHandle::make(0, 1), kCountProgram = ProgramHandle::make(1, 1);
inline const PipelineHandle kPipeline = PipelineHandle::make(0, 1), kCount = PipelineHandle::make(1, 1);
inline const BindGroupHandle kGroup = BindGroupHandle::make(0, 1), kCountGroup = BindGroupHandle::make(1, 1);

inline BindGroupLayout groupLayout() {
    BindGroupLayout layout;
    layout.count = 2;
    layout.bindings[0] = { .binding = 0, .type = BindingType::DynamicUniformBuffer };
    layout.bindings[1] = { .binding = 3, .type = BindingType::SampledTexture, .stages = ShaderStage::Fragment };
    return layout;
}

inline BindGroupLayout countLayout() {
    BindGroupLayout layout;
    layout.count = 2;
    layout.bindings[0] = { .binding = 0, .type = BindingType::StorageBuffer, .stages = ShaderStage::Compute };
    layout.bindings[1] = { .binding = 1, .type = BindingType::SampledTexture, .stages = ShaderStage::Compute };
    return layout;
}

inline PassLayout passLayout() {
    PassLayout layout;
    layout.colorFormats[0] = Format::RGBA8;
    layout.colorCount = 1;
    layout.depthFormat = Format::D32F;
    return layout;
}

inline PassDesc passDesc() {
    PassDesc desc;
    desc.layout = passLayout();
    desc.colors[0] = { .texture = kColor };
    desc.depth = { .texture = kDepth };
    desc.area = { 0, 0, 16, 16 };
    desc.debugName = "main";
    return desc;
}

inline PipelineDesc pipelineDesc() {
    PipelineDesc desc;
    desc.program = kProgram;
    desc.pass = passLayout();
    desc.vertices.attributeCount = 2;
    desc.vertices.bufferCount = 2;
    desc.vertices.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float3, .offset = 0 };
    desc.vertices.attributes[1] = { .location = 5, .buffer = 1, .format = VertexFormat::UByte4N, .offset = 4 };
    desc.vertices.buffers[0] = { .stride = 12 };
    desc.vertices.buffers[1] = { .stride = 8, .perInstance = true };
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    desc.debugName = "painted";
    return desc;
}

inline std::vector<BindGroupEntry> groupEntries() {
    return { { .binding = 0, .buffer = kUniforms, .offset = 0, .size = 64 },
             { .binding = 3, .texture = kImage, .sampler = kSampler } };
}

inline std::vector<BindGroupEntry> countEntries() {
    return { { .binding = 0, .buffer = kBins, .offset = kAlign, .size = 64 },
             { .binding = 1, .texture = kImage, .sampler = kSampler, .range = oneLevel(1) } };
}

inline std::vector<std::byte> bytes(size_t count) { return std::vector<std::byte>(count, std::byte{ 0x5A }); }

inline CmdCreateProgram createProgram() {
    static const std::vector<std::byte> code = bytes(20);
    static const std::vector<ConstantValue> constants{
        { .id = 4, .bits = 0x3F800000, .type = ConstantValue::Type::Float }
    };
    CmdCreateProgram command{ kProgram, {} };
    command.desc.vertex = code;
    command.desc.fragment = code;
    command.desc.constants = constants;
    command.desc.layout[1] = groupLayout();
    command.desc.debugName = "paint";
    return command;
}

inline CmdCreateProgram createCountProgram() {
    CmdCreateProgram command{ kCountProgram, {} };
    command.desc.compute = createProgram().desc.vertex;
    command.desc.layout[0] = countLayout();
    command.desc.debugName = "count";
    return command;
}

inline void recordBuffers(CommandBuffer& to) {
    to.record(CmdCreateBuffer{ kVertices, { .size = 240, .usage = BufferUsage::Vertex, .debugName = "vertices" } });
    to.record(CmdCreateBuffer{ kIndices, { .size = 60, .usage = BufferUsage::Index, .debugName = "indices" } });
    to.record(CmdCreateBuffer{ kUniforms,
                               { .size = 2 * kAlign, .usage = BufferUsage::Uniform, .debugName = "uniforms" } });
    to.record(CmdCreateBuffer{
            kBins,
            { .size = 2 * kAlign, .usage = BufferUsage::Storage | BufferUsage::TransferSource, .debugName = "bins" } });
}

inline void recordTextures(CommandBuffer& to) {
    using enum TextureUsage;
    to.record(CmdCreateTexture{ kColor,
                                { .format = Format::RGBA8,
                                  .usage = ColorAttachment | TransferSource | TransferTarget,
                                  .width = 16,
                                  .height = 16,
                                  .debugName = "color" } });
    to.record(CmdCreateTexture{ kDepth,
                                { .format = Format::D32F,
                                  .usage = DepthAttachment | Sampled,
                                  .width = 16,
                                  .height = 16,
                                  .debugName = "depth" } });
    to.record(CmdCreateTexture{ kImage,
                                { .format = Format::RGBA8,
                                  .usage = Sampled | TransferSource | TransferTarget,
                                  .levels = 4,
                                  .width = 8,
                                  .height = 8,
                                  .debugName = "image" } });
    to.record(CmdCreateTexture{ kSamples4,
                                { .format = Format::RGBA8,
                                  .usage = ColorAttachment,
                                  .samples = 4,
                                  .width = 16,
                                  .height = 16,
                                  .debugName = "samples4" } });
    to.record(CmdCreateSampler{ kSampler, { .magFilter = Filter::Linear } });
    to.record(CmdCreateSampler{ kCompare, { .compare = CompareOp::Less } });
}

inline void recordSurface(CommandBuffer& to) {
    to.record(CmdCreateSurface{ kWindow,
                                { .window = 0x400001, .presentMode = PresentMode::Mailbox, .debugName = "window" } });
}

inline void recordPrograms(CommandBuffer& to) {
    to.record(createProgram());
    to.record(CmdCreatePipeline{ kPipeline, pipelineDesc() });
    const std::vector<BindGroupEntry> entries = groupEntries();
    to.record(CmdCreateBindGroup{ kGroup, { .layout = groupLayout(), .entries = entries, .debugName = "material" } });
    to.record(createCountProgram());
    to.record(CmdCreatePipeline{ kCount, { .program = kCountProgram, .debugName = "counted" } });
    const std::vector<BindGroupEntry> counted = countEntries();
    to.record(CmdCreateBindGroup{ kCountGroup,
                                  { .layout = countLayout(), .entries = counted, .debugName = "counters" } });
}

inline void recordObjects(CommandBuffer& to) {
    recordBuffers(to);
    recordTextures(to);
    recordPrograms(to);
    recordSurface(to);
}

inline void recordBindings(CommandBuffer& to) {
    to.record(CmdBindPipeline{ kPipeline });
    to.record(CmdBindGroup{ .group = kGroup, .index = 1, .dynamicCount = 1, .dynamicOffsets = { kAlign } });
    to.record(CmdBindVertexBuffers{ .buffers = { kVertices, kVertices }, .offsets = { 0, 120 }, .count = 2 });
    to.record(CmdBindIndexBuffer{ .buffer = kIndices, .offset = 0, .type = IndexFormat::UInt16 });
}

inline void recordDispatch(CommandBuffer& to, CmdDispatch const& size = { 4, 2, 1 }) {
    to.record(CmdBindPipeline{ kCount });
    to.record(CmdBindGroup{ .group = kCountGroup });
    to.record(size);
}

inline void recordContents(CommandBuffer& to) {
    const std::vector<std::byte> data = bytes(256);
    to.record(CmdUpdateBuffer{ kUniforms, kAlign, data });
    to.record(CmdUploadTexture{ .texture = kImage, .rect = { 0, 0, 8, 8 }, .bytes = data });
    to.record(CmdGenerateMips{ kImage });
}

/// Every command, used correctly.
inline void recordFrame(CommandBuffer& to, uint64_t frame = 1, uint64_t firstTicket = 1) {
    to.record(CmdBeginFrame{ frame });
    to.record(CmdPushGroup{ "frame" });
    recordContents(to);
    to.record(CmdBeginTimer{ { firstTicket } });
    to.record(CmdBeginPass{ passDesc() });
    recordBindings(to);
    to.record(CmdSetViewport{ { 0, 0, 16, 16 } });
    to.record(CmdSetScissor{ { 2, 2, 4, 4 } });
    to.record(CmdSetStencilReference{ 1, 2 });
    to.record(CmdDraw{ .vertexCount = 20, .instanceCount = 3 });
    to.record(CmdDrawIndexed{ .indexCount = 30, .instanceCount = 15 });
    to.record(CmdEndPass{});
    to.record(CmdEndTimer{ { firstTicket } });
    to.record(CmdBlit{ .source = kImage,
                       .target = kColor,
                       .sourceRect = { 0, 0, 8, 8 },
                       .targetRect = { 0, 0, 16, 16 },
                       .filter = Filter::Linear });
    to.record(CmdReadTexture{ .texture = kColor, .rect = { 0, 0, 16, 16 }, .ticket = { firstTicket + 1 } });
    recordDispatch(to);
    to.record(CmdReadBuffer{ .buffer = kBins, .offset = kAlign, .size = 64, .ticket = { firstTicket + 2 } });
    to.record(CmdPresent{ kWindow, kColor });
    to.record(CmdPopGroup{});
    to.record(CmdEndFrame{ frame });
}

inline void recordDestroys(CommandBuffer& to) {
    to.record(CmdDestroySurface{ kWindow });
    for (const BindGroupHandle group : { kGroup, kCountGroup }) to.record(CmdDestroyBindGroup{ group });
    for (const PipelineHandle pipeline : { kPipeline, kCount }) to.record(CmdDestroyPipeline{ pipeline });
    for (const ProgramHandle program : { kProgram, kCountProgram }) to.record(CmdDestroyProgram{ program });
    to.record(CmdDestroySampler{ kSampler });
    to.record(CmdDestroySampler{ kCompare });
    for (const TextureHandle texture : { kColor, kDepth, kImage, kSamples4 }) to.record(CmdDestroyTexture{ texture });
    for (const BufferHandle buffer : { kVertices, kIndices, kUniforms, kBins }) to.record(CmdDestroyBuffer{ buffer });
}

/// Two subpasses: the second reads what the first wrote.
inline PassDesc mergedPassDesc(TextureHandle first, TextureHandle second) {
    PassDesc desc;
    desc.layout.colorFormats[0] = desc.layout.colorFormats[1] = Format::RGBA8;
    desc.layout.colorCount = 2;
    desc.layout.subpassCount = 2;
    desc.layout.subpasses[0] = { .colorMask = 1 };
    desc.layout.subpasses[1] = { .colorMask = 2, .inputMask = 1 };
    desc.colors[0].texture = first;
    desc.colors[1].texture = second;
    desc.area = { 0, 0, 8, 8 };
    desc.debugName = "merged";
    return desc;
}

} // namespace filament_core::backend::kit
