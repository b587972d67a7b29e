// SPDX-License-Identifier: Apache-2.0
// Suns that the camera sees: their light and that of their halos.
#include "tests/tools/reference/TestScenes.h"
#include "tools/reference/DirectLights.h"

namespace filament_core::reference {
namespace {

constexpr double kFactor = 0.5;

/// The disc of 3 lux in direction -z, times kFactor; what is seen at an angle from its middle.
double seenAt(double degrees, double radius, double haloSize, double haloFalloff, bool showsDisc = true) {
    const DirectLights lights({ .suns = { { .directionWorld = { 0, 0, 2 },
                                            .illuminance = Lux{ 3 },
                                            .angularRadiusDegrees = static_cast<float>(radius),
                                            .showsDisc = showsDisc,
                                            .haloSize = static_cast<float>(haloSize),
                                            .haloFalloff = static_cast<float>(haloFalloff) } } },
                              kFactor);
    const double angle = glm::radians(degrees);
    return lights.discsIn({ std::sin(angle) * 0.6, std::sin(angle) * 0.8, -std::cos(angle) }).y;
}

TEST(SunDiscs, HaveTheLuminanceThatGivesTheirIlluminance) {
    for (const double radius : { 0.01, 0.2665, 2.0, 20.0 }) {
        double lux = 0;
        constexpr int kRings = 4000;
        for (int i = 0; i < kRings; ++i) {
            const double degrees = (i + 0.5) / kRings * radius * 2, angle = glm::radians(degrees);
            lux += seenAt(degrees, radius, 1, 0) * std::cos(angle) * 2 * kPiExact * std::sin(angle) *
                   glm::radians(radius * 2 / kRings);
        }
        EXPECT_NEAR(lux, 3 * kFactor, 3e-3) << radius;
        EXPECT_EQ(seenAt(radius * 0.99, radius, 1, 0), seenAt(0, radius, 1, 0));
        EXPECT_EQ(seenAt(radius * 1.01, radius, 1, 0), 0);
        EXPECT_EQ(seenAt(0, radius, 1, 0, false), 0);
    }
}

TEST(SunDiscs, FadeTowardsTheEdgeOfTheirHalo) {
    const double disc = seenAt(0, 2, 1, 0), inner = std::cos(glm::radians(2.0)), outer = std::cos(glm::radians(10.0));
    for (const double falloff : { 0.0, 1.0, 7.5 }) {
        for (const double degrees : { 2.1, 4.0, 9.9 }) {
            const double rest = (std::cos(glm::radians(degrees)) - outer) / (inner - outer);
            EXPECT_NEAR(seenAt(degrees, 2, 5, falloff), disc * std::pow(rest, falloff), disc * 1e-6);
        }
        EXPECT_EQ(seenAt(10.1, 2, 5, falloff), 0);
        EXPECT_EQ(seenAt(1.9, 2, 5, falloff), disc);
    }
    EXPECT_GT(seenAt(179, 20, 1000, 0), 0) << "the halo is all of the sky";
}

// The sum over the image's pixels, each times its solid angle and cosine.
TEST(SunDiscs, BringTheirIlluminanceToTheCamera) {
    ReferenceScene scene{ .models = { { makeModel(floorPrimitive(), metal(0.0f, float3(1))) } } };
    scene.suns = { { .directionWorld = { 0, 0.2f, 1 },
                     .illuminance = Lux{ 2 },
                     .angularRadiusDegrees = 4,
                     .showsDisc = true,
                     .haloSize = 1 } };
    const uint2 size{ 32, 32 };
    const ReferenceView up = viewFrom({ 0, 5, 0 }, { 0, 4.8, -1 }, size, 16);
    const ReferenceImage image = rendered(scene, up, { .samplesPerPixel = 256 });
    double sum = 0;
    const double half = std::tan(glm::radians(8.0));
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        const double x = ((i % size.x + 0.5) / size.x * 2 - 1) * half, y = ((i / size.x + 0.5) / size.y * 2 - 1) * half;
        const double cosine = 1 / std::sqrt(1 + x * x + y * y), side = 2 * half / size.x;
        sum += double(image.color[i].y) * side * side * std::pow(cosine, 4);
    }
    EXPECT_NEAR(sum, 2, 0.02);
}

} // namespace
} // namespace filament_core::reference
