// SPDX-License-Identifier: Apache-2.0
// iridescence.glsl compared with the physics that it approximates: every wavelength separately, all orders included.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

/// Airy's sum of all orders for one wavelength, with the amplitudes of Schlick's reflectances as in the paper.
double airy(double outer, double inner, double phase) {
    const double r = std::sqrt(outer * inner);
    const double through = sq(1 - outer) * inner / (1 - r * r);
    double sum = outer + through;
    double power = 1;
    for (int order = 1; order < 60; ++order) {
        power *= r;
        sum += 2 * (through - (1 - outer)) * power * std::cos(order * phase);
    }
    return sum;
}

/// The integral of airy() over a band of wavelengths around the peak of y, which stands for the eye's green.
double averageOverGreen(double outer, double inner, double difference, double shift) {
    double sum = 0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
        const double wavelength = 530 + 50 * (i + 0.5) / kSteps;
        sum += airy(outer, inner, 2 * kPiOfTests * difference / wavelength + shift);
    }
    return sum / kSteps;
}

TEST(Iridescence, AFilmOfThicknessZeroIsNotThere) {
    const vec3 f0(0.04, 0.5, 0.9);
    for (const double cosine : { 0.0, 0.2, 0.7, 1.0 }) {
        const vec3 expected = fresnelSchlick(f0, 1.0, cosine), bare = fresnelIridescent(1.0, 1.8, f0, 0.0, cosine);
        EXPECT_LT(glm::distance(bare, expected), 1e-9) << cosine;
        EXPECT_LT(glm::distance(fresnelIridescent(1.0, 1.8, f0, 1e-6, cosine), expected), 1e-2) << "nor almost 0";
    }
}

TEST(Iridescence, AFilmOfTheBasesOwnIndexHasNoColourAtNormalIncidence) {
    const vec3 f0(f0FromIor(1.5));
    for (const double thickness : { 50.0, 300.0, 700.0 }) {
        EXPECT_LT(glm::distance(fresnelIridescent(1.0, 1.5, f0, thickness, 1.0), f0), 1e-4) << thickness;
    }
}

// Interference of green light in a film on glass: bright and dark at the thicknesses given by Airy's sum.
TEST(Iridescence, GreenIsBrightAndDarkWhereAirysSumIs) {
    const double ior = 1.38, base = 1.8; // the phase of light inside is inverted at the base, not at the air
    const double outer = f0FromIor(ior), inner = sq((base - ior) / (base + ior));
    double bright = 0, dark = 1, expectedBright = 0, expectedDark = 1;
    double brightAt = 0, darkAt = 0, expectedBrightAt = 0, expectedDarkAt = 0;
    for (double thickness = 60; thickness < 240; thickness += 2) {
        const double green = fresnelIridescent(1.0, ior, vec3(f0FromIor(base)), thickness, 1.0).y;
        const double exact = averageOverGreen(outer, inner, 2 * ior * thickness, kPiOfTests);
        if (green > bright) bright = green, brightAt = thickness;
        if (green < dark) dark = green, darkAt = thickness;
        if (exact > expectedBright) expectedBright = exact, expectedBrightAt = thickness;
        if (exact < expectedDark) expectedDark = exact, expectedDarkAt = thickness;
    }
    EXPECT_NEAR(brightAt, expectedBrightAt, 16);
    EXPECT_NEAR(darkAt, expectedDarkAt, 16);
    EXPECT_NEAR(dark, expectedDark, 0.01);
    EXPECT_NEAR(bright, expectedBright, 0.02);
}

TEST(Iridescence, ThickFilmsReflectTheSumOfBothInterfacesWithoutColour) {
    const double ior = 1.33, outer = f0FromIor(ior), base = 1.6, inner = sq((base - ior) / (base + ior));
    const double sum = outer + sq(1 - outer) * inner / (1 - outer * inner);
    const vec3 thick = fresnelIridescent(1.0, ior, vec3(f0FromIor(base)), 20000.0, 1.0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(thick[i], sum, 1e-6);
}

TEST(Iridescence, StaysAReflectanceForEveryFilm) {
    for (const double ior : { 1.0, 1.3, 2.0, 3.0 }) {
        for (const double f0 : { 0.0, 0.04, 0.5, 1.0 }) {
            for (double thickness = 0; thickness < 1200; thickness += 37) {
                for (const double cosine : { 0.0, 1e-6, 0.3, 1.0 }) {
                    const vec3 f = fresnelIridescent(1.0, ior, vec3(f0), thickness, cosine);
                    EXPECT_TRUE(f.x >= 0 && f.y >= 0 && f.z >= 0 && f.x <= 1 && f.y <= 1 && f.z <= 1);
                }
            }
        }
    }
    EXPECT_EQ(fresnelIridescent(1.5, 1.0, vec3(0.5), 300.0, 0.1), vec3(1.0)) << "total internal reflection";
}

TEST(Iridescence, F0OfAReflectanceIsTheOneThatSchlickMakesItOf) {
    for (const double cosine : { 0.2, 0.6, 1.0 }) {
        const vec3 f0(0.04, 0.3, 1.0);
        EXPECT_LT(glm::distance(f0FromFresnel(fresnelSchlick(f0, 1.0, cosine), cosine), f0), 1e-9);
    }
    EXPECT_EQ(f0FromFresnel(vec3(1.0), 0.0), vec3(1.0));
}

} // namespace
} // namespace filament_core::shader::lib64
