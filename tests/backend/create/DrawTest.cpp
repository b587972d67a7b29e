// SPDX-License-Identifier: Apache-2.0
// Which pixels a draw touches, and with which vertices. Targets are RGBA32F, so that values are read back unchanged.
#include "tests/backend/create/Gpu.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <type_traits>

namespace filament_core::backend {
namespace {

using testing::Each;
using testing::ElementsAre;

DRIVER_SUITE(Draw);

constexpr Rgba kGreen{ 0, 1, 0, 1 }, kNone{ 0, 0, 0, 0 };

/// Clip space from pixels of a target: row 0 is the top row and y = -1.
Rgba at(double x, double y, uint32_t width, uint32_t height, float z = 0.5f) {
    return { static_cast<float>(x / width * 2 - 1), static_cast<float>(y / height * 2 - 1), z, 1 };
}

struct Setup {
    uint32_t width = 8, height = 8;
    TextureHandle target{};
    PassDesc pass{};
    PipelineHandle pipeline{};
};

Setup setUp(Gpu& gpu, uint32_t width, uint32_t height, std::function<void(PipelineDesc&)> const& change = {}) {
    Setup setup{ width, height };
    setup.target = gpu.target(Format::RGBA32F, width, height);
    setup.pass = passOver({ { setup.target, Format::RGBA32F } }, width, height);
    PipelineDesc desc = pipelineFor(gpu.program(kColorVertex, kColorFragment), setup.pass.layout);
    useColorVertices(desc);
    if (change) change(desc);
    setup.pipeline = gpu.pipeline(desc);
    return setup;
}

void beginWith(Gpu& gpu, Setup const& setup, BufferHandle vertices) {
    gpu.record(CmdBeginPass{ setup.pass });
    gpu.record(CmdBindPipeline{ setup.pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
}

std::vector<Rgba> endAndRead(Gpu& gpu, Setup const& setup) {
    gpu.record(CmdEndPass{});
    return gpu.readAs<Rgba>(setup.target, { 0, 0, setup.width, setup.height });
}

DRIVER_TEST(Draw, ATriangleCoversExactlyThePixelsWhoseCentresLieInside) {
    constexpr uint32_t kSize = 16;
    const Setup setup = setUp(gpu, kSize, kSize);
    // No pixel centre lies on an edge, so the three edge equations decide without ties.
    const double x[] = { 1.3, 14.1, 4.2 }, y[] = { 2.1, 5.7, 13.9 };
    std::vector<ColorVertex> vertices;
    for (int i = 0; i < 3; ++i) vertices.push_back({ at(x[i], y[i], kSize, kSize), kRed });
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, vertices);
    beginWith(gpu, setup, buffer);
    gpu.record(CmdDraw{ .vertexCount = 3 });
    const std::vector<Rgba> texels = endAndRead(gpu, setup);
    const auto edge = [&](int i, double px, double py) {
        const int j = (i + 1) % 3;
        return (x[j] - x[i]) * (py - y[i]) - (y[j] - y[i]) * (px - x[i]);
    };
    for (uint32_t row = 0; row < kSize; ++row) {
        for (uint32_t column = 0; column < kSize; ++column) {
            const double px = column + 0.5, py = row + 0.5;
            const bool inside = edge(0, px, py) > 0 && edge(1, px, py) > 0 && edge(2, px, py) > 0;
            ASSERT_EQ(texels[row * kSize + column], inside ? kRed : kNone) << column << ", " << row;
        }
    }
}

DRIVER_TEST(Draw, ColorsInterpolateLinearlyOverTheScreen) {
    constexpr uint32_t kSize = 8;
    const Setup setup = setUp(gpu, kSize, kSize);
    // color = (x, y, 0, 1) in units of the target; a triangle of twice its size covers it.
    const std::vector<ColorVertex> vertices{ { at(0, 0, kSize, kSize), { 0, 0, 0, 1 } },
                                             { at(2 * kSize, 0, kSize, kSize), { 2, 0, 0, 1 } },
                                             { at(0, 2 * kSize, kSize, kSize), { 0, 2, 0, 1 } } };
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, vertices);
    beginWith(gpu, setup, buffer);
    gpu.record(CmdDraw{ .vertexCount = 3 });
    const std::vector<Rgba> texels = endAndRead(gpu, setup);
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
        ASSERT_NEAR(texels[i][0], (i % kSize + 0.5) / kSize, 1e-6);
        ASSERT_NEAR(texels[i][1], (i / kSize + 0.5) / kSize, 1e-6) << "row 0 is the top row and y = -1";
    }
}

// One pixel per point: its colour identifies the vertex.
std::vector<ColorVertex> pointRow(uint32_t count) {
    std::vector<ColorVertex> vertices;
    for (uint32_t i = 0; i < count; ++i)
        vertices.push_back({ at(i + 0.5, 0.5, count, 1), { static_cast<float>(i + 1), 0, 0, 1 } });
    return vertices;
}

std::vector<float> reds(std::vector<Rgba> const& texels) {
    std::vector<float> values;
    for (Rgba const& texel : texels) values.push_back(texel[0]);
    return values;
}

constexpr std::string_view kPointVertex = R"(#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 vertexColor;
void main() {
    vertexColor = color;
    gl_Position = position;
    gl_PointSize = 1.0;
})";

Setup setUpPoints(Gpu& gpu, uint32_t width) {
    return setUp(gpu, width, 1, [&](PipelineDesc& desc) {
        desc.program = gpu.program(kPointVertex, kColorFragment).handle;
        desc.raster.topology = PrimitiveType::Points;
    });
}

DRIVER_TEST(Draw, FirstVertexAndCountSelectVertices) {
    const Setup setup = setUpPoints(gpu, 8);
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, pointRow(8));
    beginWith(gpu, setup, buffer);
    gpu.record(CmdDraw{ .vertexCount = 3, .firstVertex = 2 });
    EXPECT_THAT(reds(endAndRead(gpu, setup)), ElementsAre(0, 0, 3, 4, 5, 0, 0, 0));
}

DRIVER_TEST(Draw, VertexBufferOffsetsShiftTheVertices) {
    const Setup setup = setUpPoints(gpu, 8);
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, pointRow(8));
    gpu.record(CmdBeginPass{ setup.pass });
    gpu.record(CmdBindPipeline{ setup.pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { buffer }, .offsets = { 5 * sizeof(ColorVertex) }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 2 });
    EXPECT_THAT(reds(endAndRead(gpu, setup)), ElementsAre(0, 0, 0, 0, 0, 6, 7, 0));
}

DRIVER_TEST(Draw, IndicesOfBothWidthsSelectVerticesFromFirstIndexAndVertexOffset) {
    const Setup setup = setUpPoints(gpu, 8);
    const BufferHandle vertices = gpu.buffer(BufferUsage::Vertex, pointRow(8));
    const BufferHandle narrow = gpu.buffer(BufferUsage::Index, std::vector<uint16_t>{ 9, 9, 0, 3, 1 });
    const BufferHandle wide = gpu.buffer(BufferUsage::Index, std::vector<uint32_t>{ 9, 5, 7 });
    beginWith(gpu, setup, vertices);
    gpu.record(CmdBindIndexBuffer{ .buffer = narrow, .offset = 2, .type = IndexFormat::UInt16 });
    gpu.record(CmdDrawIndexed{ .indexCount = 3, .firstIndex = 1 }); // vertices 0, 3, 1
    gpu.record(CmdBindIndexBuffer{ .buffer = wide, .offset = 4, .type = IndexFormat::UInt32 });
    gpu.record(CmdDrawIndexed{ .indexCount = 2, .firstIndex = 0, .vertexOffset = -1 }); // vertices 4, 6
    EXPECT_THAT(reds(endAndRead(gpu, setup)), ElementsAre(1, 2, 0, 4, 5, 0, 7, 0));
}

constexpr std::string_view kInstanceVertex = R"(#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in float shift;
layout(location = 2) in vec4 color;
layout(location = 0) out vec4 vertexColor;
void main() {
    vertexColor = color;
    gl_Position = position + vec4(shift, 0.0, 0.0, 0.0);
    gl_PointSize = 1.0;
})";

struct Instance {
    float shift;
    Rgba color;
};

Setup setUpInstances(Gpu& gpu, uint32_t width) {
    return setUp(gpu, width, 1, [&](PipelineDesc& desc) {
        desc.program = gpu.program(kInstanceVertex, kColorFragment).handle;
        desc.raster.topology = PrimitiveType::Points;
        desc.vertices.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float4 };
        desc.vertices.attributes[1] = { .location = 1, .buffer = 1, .format = VertexFormat::Float, .offset = 0 };
        desc.vertices.attributes[2] = { .location = 2, .buffer = 1, .format = VertexFormat::Float4, .offset = 4 };
        desc.vertices.attributeCount = 3;
        desc.vertices.buffers[0] = { .stride = 16 };
        desc.vertices.buffers[1] = { .stride = sizeof(Instance), .perInstance = true };
        desc.vertices.bufferCount = 2;
    });
}

std::vector<Instance> instanceRow(uint32_t count) {
    std::vector<Instance> instances;
    for (uint32_t i = 0; i < count; ++i) {
        instances.push_back(
                { 2.0f * static_cast<float>(i) / static_cast<float>(count), { static_cast<float>(i + 1), 0, 0, 1 } });
    }
    return instances;
}

DRIVER_TEST(Draw, FirstInstanceOffsetsPerInstanceAttributesAndNothingElse) {
    const Setup setup = setUpInstances(gpu, 8);
    const BufferHandle vertices = gpu.buffer(BufferUsage::Vertex, std::vector<Rgba>{ at(0.5, 0.5, 8, 1) });
    const BufferHandle instances = gpu.buffer(BufferUsage::Vertex, instanceRow(8));
    const BufferHandle indices = gpu.buffer(BufferUsage::Index, std::vector<uint16_t>{ 0 });
    gpu.record(CmdBeginPass{ setup.pass });
    gpu.record(CmdBindPipeline{ setup.pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices, instances }, .count = 2 });
    gpu.record(CmdBindIndexBuffer{ .buffer = indices });
    gpu.record(CmdDraw{ .vertexCount = 1, .instanceCount = 2 });                           // instances 0, 1
    gpu.record(CmdDraw{ .vertexCount = 1, .instanceCount = 1, .firstInstance = 3 });       // instance 3
    gpu.record(CmdDrawIndexed{ .indexCount = 1, .instanceCount = 2, .firstInstance = 5 }); // instances 5, 6
    EXPECT_THAT(reds(endAndRead(gpu, setup)), ElementsAre(1, 2, 0, 4, 0, 6, 7, 0));
}

DRIVER_TEST(Draw, TopologiesConnectVerticesAsTheirNamesSay) {
    struct Case {
        PrimitiveType topology;
        std::vector<std::pair<double, double>> points;
        uint32_t expected; ///< pixels covered
    };
    const std::vector<Case> cases{
        { PrimitiveType::Triangles,
          { { 0, 0 }, { 4, 0 }, { 0, 4 }, { 4, 4 } },
          6 }, // an incomplete second triangle; no centre ties
        { PrimitiveType::TriangleStrip, { { 0, 0 }, { 4, 0 }, { 0, 4 }, { 4, 4 } }, 16 },
        { PrimitiveType::Lines, { { 0.5, 1.5 }, { 3.5, 1.5 }, { 0.5, 3.5 }, { 3.5, 3.5 } }, 6 },
        { PrimitiveType::LineStrip, { { 0.5, 0.5 }, { 3.5, 0.5 }, { 3.5, 3.5 } }, 6 },
        { PrimitiveType::Points, { { 0.5, 0.5 }, { 2.5, 3.5 } }, 2 },
    };
    for (Case const& one : cases) {
        SCOPED_TRACE(static_cast<int>(one.topology));
        const Setup setup = setUp(gpu, 4, 4, [&](PipelineDesc& desc) {
            desc.program = gpu.program(kPointVertex, kColorFragment).handle;
            desc.raster.topology = one.topology;
        });
        std::vector<ColorVertex> vertices;
        // 1e-3 beside the diagonal's pixel centres: ties are not tested here
        for (auto const& [x, y] : one.points) vertices.push_back({ at(x - 1e-3, y - 1e-3, 4, 4), kRed });
        const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, vertices);
        beginWith(gpu, setup, buffer);
        gpu.record(CmdDraw{ .vertexCount = static_cast<uint32_t>(vertices.size()) });
        uint32_t covered = 0;
        for (Rgba const& texel : endAndRead(gpu, setup)) covered += texel == kRed;
        EXPECT_EQ(covered, one.expected);
    }
}

DRIVER_TEST(Draw, LinesCoverTheSamePixelsOnEveryApi) {
    constexpr uint32_t kSize = 64;
    std::vector<ColorVertex> vertices;
    for (int i = 0; i < 48; ++i) { // a star whose rays begin and end anywhere in a pixel
        const double angle = 0.131 * i, inner = 3 + 0.37 * (i % 5), outer = 20 + 0.71 * (i % 13);
        for (const double radius : { inner, outer }) {
            const double x = 32 + radius * std::cos(angle), y = 32 + radius * std::sin(angle);
            vertices.push_back({ at(x, y, kSize, kSize), kRed });
        }
    }
    for (const PrimitiveType topology : { PrimitiveType::Lines, PrimitiveType::LineStrip }) {
        const Setup setup = setUp(gpu, kSize, kSize, [&](PipelineDesc& desc) { desc.raster.topology = topology; });
        beginWith(gpu, setup, gpu.buffer(BufferUsage::Vertex, vertices));
        gpu.record(CmdDraw{ .vertexCount = static_cast<uint32_t>(vertices.size()) });
        const auto pixels = endAndRead(gpu, setup);
        EXPECT_THAT(pixels, ::testing::Contains(kRed));
        static std::map<PrimitiveType, std::remove_const_t<decltype(pixels)>> ofFirstApi;
        const auto [first, isFirst] = ofFirstApi.try_emplace(topology, pixels);
        EXPECT_TRUE(isFirst || first->second == pixels) << static_cast<int>(topology);
    }
}

DRIVER_TEST(Draw, CullingFollowsTheWindingAsSeenInThePicture) {
    // In the image (row 0 on top): right along the top edge, then down to the left, is clockwise.
    const std::vector<ColorVertex> clockwise{ { at(0, 0, 4, 4), kRed },
                                              { at(8, 0, 4, 4), kRed },
                                              { at(0, 8, 4, 4), kRed } };
    std::vector<ColorVertex> counterClockwise{ clockwise[0], clockwise[2], clockwise[1] };
    const BufferHandle buffers[] = { gpu.buffer(BufferUsage::Vertex, clockwise),
                                     gpu.buffer(BufferUsage::Vertex, counterClockwise) };
    for (const CullMode cull : { CullMode::None, CullMode::Front, CullMode::Back }) {
        for (const FrontFace front : { FrontFace::CounterClockwise, FrontFace::Clockwise }) {
            const Setup setup = setUp(
                    gpu, 4, 4, [&](PipelineDesc& desc) { desc.raster.cull = cull, desc.raster.frontFace = front; });
            for (int winding = 0; winding < 2; ++winding) {
                const bool isFront = (front == FrontFace::Clockwise) == (winding == 0);
                const bool drawn = cull == CullMode::None || (cull == CullMode::Back) == isFront;
                beginWith(gpu, setup, buffers[winding]);
                gpu.record(CmdDraw{ .vertexCount = 3 });
                EXPECT_THAT(endAndRead(gpu, setup), Each(drawn ? kRed : kNone))
                        << "cull " << static_cast<int>(cull) << " front " << static_cast<int>(front) << " winding "
                        << winding;
            }
        }
    }
}

DRIVER_TEST(Draw, FrontFacingAgreesWithTheFrontFaceOfThePipeline) {
    const Program program =
            gpu.program(kColorVertex, fragmentOf("layout(location = 0) in vec4 c;",
                                                 "result = gl_FrontFacing ? vec4(0, 1, 0, 1) : vec4(1, 0, 0, 1);"));
    const std::vector<ColorVertex> clockwise{ { at(0, 0, 4, 4), kRed },
                                              { at(8, 0, 4, 4), kRed },
                                              { at(0, 8, 4, 4), kRed } };
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, clockwise);
    for (const FrontFace front : { FrontFace::CounterClockwise, FrontFace::Clockwise }) {
        const Setup setup = setUp(
                gpu, 4, 4, [&](PipelineDesc& desc) { desc.program = program.handle, desc.raster.frontFace = front; });
        beginWith(gpu, setup, buffer);
        gpu.record(CmdDraw{ .vertexCount = 3 });
        EXPECT_THAT(endAndRead(gpu, setup), Each(front == FrontFace::Clockwise ? kGreen : kRed));
    }
}

bool insideRect(uint32_t i, uint32_t width, Rect const& r) {
    const auto x = static_cast<int32_t>(i % width), y = static_cast<int32_t>(i / width);
    return x >= r.x && y >= r.y && x < r.x + static_cast<int32_t>(r.width) && y < r.y + static_cast<int32_t>(r.height);
}

DRIVER_TEST(Draw, TheScissorCutsWithRowZeroOnTopAndIsResetByThePass) {
    const Program program = gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(1.0, 0.0, 0.0, 1.0);"));
    const TextureHandle target = gpu.target(Format::RGBA32F, 8, 6);
    PassDesc pass = passOver({ { target, Format::RGBA32F } }, 8, 6);
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, pass.layout));
    const Rect scissor{ 1, 2, 5, 3 };
    for (const bool cut : { true, false }) {
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ pipeline });
        if (cut) gpu.record(CmdSetScissor{ scissor });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        gpu.record(CmdEndPass{});
        const std::vector<Rgba> texels = gpu.readAs<Rgba>(target, { 0, 0, 8, 6 });
        for (uint32_t i = 0; i < texels.size(); ++i)
            ASSERT_EQ(texels[i], !cut || insideRect(i, 8, scissor) ? kRed : kNone) << i;
    }
}

DRIVER_TEST(Draw, TheViewportMapsClipSpaceOntoItsRectangle) {
    constexpr std::string_view kQuad = R"(#version 450
void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0, 0.5, 1.0); })";
    const Program program = gpu.program(kQuad, fragmentOf("", "result = vec4(1.0, 0.0, 0.0, 1.0);"));
    const TextureHandle target = gpu.target(Format::RGBA32F, 8, 6);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 8, 6);
    PipelineDesc desc = pipelineFor(program, pass.layout);
    desc.raster.topology = PrimitiveType::TriangleStrip;
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdSetViewport{ { 3, 1, 4, 2 } });
    gpu.record(CmdDraw{ .vertexCount = 4 });
    gpu.record(CmdEndPass{});
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(target, { 0, 0, 8, 6 });
    for (uint32_t i = 0; i < texels.size(); ++i)
        ASSERT_EQ(texels[i], insideRect(i, 8, { 3, 1, 4, 2 }) ? kRed : kNone) << i;
}

DRIVER_TEST(Draw, FragCoordCountsPixelCentresFromTheTopLeft) {
    const Program program = gpu.program(kFullScreenVertex, fragmentOf("", "result = gl_FragCoord;"));
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(gpu.paint(program, { .width = 5, .height = 3 }), { 0, 0, 5, 3 });
    for (uint32_t i = 0; i < 15; ++i) {
        ASSERT_EQ(texels[i], (Rgba{ static_cast<float>(i % 5) + 0.5f, static_cast<float>(i / 5) + 0.5f, 0.5f, 1 }));
    }
}

DRIVER_TEST(Draw, PrimitivesCrossingTheNearPlaneAreClippedAtItsExactPlace) {
    const Setup setup = setUp(gpu, 8, 8);
    // z runs from -1 at the left edge to +1 at the right edge: the left half has z < 0 and is clipped.
    const std::vector<ColorVertex> vertices{ { { -1, -1, -1, 1 }, kRed },
                                             { { 3, -1, 3, 1 }, kRed },
                                             { { -1, 3, -1, 1 }, kRed } };
    const BufferHandle buffer = gpu.buffer(BufferUsage::Vertex, vertices);
    beginWith(gpu, setup, buffer);
    gpu.record(CmdDraw{ .vertexCount = 3 });
    const std::vector<Rgba> texels = endAndRead(gpu, setup);
    for (uint32_t i = 0; i < texels.size(); ++i) ASSERT_EQ(texels[i], i % 8 >= 4 ? kRed : kNone) << i;
}

} // namespace
} // namespace filament_core::backend
