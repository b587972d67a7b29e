// SPDX-License-Identifier: Apache-2.0
// The fixed-function state of pipelines as a pure function: without a cache, programs or a device.
#include "filament_core/passes/RasterStates.h"

#include <gtest/gtest.h>

namespace filament_core::passes {
namespace {

using namespace backend;

struct RasterStates : testing::Test {
    scene::Material material;
    scene::MaterialInstance instance{ .material = &material };
    scene::GeometryLayout geometry{ .topology = PrimitiveType::Lines };
    PassSlot slot{ .layout = { .depthFormat = Format::D32F } };

    PipelineDesc states(prepare::DrawPass pass = prepare::DrawPass::Only, bool mirrored = false) const {
        const PipelineUse use{ .instance = instance, .mirrored = mirrored, .pass = pass };
        return surfaceStates(slot, use, scene::initialRaster(material.package), geometry);
    }
};

TEST_F(RasterStates, TestForNearerDepthsInTheRangeOfTheView) {
    EXPECT_EQ(states().depthStencil.depthCompare, CompareOp::GreaterEqual);
    slot.depthRange = DepthRange::Ordinary;
    EXPECT_EQ(states().depthStencil.depthCompare, CompareOp::LessEqual);
    EXPECT_TRUE(states().depthStencil.depthWrite);
    slot.layout.depthFormat = Format::None;
    EXPECT_EQ(states().depthStencil, DepthStencilState{});
}

TEST_F(RasterStates, TurnTheFrontFaceOfMirroredObjects) {
    EXPECT_EQ(states().raster.frontFace, FrontFace::CounterClockwise);
    EXPECT_EQ(states(prepare::DrawPass::Only, true).raster.frontFace, FrontFace::Clockwise);
    EXPECT_EQ(states().raster.topology, PrimitiveType::Lines);
}

TEST_F(RasterStates, LeaveDepthAndNoColorInTheFirstOfTwoPasses) {
    material.package.blending = shader::Blending::Fade;
    material.package.transparency = shader::TransparencyMode::TwoPassesOneSide;
    const PipelineDesc first = states(prepare::DrawPass::First), second = states(prepare::DrawPass::Second);
    EXPECT_TRUE(first.depthStencil.depthWrite);
    EXPECT_EQ(first.blend[0].writeMask, 0);
    EXPECT_NE(second.blend[0].writeMask, 0);
    EXPECT_TRUE(second.blend[0].enabled);
}

TEST_F(RasterStates, OfAFullScreenTriangleCullNothingAndReadNoVertices) {
    const PipelineDesc desc = fullScreenStates(slot, material);
    EXPECT_EQ(desc.raster.cull, CullMode::None);
    EXPECT_EQ(desc.vertices.attributeCount, 0);
}

} // namespace
} // namespace filament_core::passes
