// SPDX-License-Identifier: Apache-2.0
// Thirteen decades of light in half floats: noon, moonlight, the sun in a mirror, a look into lamps.
#include "tests/numerics/scenes/Exact.h"
#include "tests/numerics/scenes/HardCase.h"

#include <gtest/gtest.h>

namespace filament_core::hard {
namespace {

constexpr Exposure kNoon{ 16, 1.0f / 100, 100 };   // EV 14.6
constexpr Exposure kNight{ 1.4f, 1.0f / 2, 3200 }; // EV -3

struct Wall {
    Look look{};
    SunLight sun{};
    Exposure exposure = kNoon;
    double3 eye{ 0, 0, 3 };
    double relative = 0.01; ///< half floats, the DFG table's interpolation, fp32 shading
};

View wallView(Wall const& wall) {
    View view{ .camera = Camera::lookAt(wall.eye, { 0, 0, 0 }, { .verticalFovDegrees = 30 }, wall.exposure) };
    view.size = { 64, 64 };
    view.clearColor = float4(0);
    return view;
}

HardCase wallRow(std::string name, Wall const& wall) {
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         stage.view = wallView(wall);
                         stage.add(quadMesh(), double4x4(1.0), wall.look);
                         stage.scene.add(wall.sun);
                     },
             .holds =
                     [=](Picture const& picture) {
                         expectSunOnWall(picture, wallView(wall), wall.look, wall.sun, wall.relative);
                     } };
}

// D of a mirror depends on 1 - noh^2 of normals and half vectors in fp32: 3 % according to brdf.glsl, plus the share of
// its neighbours.
constexpr double kMirrorError = 0.04;

std::vector<HardCase> sunRows() {
    const Look matt{ .roughness = 1 }, mirror{ .baseColor = float4(1), .metallic = 1, .roughness = 0 };
    const Look glaze{ .roughness = 0 };
    const SunLight noon{ .directionWorld = { 0.2f, -0.3f, -1 } };
    const SunLight moon{ .directionWorld = { 0.2f, -0.3f, -1 }, .illuminance = Lux{ 0.1f } };
    const SunLight behindTheCamera{ .directionWorld = { 0, 0, -1 } };
    const SunLight grazing{ .directionWorld = { 0.995f, 0, -0.0998f } };
    const double3 opposite = double3(0.995, 0, 0.0998) * 6.0;
    return {
        wallRow("A matt wall at noon is Lambert's and GGX's", { .look = matt, .sun = noon }),
        wallRow("A matt wall in moonlight is Lambert's and GGX's", { .look = matt, .sun = moon, .exposure = kNight }),
        wallRow("Moonlight on a film exposed for noon leaves the smallest numbers", { .look = matt, .sun = moon }),
        wallRow("Noon on a film exposed for moonlight is as bright as it gets",
                { .look = matt, .sun = noon, .exposure = kNight }),
        wallRow("A mirror facing the noon sun shows a finite sun",
                { .look = mirror, .sun = behindTheCamera, .relative = kMirrorError }),
        wallRow("Glaze facing the noon sun shows a finite sun",
                { .look = glaze, .sun = behindTheCamera, .relative = kMirrorError }),
        wallRow("A mirror under a grazing sun shows a finite sun",
                { .look = mirror, .sun = grazing, .eye = opposite, .relative = kMirrorError }),
        wallRow("A mirror under the noon sun by night shows a finite sun",
                { .look = mirror, .sun = behindTheCamera, .exposure = kNight, .relative = kMirrorError }),
    };
}

void expectEverywhere(Picture const& picture, float expected, float relative) {
    uint32_t wrong = 0;
    const uint2 size = picture.size();
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        const float4 color = picture.at(i % size.x, i / size.x);
        for (int c = 0; c < 3; ++c) wrong += std::abs(color[c] - expected) > relative * expected;
    }
    EXPECT_EQ(wrong, 0u) << "components are not " << expected << "; the first pixel is " << picture.at(0, 0).x;
}

// The sun's disc as the whole sky: the largest half float times 24 426 lux is 1.6e9 nits, from everywhere.
HardCase insideTheSun(std::string name, Look const& look, Exposure exposure) {
    const float radiance = std::min(65504.0f * 24426 * exposure.factor(), kLargestStored);
    return { .name = std::move(name),
             .scene =
                     [=](Stage& stage) {
                         stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, {}, exposure);
                         stage.add(sphereMesh(), double4x4(1.0), look);
                         stage.addConstantSky(Lux{ 24426 }, 65504, true);
                     },
             .holds = [=](Picture const& picture) { expectEverywhere(picture, radiance, 0.02f); } };
}

std::vector<HardCase> skyRows() {
    const Look white{ .baseColor = float4(1), .metallic = 1, .roughness = 0 };
    Look rough = white;
    rough.roughness = 1;
    return {
        insideTheSun("A mirror in a sky of suns is invisible", white, { 22, 1.0f / 1000, 50 }),
        insideTheSun("A rough metal in a sky of suns is invisible", rough, { 22, 1.0f / 1000, 50 }),
        insideTheSun("A mirror in a sky of suns by night is invisible", white, kNight),
    };
}

// Emission of glTF materials is relative to a white of 1; values beyond half floats are clamped.
HardCase lamp(std::string name, float nits, uint8_t samples) {
    return {
        .name = std::move(name),
        .scene =
                [=](Stage& stage) {
                    stage.view.samples = samples;
                    stage.view.camera = Camera::lookAt({ 0, 0, 1.5 }, { 0, 0, 0 });
                    stage.add(quadMesh(), double4x4(1.0), { .baseColor = { 0, 0, 0, 1 }, .emissive = float3(nits) });
                },
        .holds =
                [=](Picture const& picture) {
                    EXPECT_GT(picture.coveredCount(), 0u);
                    expectEverywhere(picture, std::min(nits, kLargestStored), 0.001f);
                }
    };
}

// Source over: no number of layers exceeds the limit of a single one.
HardCase lampsBehindGlass() {
    return { .name = "Sixteen blended lamps in front of each other stay finite",
             .scene =
                     [](Stage& stage) {
                         stage.view.camera = Camera::lookAt({ 0, 0, 1.5 }, { 0, 0, 0 });
                         stage.add(quadMesh(), translation({ 0, 0, -1 }), { .emissive = float3(1e6f) });
                         for (int i = 0; i < 16; ++i) {
                             const float alpha = i % 2 == 0 ? 0.5f : 0.0f; // 0: clear, adds light only
                             stage.add(quadMesh(), translation({ 0, 0, -0.05 * i }),
                                       { .baseColor = { 1, 1, 1, alpha }, .emissive = float3(1e6f), .blended = true });
                         }
                     },
             .holds =
                     [](Picture const& picture) {
                         EXPECT_EQ(bytesAt(picture.display, 32, 32), 0xFFFFFFFFu) << "white, not black";
                     } };
}

} // namespace

std::vector<HardCase> lightRows() {
    std::vector<HardCase> rows = sunRows();
    for (HardCase& row : skyRows()) rows.push_back(std::move(row));
    rows.push_back(lamp("A lamp of 1e6 fills the picture with light", 1e6f, 1));
    rows.push_back(lamp("A lamp of 1e6 fills the picture with light under four samples", 1e6f, 4));
    rows.push_back(lamp("A lamp of 1e30 fills the picture with light", 1e30f, 1));
    rows.push_back(lamp("A lamp of 1000 has all its light", 1000, 1));
    rows.push_back(lampsBehindGlass());
    return rows;
}

} // namespace filament_core::hard
