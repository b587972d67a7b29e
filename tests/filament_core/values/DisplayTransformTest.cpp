// SPDX-License-Identifier: Apache-2.0
#include "filament_core/values/AcesReference.h"

#include <filament_core/DisplayTransform.h>
#include <filament_core/Look.h>
#include <filament_core/Options.h>

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core {
namespace {

TEST(DisplayTransform, EveryNameLeadsBackToItsValue) {
    for (int i = 0; i <= static_cast<int>(ToneMapper::DisplayRange); ++i) {
        const auto mapper = static_cast<ToneMapper>(i);
        EXPECT_EQ(enumFromName<ToneMapper>(toString(mapper)), mapper);
        EXPECT_NE(std::string_view(listed(enumNames<ToneMapper>())).find(toString(mapper)), std::string_view::npos);
    }
    for (const AgxLook look : { AgxLook::Base, AgxLook::Golden, AgxLook::Punchy })
        EXPECT_EQ(enumFromName<AgxLook>(toString(look)), look);
    for (int i = 0; i <= static_cast<int>(OutputSpace::Rec2020Pq); ++i)
        EXPECT_EQ(enumFromName<OutputSpace>(toString(static_cast<OutputSpace>(i))), static_cast<OutputSpace>(i));
    EXPECT_FALSE(enumFromName<ToneMapper>("neutral"));
}

TEST(DisplayTransform, ClampedValuesAreWithinTheirRanges) {
    const DisplayTransform wild{ .toneCurve = { .contrast = -3, .midGreyIn = std::nanf(""), .maximum = 1e9f },
                                 .whiteNits = 0 };
    const DisplayTransform tame = clamped(wild);
    EXPECT_EQ(tame.toneCurve.contrast, 0.1f);
    EXPECT_EQ(tame.toneCurve.midGreyIn, 0.18f);
    EXPECT_EQ(tame.toneCurve.maximum, 256.0f);
    EXPECT_EQ(tame.whiteNits, 80.0f);
    EXPECT_EQ(clamped(DisplayTransform{}), DisplayTransform{});
}

/// The transforms' own numbers: 18 % grey is 4.8 cd/m^2 of a cinema, 6.5 stops above it 48, which is white, and 6.5
/// below it 0.02, which is black. A dim surround then raises luminance by an exponent of 0.9811.
TEST(AcesReference, ShowsGreysAsItsCurvesSay) {
    const auto grey = [](double light) { return acesReference(double3(light)); };
    const double middle = std::pow((4.8 - 0.02) / (48 - 0.02), 0.9811);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(grey(0.18)[c], middle, 1e-6);
        EXPECT_NEAR(grey(0.18 * std::exp2(6.5))[c], 1, 1e-6);
        EXPECT_NEAR(grey(0.18 * std::exp2(-6.5))[c], 0, 1e-6);
        EXPECT_NEAR(grey(0)[c], 0, 1e-12);
        EXPECT_EQ(grey(60'000)[c], 1);
        EXPECT_NEAR(grey(-1)[c], 0, 1e-12);
    }
    double last = -1;
    for (double light = 1e-4; light < 100; light *= 1.05) {
        const double3 shown = grey(light);
        EXPECT_GE(shown.y, last) << light;
        EXPECT_NEAR(shown.x, shown.z, 1e-9) << "greys stay grey";
        last = shown.y;
    }
}

TEST(AcesReference, BrightColoursLoseTheirChroma) {
    for (const double3 color : { double3(1, 0.1, 0.1), double3(0.1, 1, 0.1), double3(0.1, 0.1, 1) }) {
        double last = 0;
        for (double light = 0.1; light < 200; light *= 2) {
            const double3 shown = acesReference(color * light);
            const double paleness = std::min({ shown.x, shown.y, shown.z }) / std::max({ shown.x, shown.y, shown.z });
            EXPECT_GE(paleness, last - 0.03) << light;
            last = paleness;
        }
        EXPECT_GT(last, 0.8);
    }
}

Look curveLook() {
    return { .isCube = false,
             .size = 3,
             .domainMin = float3(0, -1, 0),
             .domainMax = float3(1, 1, 2),
             .entries = { float3(0, 5, 1), float3(0.25f, 6, 0.5f), float3(1, 8, 0) } };
}

TEST(Look, ACurveIsInterpolatedBetweenItsEntriesAndEndsWithThem) {
    const Look look = curveLook();
    EXPECT_EQ(lookedUp(look, float3(0.25f, 0, 1)), float3(0.125f, 6, 0.5f));
    EXPECT_EQ(lookedUp(look, float3(0.75f, 0.5f, 1.5f)), float3(0.625f, 7, 0.25f));
    EXPECT_EQ(lookedUp(look, float3(-1e30f, 1e30f, 9)), float3(0, 8, 0));
    EXPECT_EQ(lookedUp(look, float3(std::nanf(""))), float3(0, 5, 1));
}

TEST(Look, ACubeOfALinearFunctionIsThatFunction) {
    Look look{ .size = 4, .domainMin = float3(-0.5f), .domainMax = float3(1.5f), .entries = {} };
    const auto of = [](float3 v) { return float3(v.x * 0.5f + v.z, v.y - v.x, 1 - v.z * 0.25f + v.y); };
    for (int b = 0; b < 4; ++b)
        for (int g = 0; g < 4; ++g)
            for (int r = 0; r < 4; ++r) look.entries.push_back(of(float3(r, g, b) * (2.0f / 3) - 0.5f));
    for (float3 const& color :
         { float3(0.1f, 0.7f, 0.3f), float3(0.9f, 0.2f, 1.4f), float3(0.5f), float3(1.5f, -0.5f, 1) })
        EXPECT_LT(glm::distance(lookedUp(look, color), of(color)), 1e-6f);
    EXPECT_LT(glm::distance(lookedUp(look, float3(9)), of(float3(1.5f))), 1e-6f);
}

} // namespace
} // namespace filament_core
