// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/NumericsCheck.h"

#include "base/math/Half.h"
#include "toolkit/pictures/Pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::view {
namespace {

using ::testing::HasSubstr;

/// By the bits of the half: a second way to the same answer.
NumericKind expectedKind(uint16_t bits) {
    const uint32_t exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const bool isNegative = bits >> 15 != 0;
    if (exponent == 31) return mantissa ? NumericKind::NotANumber : NumericKind::Infinite;
    if ((bits & 0x7FFF) == 0x7BFF) return NumericKind::OutOfHalf;
    if (exponent == 0) return mantissa ? NumericKind::Denormal : NumericKind::Good;
    if (isNegative) return NumericKind::Negative;
    return (bits & 0x7FFF) > 0x3C00 ? NumericKind::Clipped : NumericKind::Good;
}

/// One pixel for each half, in component `c`.
Image allHalves(size_t c) {
    Image image{ .width = 256, .height = 256, .format = Format::RGBA16F, .pixels = std::vector<std::byte>(8 * 65536) };
    for (uint32_t bits = 0; bits < 65536; ++bits) {
        const auto half = static_cast<uint16_t>(bits);
        std::memcpy(&image.pixels[8 * bits + 2 * c], &half, 2);
    }
    return image;
}

TEST(NumericsCheck, KnowsTheKindOfEveryHalfInEveryColour) {
    for (size_t c = 0; c < 3; ++c) {
        const auto check = checkNumerics(allHalves(c));
        ASSERT_TRUE(check.ok()) << check.error().message;
        std::array<uint64_t, kNumericKinds> counts{};
        for (uint32_t bits = 0; bits < 65536; ++bits) {
            const NumericKind expected = expectedKind(static_cast<uint16_t>(bits));
            ASSERT_EQ(check->pixels[bits], expected) << bits;
            ++counts[static_cast<size_t>(expected)];
        }
        EXPECT_EQ(check->counts, counts);
        EXPECT_EQ(check->first[static_cast<size_t>(NumericKind::Infinite)], uint2(0, 0x7C));
        EXPECT_EQ(check->first[static_cast<size_t>(NumericKind::Denormal)], uint2(1, 0));
    }
}

TEST(NumericsCheck, AlphaDoesNotMatter) {
    const auto check = checkNumerics(allHalves(3));
    ASSERT_TRUE(check.ok());
    EXPECT_EQ(check->counts[0], 65536u);
}

TEST(NumericsCheck, ThePixelHasTheWorstKindOfItsColours) {
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(kindOf({ 0.5f, 2, 0 }), NumericKind::Clipped);
    EXPECT_EQ(kindOf({ -1, 2, 0 }), NumericKind::Negative);
    EXPECT_EQ(kindOf({ 1e-6f, 2, 0 }), NumericKind::Denormal);
    EXPECT_EQ(kindOf({ 70000, -1, 0 }), NumericKind::OutOfHalf);
    EXPECT_EQ(kindOf({ -70000, 0, 0 }), NumericKind::OutOfHalf);
    EXPECT_EQ(kindOf({ -inf, 70000, 0 }), NumericKind::Infinite);
    EXPECT_EQ(kindOf({ inf, 0, nan }), NumericKind::NotANumber);
    EXPECT_EQ(kindOf({ 0, 1, -0.0f }), NumericKind::Good);
    EXPECT_EQ(kindOf({ 3, 3, 3 }, 4), NumericKind::Good);
}

TEST(NumericsCheck, ExaminesFloatsBeforeTheyAreRounded) {
    const std::vector<float3> light{ { 1, 1, 1 }, { 1e6f, 0, 0 }, { 0, 1e-7f, 0 }, { 0, 0, 0 } };
    const auto check = checkNumerics(light, 2, 2);
    ASSERT_TRUE(check.ok());
    EXPECT_EQ(check->pixels,
              (std::vector{ NumericKind::Good, NumericKind::OutOfHalf, NumericKind::Denormal, NumericKind::Good }));
    EXPECT_EQ(check->first[static_cast<size_t>(NumericKind::OutOfHalf)], uint2(1, 0));
    EXPECT_FALSE(check->first[static_cast<size_t>(NumericKind::NotANumber)]);
}

TEST(NumericsCheck, MarksEachKindInItsOwnColourAndLeavesTheRestGrey) {
    const Image picture = allHalves(0);
    const auto check = checkNumerics(picture);
    ASSERT_TRUE(check.ok());
    const Image marked = check->marked(picture);
    for (size_t i = 0; i < check->pixels.size(); ++i) {
        const std::array<uint8_t, 3> rgb{ std::to_integer<uint8_t>(marked.pixels[4 * i]),
                                          std::to_integer<uint8_t>(marked.pixels[4 * i + 1]),
                                          std::to_integer<uint8_t>(marked.pixels[4 * i + 2]) };
        if (check->pixels[i] == NumericKind::Good)
            ASSERT_TRUE(rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] <= 160) << i;
        else
            ASSERT_EQ(rgb, markOf(check->pixels[i])) << i;
    }
    for (size_t a = 1; a < kNumericKinds; ++a) {
        for (size_t b = 1; b < a; ++b)
            EXPECT_NE(markOf(static_cast<NumericKind>(a)), markOf(static_cast<NumericKind>(b)));
    }
}

TEST(NumericsCheck, RefusesWhatIsNotLight) {
    const Image codes{ .width = 1, .height = 1, .pixels = std::vector<std::byte>(4) };
    EXPECT_THAT(checkNumerics(codes).error().message, HasSubstr("RGBA16F"));
    EXPECT_THAT(checkNumerics(Image{ .width = 1, .height = 1, .format = Format::RGBA16F }).error().message,
                HasSubstr("0 bytes"));
    EXPECT_THAT(checkNumerics(std::vector<float3>(3), 2, 2).error().message, HasSubstr("3 pixels"));
    EXPECT_THAT(checkNumerics(allHalves(0), 0).error().message, HasSubstr("white"));
    EXPECT_THAT(checkNumerics(allHalves(0), std::nanf("")).error().message, HasSubstr("white"));
}

} // namespace
} // namespace filament_core::view
