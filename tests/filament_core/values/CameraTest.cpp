// SPDX-License-Identifier: Apache-2.0
// Projections in closed form: perspective and parallel, shifted, of any aspect.
#include "base/math/Elementary.h"
#include "base/math/Math.h"

#include <filament_core/Camera.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace filament_core {
namespace {

/// Lenses of every kind.
class RandomLens {
public:
    Lens next(bool isParallel) {
        Lens lens{ .verticalFovDegrees = within(5, 150), .nearMeters = within(0.01f, 1) };
        if (isParallel) {
            lens.orthographicHeight = within(0.1f, 100);
            lens.farMeters = lens.nearMeters + within(1, 1000);
        }
        if (coin()) lens.shift = { within(-2, 2), within(-2, 2) };
        if (coin()) lens.aspect = within(0.2f, 5);
        return lens;
    }
    float within(float low, float high) { return std::uniform_real_distribution<float>(low, high)(mRandom); }
    bool coin() { return mRandom() & 1; }

private:
    std::mt19937 mRandom{ 17 };
};

double3 project(Camera const& camera, double3 view, float aspect) {
    const double4 clip = double4x4(camera.clipFromView(aspect)) * double4(view, 1);
    return double3(clip) / clip.w;
}

TEST(Camera, ThePictureShowsWhatItSaysThatItShows) {
    RandomLens random;
    for (int i = 0; i < 2000; ++i) {
        Camera camera;
        camera.lens = random.next(i & 1);
        const float aspect = random.within(0.3f, 3);
        const double2 at(random.within(-1, 1), random.within(-1, 1));
        const double near = camera.lens.nearMeters, distance = near + random.within(0, 50);
        const double3 view = camera.viewFromPicture(at, distance, aspect);
        EXPECT_EQ(view.z, -distance);
        const double3 clip = project(camera, view, aspect);
        EXPECT_NEAR(clip.x, at.x, 2e-5) << i;
        EXPECT_NEAR(clip.y, at.y, 2e-5) << i;
        const double far = camera.lens.farMeters;
        const double depth = camera.lens.isOrthographic() ? (far - distance) / (far - near) : near / distance;
        EXPECT_NEAR(clip.z, depth, 2e-6) << i;
    }
}

TEST(Camera, ALensThatSaysNothingMoreHasThePictureItHad) {
    for (const float fov : { 10.0f, 45.0f, 60.0f, 120.0f }) {
        Camera camera;
        camera.lens = { .verticalFovDegrees = fov, .nearMeters = 0.1f };
        const float focal = 1.0f / elementary::tan(glm::radians(fov) * 0.5f);
        float4x4 expected(0.0f);
        expected[0][0] = focal / 1.5f;
        expected[1][1] = -focal;
        expected[2][3] = -1.0f;
        expected[3][2] = 0.1f;
        const float4x4 clip = camera.clipFromView(1.5f);
        EXPECT_EQ(std::memcmp(&clip, &expected, sizeof(clip)), 0) << fov << ", with the signs of its zeros";
    }
}

TEST(Camera, ABoxShowsItsEdges) {
    RandomLens random;
    for (int i = 0; i < 200; ++i) {
        const float left = random.within(-10, 5), right = left + random.within(0.1f, 10);
        const float bottom = random.within(-10, 5), top = bottom + random.within(0.1f, 10);
        Camera camera;
        camera.lens = Lens::orthographic(left, right, bottom, top, 0.5f, 20);
        EXPECT_TRUE(camera.lens.isOrthographic());
        const double3 low = project(camera, { left, bottom, -0.5 }, 3), high = project(camera, { right, top, -20 }, 3);
        EXPECT_NEAR(low.x, -1, 1e-4);
        EXPECT_NEAR(low.y, 1, 1e-4) << "row 0 is at the top";
        EXPECT_NEAR(low.z, 1, 1e-6);
        EXPECT_NEAR(high.x, 1, 1e-4);
        EXPECT_NEAR(high.y, -1, 1e-4);
        EXPECT_NEAR(high.z, 0, 1e-6);
        camera.lens = Lens::offCenter(left, right, bottom, top, 0.5f);
        EXPECT_FALSE(camera.lens.isOrthographic());
        const double3 there = project(camera, double3(left, bottom, -1) * 7.0, 3);
        EXPECT_NEAR(there.x, -1, 1e-4);
        EXPECT_NEAR(there.y, 1, 1e-4);
        EXPECT_NEAR(there.z, 0.5 / 7, 1e-6);
    }
}

// A pinhole at the focal length before the sensor: what meets its edge is as far off the axis as the edge is.
TEST(Camera, AFocalLengthShowsWhatTheSensorCovers) {
    EXPECT_NEAR(Lens::fromFocalLength(50).verticalFovDegrees, 26.99147f, 1e-4f) << "a normal lens of a full frame";
    EXPECT_NEAR(Lens::fromFocalLength(12).verticalFovDegrees, 90, 1e-4f);
    RandomLens random;
    for (int i = 0; i < 200; ++i) {
        const float focal = random.within(4, 800), height = random.within(2, 60), near = random.within(0.01f, 1);
        Camera camera;
        camera.lens = Lens::fromFocalLength(focal, height, near);
        EXPECT_FALSE(camera.lens.isOrthographic());
        const double3 edge = project(camera, double3(height / 2, height / 2, -focal) * 2.0, 1);
        EXPECT_NEAR(edge.x, 1, 2e-5) << focal << " mm, " << height << " mm";
        EXPECT_NEAR(edge.y, -1, 2e-5) << "row 0 is at the top";
        EXPECT_NEAR(edge.z, static_cast<double>(near) / (2 * focal), 1e-6);
    }
}

// Four quarters of an image, each with its own lens, add up to the image.
TEST(Camera, PartsOfAPictureMeet) {
    Camera whole;
    whole.lens = Lens::offCenter(-2, 2, -1, 1);
    RandomLens random;
    for (int i = 0; i < 100; ++i) {
        const double2 at(random.within(0, 1), random.within(-1, 0)); // of the upper right quarter
        Camera part;
        part.lens = Lens::offCenter(0, 2, 0, 1);
        const double3 expected = whole.viewFromPicture(at, 3, 1),
                      found = part.viewFromPicture(at * 2.0 + double2(-1, 1), 3, 1);
        EXPECT_NEAR(found.x, expected.x, 1e-5);
        EXPECT_NEAR(found.y, expected.y, 1e-5);
    }
}

TEST(Camera, ShiftCountsInPictures) {
    Camera straight, shifted;
    shifted.lens.shift = { 1, 0.5f };
    const double3 view = shifted.viewFromPicture({ 0, 0 }, 1, 1), edge = straight.viewFromPicture({ 1, -1 }, 1, 1);
    EXPECT_NEAR(view.x, 2 * edge.x, 1e-12) << "the middle of the picture to the right";
    EXPECT_NEAR(view.y, edge.y, 1e-12) << "the upper edge";
}

TEST(CameraDeathTest, LensesThatCannotBeAreRefused) {
    const auto matrixOf = [](Lens const& lens) {
        Camera camera;
        camera.lens = lens;
        return camera.clipFromView(1);
    };
    EXPECT_DEATH((void)Lens::fromFocalLength(0), "a focal length > 0");
    EXPECT_DEATH((void)Lens::fromFocalLength(50, -24), "a sensor > 0");
    const char* const rule = "a lens has a near plane > 0";
    EXPECT_DEATH(matrixOf({ .nearMeters = 0 }), rule);
    EXPECT_DEATH(matrixOf({ .nearMeters = NAN }), rule);
    EXPECT_DEATH(matrixOf({ .verticalFovDegrees = 180 }), rule);
    EXPECT_DEATH(matrixOf({ .nearMeters = 5, .orthographicHeight = 1, .farMeters = 5 }), rule);
    EXPECT_DEATH(matrixOf({ .nearMeters = -1, .orthographicHeight = 1 }), rule);
    EXPECT_DEATH(matrixOf({ .shift = { INFINITY, 0 } }), "finite");
    EXPECT_DEATH(matrixOf({ .aspect = -1 }), "finite");
    EXPECT_DEATH(Lens::orthographic(1, 1, 0, 1), "left < right");
    EXPECT_DEATH(Lens::offCenter(0, 1, 1, 0), "bottom < top");
}

} // namespace
} // namespace filament_core
