// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/page/ReportCamera.h"

#include "tests/tools/bake/GridRooms.h"
#include "tools/reference/TracedScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace filament_core::bake {
namespace {

class ReportCamera : public ::testing::Test {
protected:
    ReportCamera() {
        test::GridRoom room;
        for (int axis = 0; axis < 3; ++axis) { // closed, of walls of 20 cm
            for (const float side : { -1.0f, 1.0f }) {
                test::RoomBox box{ .half = float3(2.2f) };
                box.half[axis] = 0.1f;
                box.center[axis] = side * 2.1f;
                room.boxes.push_back(box);
            }
        }
        mScene.models = { { .data = reference::makeModel(test::boxesPrimitive(room.boxes), {}) } };
    }
    reference::ReferenceScene mScene;
    jobs::JobSystem mJobs{ { .workers = 0 } };
};

TEST_F(ReportCamera, OfWhatIsSeenFromInsideIsInside) {
    const Result<reference::TracedScenePtr> scene = reference::prepare(mScene, mJobs);
    ASSERT_TRUE(scene) << scene.error().message;
    const double3 places[] = { double3(0.5, -0.5, 0.25) };
    const std::vector<WeightedPoint> points = pointsAround(**scene, places);
    ASSERT_EQ(points.size(), 16u);
    for (WeightedPoint const& point : points)
        EXPECT_LT(glm::length(glm::max(glm::abs(point.position), double3(2.0)) - 2.0), 1e-6) << "on the walls";
    const Camera camera = reportCamera({}, {}, **scene, points);
    const double3 eye = glm::abs(camera.position());
    EXPECT_LT(std::max({ eye.x, eye.y, eye.z }), 2.0);
}

TEST_F(ReportCamera, IsThatOfTheCommandLine) {
    const Result<reference::TracedScenePtr> scene = reference::prepare(mScene, mJobs);
    ASSERT_TRUE(scene) << scene.error().message;
    const Exposure exposure{ .aperture = 4 };
    const Camera camera =
            reportCamera({ .eye = double3(1, 2, 3), .at = double3(1, 2, 0), .fovDegrees = 30 }, exposure, **scene, {});
    EXPECT_EQ(camera.position(), double3(1, 2, 3));
    EXPECT_EQ(double3(camera.worldFromView[2]), double3(0, 0, 1)) << "it looks along -Z";
    EXPECT_EQ(camera.lens.verticalFovDegrees, 30);
    EXPECT_EQ(camera.exposure, exposure);
}

} // namespace
} // namespace filament_core::bake
