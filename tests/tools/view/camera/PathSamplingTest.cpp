// SPDX-License-Identifier: Apache-2.0
#include "tools/view/camera/PathSampling.h"
#include "tests/tools/view/camera/RandomCameras.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::view {
namespace {

/// All keys have one kind of lens.
CameraPath pathOf(Draw& draw, bool isClosed) {
    CameraPath path{ .isClosed = isClosed, .closingSeconds = draw.number(0.2, 3) };
    const int count = 2 + static_cast<int>(draw.number(0, 6));
    const bool isParallel = draw.coin();
    double seconds = draw.number(-5, 5);
    for (int i = 0; i < count; ++i) {
        Camera camera = draw.rolled();
        camera.lens.orthographicHeight = isParallel ? static_cast<float>(draw.logarithmic(0.1, 10)) : 0;
        path.keys.push_back({ .seconds = seconds, .camera = camera });
        seconds += draw.number(0.2, 3);
    }
    return path;
}

void expectNear(Camera const& a, Camera const& b, double tolerance) {
    EXPECT_LT(apart(a, b), tolerance);
    const auto near = [&](float x, float y) {
        EXPECT_NEAR(static_cast<double>(x), static_cast<double>(y),
                    tolerance * std::max(1.0, std::abs(static_cast<double>(y))));
    };
    near(a.lens.verticalFovDegrees, b.lens.verticalFovDegrees);
    near(a.lens.nearMeters, b.lens.nearMeters);
    near(a.lens.farMeters, b.lens.farMeters);
    near(a.lens.orthographicHeight, b.lens.orthographicHeight);
    near(a.lens.shift.x, b.lens.shift.x);
    near(a.lens.shift.y, b.lens.shift.y);
    near(a.exposure.aperture, b.exposure.aperture);
    near(a.exposure.shutterSeconds, b.exposure.shutterSeconds);
    near(a.exposure.iso, b.exposure.iso);
}

TEST(CameraPath, PassesThroughItsKeys) {
    Draw draw(1);
    for (int round = 0; round < 300; ++round) {
        const CameraPath path = pathOf(draw, round % 2 == 0);
        for (CameraKey const& key : path.keys) {
            const double seconds = key.seconds - path.keys.front().seconds;
            expectNear(sampled(path, seconds), key.camera, 1e-5);
            expectNear(sampled(path, seconds + 1e-7), key.camera, 1e-4);
            if (seconds > 0) expectNear(sampled(path, seconds - 1e-7), key.camera, 1e-4);
        }
    }
}

TEST(CameraPath, HasNoJumpOfSpeedAtItsKeys) {
    Draw draw(2);
    constexpr double kStep = 1e-4;
    for (int round = 0; round < 300; ++round) {
        const CameraPath path = pathOf(draw, true);
        for (CameraKey const& key : path.keys) {
            const double at = key.seconds - path.keys.front().seconds;
            const double4x4 before =
                    (sampled(path, at).worldFromView - sampled(path, at - kStep).worldFromView) / kStep;
            const double4x4 after = (sampled(path, at + kStep).worldFromView - sampled(path, at).worldFromView) / kStep;
            double speed = 1, jump = 0;
            for (int c = 0; c < 4; ++c) {
                speed = std::max(speed, glm::length(before[c]));
                jump = std::max(jump, glm::length(after[c] - before[c]));
            }
            EXPECT_LT(jump, 0.02 * speed); // accelerations over a step
        }
    }
}

TEST(CameraPath, ReproducesConstantAccelerationExactly) {
    Draw draw(3);
    for (int round = 0; round < 200; ++round) {
        const double3 start = draw.point(5), speed = draw.point(3), acceleration = draw.point(2);
        const auto at = [&](double t) { return start + speed * t + acceleration * (t * t / 2); };
        CameraPath path;
        double t = 0;
        for (int i = 0; i < 5; ++i) {
            Camera camera;
            camera.worldFromView[3] = double4(at(t), 1);
            path.keys.push_back({ .seconds = t, .camera = camera });
            t += draw.number(0.1, 2);
        }
        for (int i = 0; i < 50; ++i) {
            const double when = draw.number(0, durationOf(path));
            EXPECT_LT(glm::length(sampled(path, when).position() - at(when)), 1e-9);
        }
    }
}

TEST(CameraPath, TurnsEvenlyBetweenEvenTurns) {
    CameraPath path;
    for (int i = 0; i < 5; ++i) {
        Camera camera;
        camera.worldFromView = glm::rotate(double4x4(1.0), 0.8 * i, glm::normalize(double3(1, 2, -1)));
        path.keys.push_back({ .seconds = 0.5 * i, .camera = camera });
    }
    for (double t = 0; t < 2; t += 0.01) {
        Camera expected;
        expected.worldFromView = glm::rotate(double4x4(1.0), 1.6 * t, glm::normalize(double3(1, 2, -1)));
        EXPECT_LT(apart(sampled(path, t), expected), 1e-9);
    }
}

TEST(CameraPath, ZoomsEvenly) {
    CameraPath path;
    for (int i = 0; i < 4; ++i) {
        Camera camera{ .lens = { .orthographicHeight = static_cast<float>(std::pow(2.0, i)) } };
        path.keys.push_back({ .seconds = static_cast<double>(i), .camera = camera });
    }
    for (double t = 0; t < 3; t += 0.1)
        EXPECT_NEAR(static_cast<double>(sampled(path, t).lens.orthographicHeight), std::pow(2.0, t), 1e-5);
}

TEST(CameraPath, IsARigidCameraEverywhere) {
    Draw draw(4);
    for (int round = 0; round < 300; ++round) {
        CameraPath path = pathOf(draw, draw.coin());
        for (CameraKey& key : path.keys) {
            if (draw.coin()) key.camera.lens.orthographicHeight = draw.coin() ? 1.0f : 0.0f;
        }
        for (int i = 0; i < 20; ++i) {
            const Camera camera = sampled(path, draw.number(-1, durationOf(path) + 1));
            EXPECT_LT(turnError(camera), 1e-12);
            EXPECT_GT(camera.lens.verticalFovDegrees, 0);
            EXPECT_LT(camera.lens.verticalFovDegrees, 180);
            EXPECT_GT(camera.lens.farMeters, camera.lens.nearMeters);
            EXPECT_TRUE(std::isfinite(glm::length(camera.position())));
        }
    }
}

TEST(CameraPath, StaysAtItsEndsOrGoesRound) {
    Draw draw(5);
    for (int round = 0; round < 100; ++round) {
        CameraPath path = pathOf(draw, false);
        EXPECT_EQ(apart(sampled(path, -3), path.keys.front().camera), 0);
        EXPECT_EQ(apart(sampled(path, durationOf(path) + 3), path.keys.back().camera), 0);
        path.isClosed = true;
        const double when = draw.number(0, durationOf(path));
        EXPECT_LT(apart(sampled(path, when), sampled(path, when + 3 * durationOf(path))), 1e-8);
        EXPECT_LT(apart(sampled(path, when), sampled(path, when - 2 * durationOf(path))), 1e-8);
    }
    EXPECT_EQ(apart(sampled(CameraPath{}, 1), Camera{}), 0);
    const CameraPath one{ .keys = { { .seconds = 4, .camera = draw.camera() } }, .isClosed = true };
    EXPECT_EQ(durationOf(one), 0);
    EXPECT_EQ(apart(sampled(one, 1), one.keys[0].camera), 0);
}

TEST(CameraPath, HasFramesUpToItsEnd) {
    CameraPath path{ .keys = { { .seconds = 3 }, { .seconds = 4 } }, .closingSeconds = 0.5 };
    EXPECT_EQ(frameTimes(path, 4), (std::vector<double>{ 0, 0.25, 0.5, 0.75, 1 }));
    EXPECT_EQ(frameTimes(path, 30).size(), 31u);
    path.isClosed = true;
    EXPECT_EQ(frameTimes(path, 4).size(), 6u) << "the last frame is not the first one again";
    EXPECT_EQ(frameTimes(CameraPath{}, 30), std::vector<double>{ 0 });
}

} // namespace
} // namespace filament_core::view
