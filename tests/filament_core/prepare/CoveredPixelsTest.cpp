// SPDX-License-Identifier: Apache-2.0
// The part of the screen that effects of objects draw: nothing that an object covers lies beside it.
#include "filament_core/prepare/CoveredPixels.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

namespace filament_core::prepare {
namespace {

class CoveredPixelsTest : public testing::Test {
protected:
    backend::Rect covered(BoxScene const& boxes, ViewInput const& view) {
        mArena.reset();
        const FramePacket packet = prepareFrame(mJobs, mArena, boxes.scene, view);
        return coveredPixels(mJobs, mArena, boxes.scene, packet.mainView(), makeViewSpace(view), view.size);
    }
    static ViewInput viewOf(uint2 size) {
        return { .camera = Camera::lookAt({ 0.2, 0.1, 6 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }),
                 .size = size,
                 .quality = { .shadows = ShadowFilter::Off } };
    }

private:
    jobs::JobSystem mJobs{ { .workers = 1 } };
    Arena mArena;
};

/// In pixels; nothing, if it is behind the camera.
std::optional<float2> pixelOf(ViewInput const& view, double3 world) {
    const ViewSpace space = makeViewSpace(view);
    const float4 clip = space.clipFromWorld * float4(float3(world - space.cameraWorld), 1);
    if (clip.w <= 0) return std::nullopt;
    return (float2(clip) / clip.w * 0.5f + 0.5f) * float2(view.size);
}

void expectHolds(backend::Rect const& rect, uint2 size, float2 pixel) {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x > static_cast<float>(size.x) || pixel.y > static_cast<float>(size.y))
        return;
    constexpr float kLeast = kCoverMargin - 0.5f;
    const float2 first(rect.x, rect.y), end = first + float2(rect.width, rect.height);
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_TRUE(first[axis] == 0 || pixel[axis] - first[axis] >= kLeast) << pixel[axis] << " from " << first[axis];
        EXPECT_TRUE(end[axis] == static_cast<float>(size[axis]) || end[axis] - pixel[axis] >= kLeast)
                << pixel[axis] << " to " << end[axis];
    }
}

TEST_F(CoveredPixelsTest, HoldAllThatBoxesCoverAndTheMargin) {
    Random random(5);
    size_t pixels = 0, whole = 0;
    for (int i = 0; i < 3000; ++i) {
        BoxScene boxes;
        const scene::MaterialInstance* material = boxes.material();
        std::vector<double4x4> places;
        for (uint32_t n = 0; n < 1 + random.next() % 4; ++n) {
            const double3 at{ random.within(-3, 3), random.within(-3, 3), random.within(-20, 4) }; // in this order
            double4x4 world = glm::translate(double4x4(1), at);
            const double angle = random.within(0, 3), axis = random.within(-1, 1);
            world = glm::rotate(world, angle, glm::normalize(double3(1, axis, 0.3)));
            const double width = random.within(0.1, 2), height = random.within(0.1, 2);
            places.push_back(glm::scale(world, double3(width, height, 0.5)));
            boxes.add(places.back(), material);
        }
        ViewInput view = viewOf({ 40 + random.next() % 300, 40 + random.next() % 200 });
        view.samples = 4; // with one, objects between the centres of pixels are not drawn, and cover nothing
        const backend::Rect rect = covered(boxes, view);
        ASSERT_GT(rect.width, 0u);
        ASSERT_GT(rect.height, 0u);
        ASSERT_LE(static_cast<uint32_t>(rect.x) + rect.width, view.size.x);
        ASSERT_LE(static_cast<uint32_t>(rect.y) + rect.height, view.size.y);
        EXPECT_EQ(rect.x % 2, 0);
        EXPECT_EQ(rect.y % 2, 0);
        pixels += rect.width * rect.height;
        whole += view.size.x * view.size.y;
        for (double4x4 const& place : places) {
            for (int point = 0; point < 30; ++point) {
                const double4 inside{ random.within(-0.5, 0.5), random.within(-0.5, 0.5), random.within(-0.5, 0.5), 1 };
                if (const auto pixel = pixelOf(view, double3(place * inside))) expectHolds(rect, view.size, *pixel);
            }
        }
    }
    EXPECT_LT(pixels, whole * 7 / 10) << "most of the pictures are covered in part";
}

TEST_F(CoveredPixelsTest, AreAFewOfASmallObjectAndAllWhereABoxDoesNotSay) {
    const uint2 size(320, 200);
    BoxScene boxes;
    boxes.add(double3(0), boxes.material());
    const backend::Rect small = covered(boxes, viewOf(size));
    EXPECT_LT(small.width * small.height, size.x * size.y / 8);
    const backend::Rect all{ 0, 0, size.x, size.y };

    double4x4 world(1);
    world[3].z = 5.9; // around the camera
    const Renderable near = boxes.add(world, boxes.material());
    EXPECT_EQ(covered(boxes, viewOf(size)), all) << "it is beside the camera";
    removeRenderable(boxes.scene, near);
    EXPECT_EQ(covered(boxes, viewOf(size)), small);

    scene::RenderableInput input = BoxScene::box(double4x4(1), boxes.material(), 1);
    input.culled = false;
    const Renderable unculled = addRenderable(boxes.scene, input);
    EXPECT_EQ(covered(boxes, viewOf(size)), all) << "its box does not count";
    removeRenderable(boxes.scene, unculled);

    const scene::MaterialInstance* onScreen = boxes.material();
    boxes.materials.back().package.vertexDomain = shader::VertexDomain::Device;
    boxes.add(double3(0), onScreen);
    EXPECT_EQ(covered(boxes, viewOf(size)), all) << "its material places it on the screen";
}

TEST_F(CoveredPixelsTest, AreOfOnePixelOrMore) {
    BoxScene boxes;
    EXPECT_EQ(covered(boxes, viewOf({ 1, 1 })), (backend::Rect{ 0, 0, 1, 1 })) << "nothing is visible";
    boxes.add(double3(0), boxes.material());
    EXPECT_EQ(covered(boxes, viewOf({ 1, 1 })), (backend::Rect{ 0, 0, 1, 1 }));
    const backend::Rect line = covered(boxes, viewOf({ 16384, 1 }));
    EXPECT_EQ(line.height, 1u);
    EXPECT_GE(line.width, 1u);
}

} // namespace
} // namespace filament_core::prepare
