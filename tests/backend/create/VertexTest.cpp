// SPDX-License-Identifier: Apache-2.0
// What a vertex stage reads from each vertex format, and from missing attributes.
#include "tests/backend/create/Gpu.h"

#include "base/math/Half.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace filament_core::backend {
namespace {

DRIVER_SUITE(Vertex);

// One pixel shows the attribute of one vertex.
std::string vertexReading(std::string_view type, std::string_view toVec4) {
    return "#version 450\nlayout(location = 3) in " + std::string(type) +
           " value;\nlayout(location = 0) flat out vec4 seen;\n" + "void main() {\n    seen = " + std::string(toVec4) +
           ";\n    gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.5, 1.0);\n}\n";
}

constexpr std::string_view kShowSeen = R"(#version 450
layout(location = 0) flat in vec4 seen;
layout(location = 0) out vec4 result;
void main() { result = seen; })";

Rgba readAttribute(Gpu& gpu, VertexFormat format, Bytes const& vertex) {
    VertexFormatInfo const& info = vertexFormatInfo(format);
    const bool isSigned =
            format == VertexFormat::Byte4 || format == VertexFormat::Short2 || format == VertexFormat::Short4;
    const std::string type = !info.integer ? "vec4" : info.components == 1 ? "uint" : isSigned ? "ivec4" : "uvec4";
    const std::string value = !info.integer          ? "value"
                              : info.components == 1 ? "vec4(float(value), 0.0, 0.0, 1.0)"
                                                     : "vec4(value)";
    const TextureHandle target = gpu.target(Format::RGBA32F, 1, 1);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 1, 1);
    PipelineDesc desc = pipelineFor(gpu.program(vertexReading(type, value), kShowSeen), pass.layout);
    const auto stride = static_cast<uint16_t>((vertex.size() + 3) / 4 * 4 + 4); // other data follows each vertex
    desc.vertices.attributes[0] = { .location = 3, .buffer = 0, .format = format, .offset = 4 };
    desc.vertices.attributeCount = 1;
    desc.vertices.buffers[0].stride = stride;
    desc.vertices.bufferCount = 1;
    std::vector<std::byte> contents(3u * stride, std::byte{ 0xEE });
    for (size_t i = 0; i < 3; ++i)
        std::ranges::copy(vertex, contents.begin() + static_cast<std::ptrdiff_t>(i * stride + 4));
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, contents);
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { buffer }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    return gpu.readAs<Rgba>(target, { 0, 0, 1, 1 })[0];
}

template <class T>
void expectReads(Gpu& gpu, VertexFormat format, std::vector<T> const& components, Rgba const& expected) {
    SCOPED_TRACE(vertexFormatInfo(format).name);
    const Rgba seen = readAttribute(gpu, format, bytesOf(components));
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(seen[i], expected[i], 1e-6 * std::max(1.0f, std::abs(expected[i]))) << "component " << i;
}

DRIVER_TEST(Vertex, FloatFormatsFillMissingComponentsWithZeroZeroOne) {
    expectReads<float>(gpu, VertexFormat::Float, { -1.5f }, { -1.5f, 0, 0, 1 });
    expectReads<float>(gpu, VertexFormat::Float2, { 1, 2 }, { 1, 2, 0, 1 });
    expectReads<float>(gpu, VertexFormat::Float3, { 1, 2, 3 }, { 1, 2, 3, 1 });
    expectReads<float>(gpu, VertexFormat::Float4, { 1, 2, 3, 1e30f }, { 1, 2, 3, 1e30f });
}

DRIVER_TEST(Vertex, HalfFormatsAreExact) {
    const auto half = [](float value) { return halfFromFloat(value); };
    expectReads<uint16_t>(gpu, VertexFormat::Half2, { half(0.333f), half(-65504) },
                          { floatFromHalf(half(0.333f)), -65504, 0, 1 });
    expectReads<uint16_t>(gpu, VertexFormat::Half4, { half(1), half(2), half(0.5f), half(6e-8f) },
                          { 1, 2, 0.5f, floatFromHalf(half(6e-8f)) });
}

DRIVER_TEST(Vertex, NormalizedFormatsSpanZeroToOneOrMinusOneToOne) {
    expectReads<uint8_t>(gpu, VertexFormat::UByte4N, { 0, 51, 128, 255 }, { 0, 0.2f, 128 / 255.0f, 1 });
    expectReads<int8_t>(gpu, VertexFormat::Byte4N, { 127, -127, -128, 64 },
                        { 1, -1, -1, 64 / 127.0f }); // both ends clamp to -1
    expectReads<uint16_t>(gpu, VertexFormat::UShort2N, { 65535, 13107 }, { 1, 0.2f, 0, 1 });
    expectReads<uint16_t>(gpu, VertexFormat::UShort4N, { 0, 1, 32768, 65535 },
                          { 0, 1 / 65535.0f, 32768 / 65535.0f, 1 });
    expectReads<int16_t>(gpu, VertexFormat::Short2N, { -32768, 16384 }, { -1, 16384 / 32767.0f, 0, 1 });
    expectReads<int16_t>(gpu, VertexFormat::Short4N, { 32767, -32767, 0, 1 }, { 1, -1, 0, 1 / 32767.0f });
}

DRIVER_TEST(Vertex, IntegerFormatsReachIntegerInputsUnchanged) {
    expectReads<uint8_t>(gpu, VertexFormat::UByte4, { 0, 1, 128, 255 }, { 0, 1, 128, 255 });
    expectReads<int8_t>(gpu, VertexFormat::Byte4, { 0, -1, -128, 127 }, { 0, -1, -128, 127 });
    expectReads<uint16_t>(gpu, VertexFormat::UShort2, { 65535, 7 }, { 65535, 7, 0, 1 });
    expectReads<uint16_t>(gpu, VertexFormat::UShort4, { 65535, 7, 0, 256 }, { 65535, 7, 0, 256 });
    expectReads<int16_t>(gpu, VertexFormat::Short2, { -32768, 7 }, { -32768, 7, 0, 1 });
    expectReads<int16_t>(gpu, VertexFormat::Short4, { -32768, 32767, -1, 3 }, { -32768, 32767, -1, 3 });
    expectReads<uint32_t>(gpu, VertexFormat::UInt, { 1u << 23 }, { 1 << 23, 0, 0, 1 });
}

DRIVER_TEST(Vertex, AttributesThatTheLayoutLacksReadAsZeroZeroZeroOne) {
    for (const std::string_view type : { "vec4", "ivec4", "uvec4" }) {
        SCOPED_TRACE(type);
        const Program program = gpu.program(vertexReading(type, "vec4(value)"), kShowSeen);
        const TextureHandle target = gpu.paint(program, { .width = 1, .height = 1 }); // paint() has no vertex buffers
        const Rgba seen = gpu.readAs<Rgba>(target, { 0, 0, 1, 1 })[0];
        EXPECT_EQ(seen, (Rgba{ 0, 0, 0, 1 }));
    }
}

DRIVER_TEST(Vertex, AMissingAttributeStaysMissingAfterAPipelineThatHadIt) {
    const Program program = gpu.program(vertexReading("vec4", "value"), kShowSeen);
    const TextureHandle target = gpu.target(Format::RGBA32F, 1, 1);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 1, 1);
    PipelineDesc desc = pipelineFor(program, pass.layout);
    const PipelineHandle without = gpu.pipeline(desc);
    desc.vertices.attributes[0] = { .location = 3, .buffer = 0, .format = VertexFormat::Float4 };
    desc.vertices.attributeCount = desc.vertices.bufferCount = 1;
    desc.vertices.buffers[0].stride = 16;
    const PipelineHandle with = gpu.pipeline(desc);
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, std::vector<Rgba>(3, Rgba{ 7, 7, 7, 7 }));
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ with });
    gpu.record(CmdBindVertexBuffers{ .buffers = { buffer }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdBindPipeline{ without });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    EXPECT_EQ(gpu.readAs<Rgba>(target, { 0, 0, 1, 1 })[0], (Rgba{ 0, 0, 0, 1 }));
}

} // namespace
} // namespace filament_core::backend
