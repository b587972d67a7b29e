// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {
namespace {

constexpr std::array<int, 4> kMappers{ kToneMapLinear, kToneMapAces, kToneMapFilmic, kToneMapMobile };

TEST(Color, EveryToneMapperSendsBlackToBlackAndStaysInRange) {
    for (const int mapper : kMappers) {
        EXPECT_LT(toneMap(vec3(0.0f), mapper).y, 1e-6f) << "mapper " << mapper;
        EXPECT_EQ(toneMap(vec3(-5.0f), mapper), toneMap(vec3(0.0f), mapper));
        for (const float x : { 1e-30f, 1e-4f, 0.18f, 1.0f, 100.0f, 65504.0f, 1e30f, 3e38f }) {
            for (const vec3 color : { vec3(x), vec3(x, 0, 0), vec3(0, x, 1), vec3(1, 0, x) }) {
                const vec3 mapped = toneMap(color, mapper);
                EXPECT_TRUE(isFinite(mapped));
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(mapped, vec3(0.0f))) &&
                            glm::all(glm::lessThanEqual(mapped, vec3(1.0f))));
            }
        }
    }
}

TEST(Color, EveryToneMapperIsMonotoneInGreys) {
    for (const int mapper : kMappers) {
        float last = -1;
        for (float x = 1e-4f; x < 1e5f; x *= 1.1f) {
            const vec3 mapped = toneMap(vec3(x), mapper);
            EXPECT_GE(mapped.y, last) << "mapper " << mapper << " at " << x;
            EXPECT_NEAR(mapped.x, mapped.y, 2e-3f) << "greys stay grey";
            last = mapped.y;
        }
        EXPECT_GT(last, 0.97f) << "white is reached";
    }
}

// The mobile curve includes the transfer function: on the display it must look like the filmic one.
TEST(Color, TheMobileCurveIsTheFilmicOneWithItsTransferFunction) {
    EXPECT_TRUE(toneMapIncludesTransfer(kToneMapMobile));
    EXPECT_FALSE(toneMapIncludesTransfer(kToneMapFilmic));
    double squares = 0;
    int count = 0;
    for (float x = 0.01f; x < 10; x *= 1.2f, ++count) {
        const float difference =
                toneMap(vec3(x), kToneMapMobile).x - srgbFromLinear(toneMap(vec3(x), kToneMapFilmic)).x;
        squares += difference * difference;
    }
    EXPECT_LT(std::sqrt(squares / count), 0.05);
}

TEST(Color, AcesDesaturatesWhatFilmicDoesNot) {
    const vec3 aces = toneMap(vec3(20, 1, 1), kToneMapAces), filmic = toneMap(vec3(20, 1, 1), kToneMapFilmic);
    EXPECT_GT(aces.y / aces.x, 0.5f);
    EXPECT_NEAR(filmic.y, toneMapFilmic(vec3(1.0f)).y, 1e-6f) << "components do not know each other";
}

TEST(Color, TheTransferFunctionMatchesItsStandard) {
    EXPECT_NEAR(srgbFromLinear(0.18f), 0.46135613f, 1e-5f);
    EXPECT_NEAR(srgbFromLinear(0.0031308f), 0.04045f, 1e-5f);
    EXPECT_EQ(srgbFromLinear(0.0f), 0.0f);
    EXPECT_NEAR(srgbFromLinear(1.0f), 1.0f, 1e-6f);
}

TEST(Color, EveryByteSurvivesTheRoundTripThroughLinear) {
    for (int i = 0; i < 256; ++i) {
        const vec3 linear = linearFromSrgb(vec3(static_cast<float>(i) / 255));
        EXPECT_EQ(std::lround(srgbFromLinear(linear).x * 255), i);
    }
}

TEST(Color, LuminanceOfWhiteIsOneAndGreenOutweighsRedOutweighsBlue) {
    EXPECT_NEAR(luminance(vec3(1.0f)), 1.0f, 1e-6f);
    EXPECT_GT(luminance(vec3(0, 1, 0)), luminance(vec3(1, 0, 0)));
    EXPECT_GT(luminance(vec3(1, 0, 0)), luminance(vec3(0, 0, 1)));
}

} // namespace
} // namespace filament_core::shader::lib
