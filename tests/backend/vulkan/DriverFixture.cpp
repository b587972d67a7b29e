// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/vulkan/DriverFixture.h"

namespace filament_core::backend::vulkan {

BufferHandle DriverTest::makeBuffer(BufferUsage usage, std::span<const std::byte> bytes) {
    const auto buffer = handle<BufferHandle>();
    commands.record(CmdCreateBuffer{ buffer, { .size = bytes.size(), .usage = usage, .debugName = "buffer" } });
    commands.record(CmdUpdateBuffer{ buffer, 0, bytes });
    return buffer;
}

TextureHandle DriverTest::makeTexture(DeviceTextureDesc const& desc) {
    const auto texture = handle<TextureHandle>();
    commands.record(CmdCreateTexture{ texture, desc });
    return texture;
}

TextureHandle DriverTest::makeTarget(uint32_t width, uint32_t height, Format format) {
    const TextureUsage attachment = hasDepth(format) ? TextureUsage::DepthAttachment : TextureUsage::ColorAttachment;
    return makeTexture({ .format = format,
                         .usage = attachment | TextureUsage::TransferSource | TextureUsage::Sampled,
                         .width = width,
                         .height = height,
                         .debugName = "target" });
}

ProgramHandle DriverTest::makeProgram(std::string const& vertex, std::string const& fragment,
                                      ProgramLayout const& layout, std::span<const ConstantValue> constants) {
    const auto program = handle<ProgramHandle>();
    const std::vector<uint32_t> vertexWords = spirvFromGlsl(ShaderStage::Vertex, vertex);
    const std::vector<uint32_t> fragmentWords = spirvFromGlsl(ShaderStage::Fragment, fragment);
    ProgramDesc desc{ .layout = layout, .debugName = "program" };
    desc.vertex = std::as_bytes(std::span(vertexWords));
    desc.fragment = std::as_bytes(std::span(fragmentWords));
    desc.constants = constants;
    commands.record(CmdCreateProgram{ program, desc });
    return program;
}

PipelineHandle DriverTest::makePipeline(PipelineDesc const& desc) {
    const auto pipeline = handle<PipelineHandle>();
    commands.record(CmdCreatePipeline{ pipeline, desc });
    return pipeline;
}

BindGroupHandle DriverTest::makeGroup(BindGroupLayout const& layout, std::vector<BindGroupEntry> const& entries) {
    const auto group = handle<BindGroupHandle>();
    commands.record(CmdCreateBindGroup{ group, { .layout = layout, .entries = entries, .debugName = "group" } });
    return group;
}

PassLayout DriverTest::colorLayout(Format format) {
    PassLayout layout;
    layout.colorFormats[0] = format;
    layout.colorCount = 1;
    return layout;
}

void DriverTest::beginPass(TextureHandle color, uint32_t width, uint32_t height, std::array<float, 4> clear,
                           Format format) {
    PassDesc pass{ .layout = colorLayout(format), .area = { 0, 0, width, height }, .debugName = "pass" };
    pass.colors[0].texture = color;
    pass.colors[0].clear = clear;
    commands.record(CmdBeginPass{ pass });
}

std::vector<std::byte> DriverTest::read(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level,
                                        uint16_t layer) {
    const Ticket wanted = ticket();
    commands.record(CmdReadTexture{ texture, level, layer, { 0, 0, width, height }, wanted });
    finish();
    EXPECT_TRUE(sink.readbacks.contains(wanted.value)) << "the read-back was not answered";
    return sink.readbacks[wanted.value];
}

std::vector<Rgba8> DriverTest::readPixels(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level,
                                          uint16_t layer) {
    const std::vector<std::byte> bytes = read(texture, width, height, level, layer);
    std::vector<Rgba8> pixels(size_t{ width } * height);
    EXPECT_EQ(bytes.size(), pixels.size() * sizeof(Rgba8));
    if (bytes.size() == pixels.size() * sizeof(Rgba8)) std::memcpy(pixels.data(), bytes.data(), bytes.size());
    return pixels;
}

std::vector<float> DriverTest::readFloats(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level) {
    const std::vector<std::byte> bytes = read(texture, width, height, level);
    std::vector<float> values(bytes.size() / sizeof(float));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
}

} // namespace filament_core::backend::vulkan
