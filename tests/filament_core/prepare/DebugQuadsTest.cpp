// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DebugQuads.h"

#include <gtest/gtest.h>

namespace filament_core::prepare {
namespace {

TEST(DebugQuads, ALineIsARectangleOfItsWidthAroundItsEnds) {
    const ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }),
                          .size = { 640, 480 } };
    Arena arena;
    DebugDraw draw;
    draw.screenLine({ 100, 200 }, { 130, 240 }, { .widthPixels = 5 });
    draw.line({ 0, 0, 0 }, { 1, 0, 0 }, { .color = { 1, 0.5f, 0, 0.5f } });
    draw.line({ 0, 0, 20 }, { 1, 0, 30 });
    const DebugQuads quads = debugQuads(arena, draw, view);
    ASSERT_EQ(quads.count(), 2u) << "one is behind the camera";
    EXPECT_EQ(quads.tested, 1u);
    const auto pixel = [&](size_t i) {
        return (double2(float2(quads.vertices[i].position)) + 1.0) * 0.5 * double2(view.size);
    };
    EXPECT_NEAR(glm::distance(pixel(4), pixel(5)), 5, 1e-3);
    EXPECT_NEAR(glm::distance(pixel(5), pixel(6)), 50, 1e-3);
    EXPECT_LT(glm::distance((pixel(4) + pixel(5)) * 0.5, double2(100, 200)), 1e-3);
    EXPECT_LT(glm::distance((pixel(6) + pixel(7)) * 0.5, double2(130, 240)), 1e-3);
    EXPECT_EQ(quads.vertices[0].color, float4(0.5f, 0.25f, 0, 0.5f));
    const float depth = view.camera.lens.nearMeters / 10;
    EXPECT_NEAR(quads.vertices[0].position.z, depth * (1 + 1.0f / 2048), 1e-6f * depth);
}

} // namespace
} // namespace filament_core::prepare
