// SPDX-License-Identifier: Apache-2.0
// Depth and stencil: what passes, what is written, bias and clamp. Depth reads back as floats.
#include "tests/backend/create/Gpu.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace filament_core::backend {
namespace {

using testing::Each;

DRIVER_SUITE(DepthStencil);

constexpr Rgba kWhite{ 1, 1, 1, 1 };

struct Scene {
    TextureHandle color, depth;
    PassDesc pass{};
    Program program{};
};

Scene makeScene(Gpu& gpu, uint32_t width, uint32_t height, Format depthFormat, Rgba depthClear) {
    Scene scene{ gpu.target(Format::RGBA32F, width, height), gpu.target(depthFormat, width, height) };
    scene.pass = passOver({ { scene.color, Format::RGBA32F } }, width, height);
    scene.pass.layout.depthFormat = depthFormat;
    scene.pass.depth = { .texture = scene.depth, .clear = depthClear };
    scene.program = gpu.program(kColorVertex, kColorFragment);
    return scene;
}

PipelineHandle pipelineWith(Gpu& gpu, Scene const& scene, std::function<void(PipelineDesc&)> const& change) {
    PipelineDesc desc = pipelineFor(scene.program, scene.pass.layout);
    useColorVertices(desc);
    change(desc);
    return gpu.pipeline(desc);
}

/// A triangle over the whole target in the plane z = a + b * x, where x goes from 0 at the left edge to 1 at the right
/// edge.
BufferHandle plane(Gpu& gpu, float a, float b, Rgba const& color = kWhite) {
    return gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ { { -1, -1, a, 1 }, color },
                                                                     { { 3, -1, a + 2 * b, 1 }, color },
                                                                     { { -1, 3, a, 1 }, color } });
}

void drawWith(Gpu& gpu, PipelineHandle pipeline, BufferHandle vertices) {
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
}

bool compares(CompareOp op, float incoming, float stored) {
    switch (op) {
    case CompareOp::Never:
        return false;
    case CompareOp::Less:
        return incoming < stored;
    case CompareOp::Equal:
        return incoming == stored;
    case CompareOp::LessEqual:
        return incoming <= stored;
    case CompareOp::Greater:
        return incoming > stored;
    case CompareOp::NotEqual:
        return incoming != stored;
    case CompareOp::GreaterEqual:
        return incoming >= stored;
    default:
        return true; // None, Always
    }
}

DRIVER_TEST(DepthStencil, EveryComparisonDecidesBetweenIncomingAndStoredDepth) {
    for (int i = 0; i <= static_cast<int>(CompareOp::Always); ++i) {
        const auto op = static_cast<CompareOp>(i);
        for (const float z : { 0.25f, 0.5f, 0.75f }) {
            const Scene scene = makeScene(gpu, 2, 2, Format::D32F, { 0.5f, 0, 0, 0 });
            const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
                desc.depthStencil = { .depthCompare = op, .depthWrite = true };
            });
            const BufferHandle vertices = plane(gpu, z, 0);
            gpu.record(CmdBeginPass{ scene.pass });
            drawWith(gpu, pipeline, vertices);
            gpu.record(CmdEndPass{});
            const bool passes = compares(op, z, 0.5f);
            EXPECT_THAT(gpu.readAs<Rgba>(scene.color, { 0, 0, 2, 2 }), Each(passes ? kWhite : Rgba{}))
                    << i << " at " << z;
            // None: no test and no writes.
            const float stored = passes && op != CompareOp::None ? z : 0.5f;
            EXPECT_THAT(gpu.readAs<float>(scene.depth, { 0, 0, 2, 2 }), Each(stored)) << i << " at " << z;
        }
    }
}

DRIVER_TEST(DepthStencil, ReversedDepthKeepsTheNearestOfThreePlanesInAnyOrder) {
    const Scene scene = makeScene(gpu, 4, 1, Format::D32F, { 0, 0, 0, 0 });
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [](PipelineDesc& desc) {
        desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    });
    const BufferHandle far = plane(gpu, 0.1f, 0, { 1, 0, 0, 1 }), near = plane(gpu, 0.4f, 0, { 0, 1, 0, 1 }),
                       sloped = plane(gpu, 0.0f, 1.0f, { 0, 0, 1, 1 });
    gpu.record(CmdBeginPass{ scene.pass });
    for (const BufferHandle vertices : { far, near, sloped, far }) drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    const std::vector<float> depth = gpu.readAs<float>(scene.depth, { 0, 0, 4, 1 });
    const std::vector<Rgba> color = gpu.readAs<Rgba>(scene.color, { 0, 0, 4, 1 });
    for (uint32_t x = 0; x < 4; ++x) {
        const float slopedDepth = (static_cast<float>(x) + 0.5f) / 4;
        EXPECT_FLOAT_EQ(depth[x], std::max(0.4f, slopedDepth));
        EXPECT_EQ(color[x], slopedDepth > 0.4f ? (Rgba{ 0, 0, 1, 1 }) : (Rgba{ 0, 1, 0, 1 })) << x;
    }
}

DRIVER_TEST(DepthStencil, ATestWithoutWriteLeavesDepthAlone) {
    const Scene scene = makeScene(gpu, 2, 2, Format::D32F, { 0.5f, 0, 0, 0 });
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [](PipelineDesc& desc) {
        desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = false };
    });
    const BufferHandle vertices = plane(gpu, 0.75f, 0);
    gpu.record(CmdBeginPass{ scene.pass });
    drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba>(scene.color, { 0, 0, 2, 2 }), Each(kWhite));
    EXPECT_THAT(gpu.readAs<float>(scene.depth, { 0, 0, 2, 2 }), Each(0.5f));
}

DRIVER_TEST(DepthStencil, ConstantBiasMovesFloatDepthByUnitsOfItsLastPlace) {
    const Scene scene = makeScene(gpu, 4, 4, Format::D32F, { 0, 0, 0, 0 });
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [](PipelineDesc& desc) {
        desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
        desc.raster.depthBiasConstant = 64;
    });
    const BufferHandle vertices = plane(gpu, 0.75f, 0);
    gpu.record(CmdBeginPass{ scene.pass });
    drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    // r = 2^(e - 23) for a float depth buffer, e the exponent of the largest z of the primitive: -1 for 0.75.
    const float expected = 0.75f + 64 * std::ldexp(1.0f, -1 - 23);
    EXPECT_THAT(gpu.readAs<float>(scene.depth, { 0, 0, 4, 4 }), Each(testing::FloatNear(expected, 2e-7f)));
}

DRIVER_TEST(DepthStencil, SlopeBiasGrowsWithTheSlopeOfThePlane) {
    const Scene scene = makeScene(gpu, 4, 4, Format::D32F, { 0, 0, 0, 0 });
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [](PipelineDesc& desc) {
        desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
        desc.raster.depthBiasSlope = -0.5f;
    });
    const BufferHandle vertices = plane(gpu, 0.25f, 0.5f);
    gpu.record(CmdBeginPass{ scene.pass });
    drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    const std::vector<float> depth = gpu.readAs<float>(scene.depth, { 0, 0, 4, 4 });
    const float slopePerPixel = 0.5f / 4;
    for (uint32_t i = 0; i < 16; ++i) {
        EXPECT_NEAR(depth[i], 0.25f + 0.5f * (static_cast<float>(i % 4) + 0.5f) / 4 - 0.5f * slopePerPixel, 1e-6) << i;
    }
}

DRIVER_TEST(DepthStencil, DepthClampKeepsWhatClippingWouldCut) {
    if (!gpu.info().features.depthClamp) GTEST_SKIP() << "this device has no depth clamp";
    for (const bool clamp : { false, true }) {
        const Scene scene = makeScene(gpu, 4, 1, Format::D32F, { 0.5f, 0, 0, 0 });
        const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
            desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
            desc.raster.depthClamp = clamp;
        });
        const BufferHandle vertices = plane(gpu, -1.0f, 4.0f); // centres at -0.5, 0.5, 1.5, 2.5
        gpu.record(CmdBeginPass{ scene.pass });
        drawWith(gpu, pipeline, vertices);
        gpu.record(CmdEndPass{});
        const std::vector<float> expected = clamp ? std::vector<float>{ 0, 0.5f, 1, 1 } : std::vector<float>(4, 0.5f);
        EXPECT_THAT(gpu.readAs<float>(scene.depth, { 0, 0, 4, 1 }),
                    testing::Pointwise(testing::FloatNear(1e-6f), expected))
                << clamp;
        const std::vector<Rgba> color = gpu.readAs<Rgba>(scene.color, { 0, 0, 4, 1 });
        for (uint32_t x = 0; x < 4; ++x) EXPECT_EQ(color[x], clamp || x == 1 ? kWhite : Rgba{}) << x;
    }
}

DRIVER_TEST(DepthStencil, FragmentShadersMayReplaceDepth) {
    Scene scene = makeScene(gpu, 4, 1, Format::D32F, { 0, 0, 0, 0 });
    scene.program = gpu.program(kColorVertex, fragmentOf("layout(location = 0) in vec4 c;",
                                                         "result = c;\ngl_FragDepth = floor(gl_FragCoord.x) * 0.25;"));
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [](PipelineDesc& desc) {
        desc.depthStencil = { .depthCompare = CompareOp::GreaterEqual, .depthWrite = true };
    });
    const BufferHandle vertices = plane(gpu, 0.5f, 0);
    gpu.record(CmdBeginPass{ scene.pass });
    drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<float>(scene.depth, { 0, 0, 4, 1 }), testing::ElementsAre(0, 0.25f, 0.5f, 0.75f));
}

// ---------------------------------------------------------------------------------------------- stencil

uint8_t applied(StencilOp op, uint8_t value, uint8_t reference) {
    switch (op) {
    case StencilOp::Keep:
        return value;
    case StencilOp::Zero:
        return 0;
    case StencilOp::Replace:
        return reference;
    case StencilOp::IncrementClamp:
        return value == 255 ? value : static_cast<uint8_t>(value + 1);
    case StencilOp::DecrementClamp:
        return value == 0 ? value : static_cast<uint8_t>(value - 1);
    case StencilOp::Invert:
        return static_cast<uint8_t>(~value);
    case StencilOp::IncrementWrap:
        return static_cast<uint8_t>(value + 1);
    case StencilOp::DecrementWrap:
        return static_cast<uint8_t>(value - 1);
    }
    return value;
}

/// Stencil cannot be read back: draws white where it equals `expected`.
void expectStencil(Gpu& gpu, Scene& scene, uint8_t expected, std::string const& what) {
    const StencilFace equal{ .compare = CompareOp::Equal };
    const PipelineHandle probe = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
        desc.depthStencil = { .stencilTest = true, .front = equal, .back = equal };
    });
    const BufferHandle vertices = plane(gpu, 0.5f, 0);
    PassDesc pass = scene.pass;
    pass.depth.load = LoadOp::Load;
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdSetStencilReference{ expected, expected });
    drawWith(gpu, probe, vertices);
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba>(scene.color, { 0, 0, 2, 2 }), Each(kWhite))
            << what << ": stencil is not " << int{ expected };
}

Rgba depthAndStencil(float depth, uint8_t stencil) { return { depth, static_cast<float>(stencil), 0, 0 }; }

DRIVER_TEST(DepthStencil, EveryStencilOperationChangesTheValueAsItsNameSays) {
    for (int i = 0; i <= static_cast<int>(StencilOp::DecrementWrap); ++i) {
        const auto op = static_cast<StencilOp>(i);
        for (const uint8_t start : { uint8_t{ 0 }, uint8_t{ 77 }, uint8_t{ 255 } }) {
            Scene scene = makeScene(gpu, 2, 2, Format::D32FS8, depthAndStencil(0.5f, start));
            const StencilFace face{ .pass = op };
            const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
                desc.depthStencil = { .stencilTest = true, .front = face, .back = face };
            });
            const BufferHandle vertices = plane(gpu, 0.5f, 0);
            gpu.record(CmdBeginPass{ scene.pass });
            gpu.record(CmdSetStencilReference{ 9, 9 });
            drawWith(gpu, pipeline, vertices);
            gpu.record(CmdEndPass{});
            expectStencil(gpu, scene, applied(op, start, 9), fmt::format("operation {} on {}", i, start));
        }
    }
}

DRIVER_TEST(DepthStencil, FailDepthFailAndPassEachHaveTheirOperation) {
    struct Case {
        CompareOp stencil, depth;
        uint8_t expected;
    };
    // reference 5 against stencil 5; z 0.5 against depth 0.25
    for (Case const& one :
         { Case{ CompareOp::NotEqual, CompareOp::Greater, 0 }, Case{ CompareOp::Equal, CompareOp::Less, 4 },
           Case{ CompareOp::Equal, CompareOp::Greater, 6 } }) {
        Scene scene = makeScene(gpu, 2, 2, Format::D32FS8, depthAndStencil(0.25f, 5));
        const StencilFace face{ .compare = one.stencil,
                                .fail = StencilOp::Zero,
                                .depthFail = StencilOp::DecrementWrap,
                                .pass = StencilOp::IncrementWrap };
        const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
            desc.depthStencil = { .depthCompare = one.depth, .stencilTest = true, .front = face, .back = face };
        });
        const BufferHandle vertices = plane(gpu, 0.5f, 0);
        gpu.record(CmdBeginPass{ scene.pass });
        gpu.record(CmdSetStencilReference{ 5, 5 });
        drawWith(gpu, pipeline, vertices);
        gpu.record(CmdEndPass{});
        expectStencil(gpu, scene, one.expected, fmt::format("expected {}", one.expected));
    }
}

DRIVER_TEST(DepthStencil, StencilMasksLimitWhatIsComparedAndWritten) {
    Scene scene = makeScene(gpu, 2, 2, Format::D32FS8, depthAndStencil(0.5f, 0xA5));
    // 0x05 == 0xA5 under 0x0F; Replace writes only the high nibble.
    const StencilFace face{
        .compare = CompareOp::Equal, .pass = StencilOp::Replace, .readMask = 0x0F, .writeMask = 0xF0
    };
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
        desc.depthStencil = { .stencilTest = true, .front = face, .back = face };
    });
    const BufferHandle vertices = plane(gpu, 0.5f, 0);
    gpu.record(CmdBeginPass{ scene.pass });
    gpu.record(CmdSetStencilReference{ 0x35, 0x35 });
    drawWith(gpu, pipeline, vertices);
    gpu.record(CmdEndPass{});
    expectStencil(gpu, scene, 0x35, "high nibble 3, low nibble kept");
}

DRIVER_TEST(DepthStencil, FrontAndBackFacesHaveTheirOwnReferencesAndOperations) {
    Scene scene = makeScene(gpu, 2, 2, Format::D32FS8, depthAndStencil(0.5f, 1));
    const PipelineHandle pipeline = pipelineWith(gpu, scene, [&](PipelineDesc& desc) {
        desc.depthStencil = { .stencilTest = true,
                              .front = { .pass = StencilOp::Replace },
                              .back = { .pass = StencilOp::Zero } };
        desc.raster.frontFace = FrontFace::Clockwise; // plane() is clockwise in the image
    });
    const BufferHandle front = plane(gpu, 0.5f, 0);
    gpu.record(CmdBeginPass{ scene.pass });
    gpu.record(CmdSetStencilReference{ 200, 100 });
    drawWith(gpu, pipeline, front);
    gpu.record(CmdEndPass{});
    expectStencil(gpu, scene, 200, "front face");
}

} // namespace
} // namespace filament_core::backend
