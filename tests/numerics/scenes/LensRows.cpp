// SPDX-License-Identifier: Apache-2.0
// Lenses that touch the scene, scenes that extend to the horizon, images of one pixel and of one line.
#include "tests/numerics/scenes/HardCase.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace filament_core::hard {
namespace {

void balls(Stage& stage, float nearMeters) {
    for (int i = 0; i < 5; ++i)
        stage.add(sphereMesh(), translation({ i - 2.0, 0.4 * i - 0.8, -1.5 * i }),
                  { .metallic = 0.25f * static_cast<float>(i) });
    stage.scene.add(SunLight{ .directionWorld = { -0.4f, -0.7f, -1 } });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.camera = Camera::lookAt({ 0, 0, 5 }, { 0, 0, 0 }, { .nearMeters = nearMeters });
}

HardCase nearPlane(float meters) {
    return { .name = fmt::format("A near plane at {:g} m changes nothing in a scene beyond it", meters),
             .scene = [=](Stage& stage) { balls(stage, meters); },
             .twin = [](Stage& stage) { balls(stage, 0.1f); },
             .tolerance = 0 };
}

HardCase wallBeforeTheLens(std::string name, double distance, uint32_t expectedPixels) {
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         stage.view.camera = Camera::lookAt({ 0, 0, distance }, { 0, 0, 0 }, { .nearMeters = 0.001f });
                         stage.add(quadMesh());
                         stage.addConstantSky(Lux{ 8'000 });
                     },
             .holds = [=](Picture const& picture) { EXPECT_EQ(picture.coveredCount(), expectedPixels); } };
}

// Reversed depth is floating point: its steps are a part in 2^24 of the distance, at any distance. The front wall is
// drawn first or last, depending on which wall was created first.
HardCase nearlyTouchingWalls(double distance, bool redFirst) {
    return { .name = fmt::format("Of two walls {:.0e} m away the nearer by a part in 1e5 wins, {} first", distance,
                                 redFirst ? "red" : "blue"),
             .scene =
                     [=](Stage& stage) {
                         stage.view.camera = Camera::lookAt({ 0, 0, 0 }, { 0.1, 0.2, -1 }, { .nearMeters = 0.001f });
                         const auto wall = [&](Look const& look, double z) {
                             stage.add(quadMesh(), translation({ 0, 0, -z }) * scaling(double3(3 * distance)), look);
                         };
                         if (redFirst) wall(kRed, distance);
                         wall(kBlue, distance * (1 + 1e-5));
                         if (!redFirst) wall(kRed, distance);
                         stage.addConstantSky(Lux{ 8'000 });
                     },
             .holds =
                     [](Picture const& picture) {
                         uint32_t red = 0;
                         forEachCovered(picture, [&](uint32_t, uint32_t, float4 color) { red += color.x > color.z; });
                         EXPECT_EQ(red, 64u * 64u);
                     } };
}

// A white metal in a constant sky is as bright as the sky; so is every pixel of any target.
HardCase target(uint2 size, uint8_t samples) {
    const Exposure exposure{};
    const float radiance = 30'000 * exposure.factor();
    const double aspect = static_cast<double>(size.x) / size.y;
    return {
        .name = fmt::format("Every pixel of a target of {} x {} with {} samples is white", size.x, size.y, samples),
        .scene =
                [=](Stage& stage) {
                    stage.view.size = size;
                    stage.view.samples = samples;
                    stage.view.camera =
                            Camera::lookAt({ 0, 0, 0.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }, exposure);
                    stage.add(quadMesh(), scaling({ 0.5 * aspect, 0.5, 1 }), { .baseColor = float4(1), .metallic = 1 });
                    stage.addConstantSky(Lux{ 30'000 });
                },
        .holds =
                [=](Picture const& picture) {
                    EXPECT_EQ(picture.coveredCount(), size.x * size.y);
                    forEachCovered(picture, [&](uint32_t x, uint32_t y, float4 color) {
                        for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], radiance, 0.01f * radiance) << x << ", " << y;
                    });
                }
    };
}

} // namespace

std::vector<HardCase> lensRows() {
    std::vector<HardCase> rows;
    for (float meters : { 1e-2f, 1e-3f, 1e-6f, 1e-9f }) rows.push_back(nearPlane(meters));
    rows.push_back(wallBeforeTheLens("A wall just behind the near plane of 1 mm fills the picture", 0.0011, 64 * 64));
    rows.push_back(wallBeforeTheLens("A wall just before the near plane of 1 mm is not there", 0.0009, 0));
    for (double distance : { 1.0, 1e3, 1e6 }) {
        for (bool redFirst : { true, false }) rows.push_back(nearlyTouchingWalls(distance, redFirst));
    }
    for (uint2 size : { uint2(1, 1), uint2(3, 1), uint2(1, 7), uint2(8192, 1), uint2(1, 8192) }) {
        for (uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) rows.push_back(target(size, samples));
    }
    return rows;
}

} // namespace filament_core::hard
