// SPDX-License-Identifier: Apache-2.0
// Names of effect options: each can be read back as written, and what lies outside of a range is refused, or clamped.
#include <filament/Effects.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament {
namespace {

TEST(Effects, OptionsAreReadBackAsTheyWereSet) {
    for (EffectOption const& option : effectOptions()) {
        Effects effects;
        const std::string value = *effectValue(effects, option.name);
        ASSERT_TRUE(setEffect(effects, option.name, value)) << option.name << '=' << value;
        EXPECT_EQ(effects, Effects{}) << option.name;
    }
}

TEST(Effects, AScaleIsOneNumberForBothAxesOrOneForEach) {
    Effects effects;
    ASSERT_TRUE(setEffect(effects, "resolution.scale", "0.67"));
    EXPECT_EQ(effects.resolution.scale, float2(0.67f));
    EXPECT_EQ(effectValue(effects, "resolution.scale"), "0.67,0.67");
    ASSERT_TRUE(setEffect(effects, "resolution.scale", "0.5,1"));
    EXPECT_EQ(effects.resolution.scale, float2(0.5f, 1));
    for (const char* wrong : { "", "0.4", "1.1", "nan", "half", "0.5,", "0.5,0.5,0.5", ",1", "0.5,2", "0.5 1" }) {
        const Result<void> done = setEffect(effects, "resolution.scale", wrong);
        ASSERT_FALSE(done) << wrong;
        EXPECT_EQ(done.error().message, "effect option resolution.scale: '" + std::string(wrong) +
                                                "' is not a number from 0.5 to 1, or two: X,Y");
        EXPECT_EQ(effects.resolution.scale, float2(0.5f, 1)) << "unchanged";
    }
}

TEST(Effects, WhatLiesOutsideOfItsRangeIsClamped) {
    Effects effects;
    effects.resolution.scale = { 0, std::numeric_limits<float>::infinity() };
    effects.resolution.leastScale = NAN;
    effects.resolution.history = 1e30f;
    effects.sharpening.strength = -1;
    const Effects inRange = clamped(effects);
    EXPECT_EQ(inRange.resolution.scale, float2(0.5f, 1));
    EXPECT_EQ(inRange.resolution.leastScale, 0.5f);
    EXPECT_EQ(inRange.resolution.history, 32);
    EXPECT_EQ(inRange.sharpening.strength, 0);
}

} // namespace
} // namespace filament
