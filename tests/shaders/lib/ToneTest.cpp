// SPDX-License-Identifier: Apache-2.0
#include "filament_core/values/AcesReference.h"
#include "filament_core/values/ToneShader.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {
namespace {

constexpr std::array<int, 8> kMappers{
    kToneMapAgx,          kToneMapPbrNeutral, kToneMapAcesReference, kToneMapGeneric,
    kToneMapDisplayRange, kToneMapAgxGolden,  kToneMapAgxPunchy,     kToneMapFilmic
};

vec4 defaultCurve() { return shaderToneCurve({}); }

vec3 mapped(vec3 light, int mapper) { return toneMapped(light, toneSettings(mapper, defaultCurve(), kOutputSrgb, 0)); }

TEST(Tone, EveryMapperStaysInRange) {
    for (const int mapper : kMappers) {
        EXPECT_LT(mapped(vec3(0.0f), mapper).y, 1e-6f) << "mapper " << mapper;
        EXPECT_EQ(mapped(vec3(-5.0f), mapper), mapped(vec3(0.0f), mapper)) << mapper;
        for (const float x : { 1e-30f, 1e-4f, 0.18f, 1.0f, 100.0f, 1e6f, 1e30f, 3e38f }) {
            for (const vec3 color : { vec3(x), vec3(x, 0, 0), vec3(0, x, 1), vec3(1, 0, x) }) {
                const vec3 shown = mapped(color, mapper);
                EXPECT_TRUE(isFinite(shown)) << mapper;
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(shown, vec3(0.0f))) &&
                            glm::all(glm::lessThanEqual(shown, vec3(1.0f))))
                        << mapper;
            }
        }
    }
}

ToneMapper mapperOf(int number) {
    if (number == kToneMapAgxGolden || number == kToneMapAgxPunchy) return ToneMapper::Agx;
    return static_cast<ToneMapper>(number);
}

TEST(Tone, HalfWhiteLightIsDisplayedAtHalfOfWhite) {
    for (int mapper = kToneMapLinear; mapper <= kToneMapAgxPunchy; ++mapper) {
        if (mapper == kToneMapDisplayRange || mapper == kToneMapAcesReference) continue;
        const float half = halfWhiteLight({ .toneMapper = mapperOf(mapper),
                                            .agxLook = mapper == kToneMapAgxGolden   ? AgxLook::Golden
                                                       : mapper == kToneMapAgxPunchy ? AgxLook::Punchy
                                                                                     : AgxLook::Base });
        const vec3 shown = mapped(vec3(half), mapper);
        EXPECT_NEAR(luminance(toneMappedIncludesTransfer(mapper) ? linearFromSrgb(shown) : shown), 0.5f, 2e-3f)
                << mapper;
    }
    EXPECT_NEAR(acesReference(double3(halfWhiteLight({ .toneMapper = ToneMapper::AcesReference }))).y, 0.5, 2e-3);
    for (const float contrast : { 0.8f, 1.0f, 2.0f }) {
        const ToneCurve curve{ .contrast = contrast };
        const float half = halfWhiteLight({ .toneMapper = ToneMapper::Generic, .toneCurve = curve });
        EXPECT_NEAR(toneMapGeneric(vec3(half), shaderToneCurve(curve)).x, 0.5f, 1e-4f) << contrast;
    }
}

/// The curve for which the weights are exact: of their weighted mean it shows the mean of what it shows of each.
TEST(Tone, DisplayWeightsMakeTheMeanOfWhatIsDisplayed) {
    const float half = 0.4f;
    const auto curve = [&](float x) { return x / (x + half); };
    for (const float lamp : { 0.01f, 1.0f, 1e2f, 65504.0f }) {
        for (const float alpha : { 0.25f, 1.0f }) {
            for (int covered = 0; covered <= 4; ++covered) {
                float light = 0, weight = 0, shown = 0;
                for (int i = 0; i < 4; ++i) {
                    const float straight = i < covered ? lamp : 0.05f;
                    const float w = displayWeight(straight * alpha, alpha, 1 / half);
                    light += straight * alpha * w, weight += alpha * w, shown += curve(straight) / 4;
                }
                EXPECT_NEAR(curve(light / weight), shown, 1e-5f) << lamp << " " << alpha << " " << covered;
            }
        }
    }
    EXPECT_EQ(displayWeight(0, 0, 1), 0) << "nothing";
    EXPECT_EQ(displayWeight(7, 0, 1), 0) << "light without alpha";
    EXPECT_EQ(displayWeight(-1, 1, 1), 1) << "no light";
}

TEST(Tone, GreysStayGreyAndRise) {
    for (const int mapper : { kToneMapAgx, kToneMapPbrNeutral, kToneMapGeneric, kToneMapAgxPunchy }) {
        float last = -1;
        for (float x = 1e-4f; x < 1e5f; x *= 1.1f) {
            const vec3 shown = mapped(vec3(x), mapper);
            EXPECT_GE(shown.y, last - 1e-6f) << "mapper " << mapper << " at " << x;
            EXPECT_NEAR(shown.x, shown.y, 6e-4f) << mapper;
            EXPECT_NEAR(shown.z, shown.y, 6e-4f) << mapper;
            last = shown.y;
        }
        EXPECT_GT(last, 0.97f) << "white is reached";
    }
}

/// Sobotka's sigmoid of AgX in double precision: slope 2 at (10/16.5, 0.5), powers 3 below and 3.25 above.
double agxSigmoid(double x) {
    const double pivot = 10 / 16.5, middle = 0.5, slope = 2;
    const bool isAbove = x >= pivot;
    const double power = isAbove ? 3.25 : 3, width = isAbove ? 1 - pivot : pivot,
                 height = isAbove ? 1 - middle : middle;
    const double scale =
            std::pow(std::pow(slope * width, -power) * (std::pow(slope * width / height, power) - 1), -1 / power);
    const double term = slope * std::abs(x - pivot) / scale;
    const double curve = scale * term / std::pow(1 + std::pow(term, power), 1 / power);
    return middle + (isAbove ? curve : -curve);
}

TEST(Tone, TheContrastOfAgxIsItsSigmoid) {
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0;
        largest = std::max(largest, std::abs(static_cast<double>(agxContrast(static_cast<float>(x))) - agxSigmoid(x)));
    }
    EXPECT_LT(largest, 0.006);
    EXPECT_GT(largest, 0.005) << "the comment of agxContrast() says 0.006";
}

TEST(Tone, AgxShowsMiddleGreyHalfWayAndKeepsWhiteWhite) {
    EXPECT_NEAR(std::pow(mapped(vec3(0.18f), kToneMapAgx).y, 1 / 2.2f), 0.5f, 0.006f);
    const vec3 red = mapped(vec3(50, 0, 0), kToneMapAgx);
    EXPECT_GT(red.y / red.x, 0.3f) << "bright colours lose chroma";
    const vec3 golden = mapped(vec3(0.5f), kToneMapAgxGolden);
    EXPECT_GT(golden.x, golden.z * 1.3f) << "warmer";
    EXPECT_GT(mapped(vec3(2), kToneMapAgxPunchy).y / mapped(vec3(0.05f), kToneMapAgxPunchy).y,
              1.5f * mapped(vec3(2), kToneMapAgx).y / mapped(vec3(0.05f), kToneMapAgx).y)
            << "more contrast";
}

// Khronos: "1:1" for base colours from 0.08 to 0.8, of which Fresnel's reflection, 0.04, has been taken off.
TEST(Tone, PbrNeutralTakesOffFresnelAndNothingElseBelowItsShoulder) {
    for (const float grey : { 0.08f, 0.2f, 0.5f, 0.79f })
        EXPECT_NEAR(mapped(vec3(grey), kToneMapPbrNeutral).x, grey - 0.04f, 1e-6f) << grey;
    const vec3 color = mapped(vec3(0.7f, 0.3f, 0.1f), kToneMapPbrNeutral);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], vec3(0.7f, 0.3f, 0.1f)[c] - 0.04f, 1e-6f);
    EXPECT_NEAR(mapped(vec3(0.04f), kToneMapPbrNeutral).x, 0.04f - (0.04f - 6.25f * 0.0016f), 1e-7f) << "dark: squared";
    const float white = mapped(vec3(1.04f), kToneMapPbrNeutral).x;
    EXPECT_NEAR(white, 1 - 0.24f * 0.24f / (1.0f + 0.24f - 0.76f), 1e-5f) << "the shoulder of its specification";
    const vec3 bright = mapped(vec3(100, 1, 1), kToneMapPbrNeutral);
    EXPECT_GT(bright.y, 0.8f) << "bright colours lose chroma";
}

TEST(Tone, TheGenericCurveGoesThroughItsPoints) {
    for (ToneCurve const& curve : { ToneCurve{}, ToneCurve{ 1, 0.18f, 0.18f, 4 }, ToneCurve{ 2, 0.1f, 0.3f, 100 } }) {
        const vec4 values = shaderToneCurve(curve);
        EXPECT_NEAR(toneMapGeneric(vec3(curve.midGreyIn), values).x, curve.midGreyOut, 1e-5f);
        EXPECT_NEAR(toneMapGeneric(vec3(curve.maximum), values).x, 1, 1e-5f);
        EXPECT_EQ(toneMapGeneric(vec3(1e4f), values), toneMapGeneric(vec3(curve.maximum), values));
        EXPECT_EQ(toneMapGeneric(vec3(0.0f), values).x, 0.0f);
    }
    const vec4 impossible = shaderToneCurve({ 0.1f, 1, 0.001f, 1 });
    EXPECT_TRUE(isFinite(toneMapGeneric(vec3(0.5f), impossible)));
    EXPECT_NEAR(toneMapGeneric(vec3(1), impossible).x, 1, 1e-5f);
}

TEST(Tone, FalseColoursCountStops) {
    for (int stop = 0; stop < 16; ++stop) {
        const vec3 shown = mapped(vec3(0.18f * std::exp2(static_cast<float>(stop - 7))), kToneMapDisplayRange);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], displayRangeColor(stop)[c], 1e-4f) << stop;
        for (int other = 0; other < stop; ++other)
            EXPECT_GT(glm::distance(displayRangeColor(stop), displayRangeColor(other)), 0.2f) << stop << ' ' << other;
    }
    EXPECT_EQ(mapped(vec3(0.18f), kToneMapDisplayRange), vec3(0.5f)) << "middle grey is grey";
}

// Values that are printed with SMPTE ST 2084 and ITU-R BT.2408.
TEST(Tone, ThePerceptualQuantizerMatchesItsStandard) {
    EXPECT_NEAR(pqFromLinear(0.01f), 0.508078f, 1e-5f) << "100 cd/m^2";
    EXPECT_NEAR(pqFromLinear(0.0203f), 0.5807f, 1e-4f) << "203 cd/m^2";
    EXPECT_NEAR(pqFromLinear(0.1f), 0.751827f, 1e-5f) << "1000 cd/m^2";
    EXPECT_NEAR(pqFromLinear(1.0f), 1, 1e-5f);
    EXPECT_NEAR(pqFromLinear(0.0f), 0, 1e-6f);
}

vec3 encoded(vec3 light, int space, float white = 0.0203f) {
    return encodedForDisplay(light, toneSettings(kToneMapLinear, vec4(0.0f), space, white));
}

TEST(Tone, SpacesShareTheirWhiteAndHoldRec709) {
    for (const int space : { kOutputSrgb, kOutputLinearRec709, kOutputDisplayP3 })
        EXPECT_NEAR(glm::distance(encoded(vec3(1), space), vec3(1)), 0, 1e-5f) << space;
    const vec3 red =
            encoded(vec3(1, 0, 0), kOutputDisplayP3); // that of CSS Color 4: color(display-p3 0.9175 0.2003 0.1386)
    EXPECT_NEAR(red.x, 0.9175f, 1e-4f);
    EXPECT_NEAR(red.y, 0.2003f, 1e-4f);
    EXPECT_NEAR(red.z, 0.1386f, 1e-4f);
    EXPECT_NEAR(encoded(vec3(1), kOutputRec2020Pq).x, 0.5807f, 1e-4f);
    const vec3 bright = encoded(vec3(1000.0f / 203), kOutputRec2020Pq);
    EXPECT_NEAR(bright.y, 0.751827f, 1e-4f) << "brighter than white";
    EXPECT_EQ(encoded(vec3(1e6f), kOutputRec2020Pq), encoded(vec3(1e3f), kOutputRec2020Pq)) << "nothing is brighter";
    EXPECT_LT(encoded(vec3(-0.1f, 1, -0.05f), kOutputDisplayP3).x, encoded(vec3(0, 1, 0), kOutputDisplayP3).x)
            << "greens that Rec. 709 does not hold";
}

TEST(Tone, OnlyLinearLightExceedsTheWhiteOfPq) {
    const auto shown = [](int mapper, float light) {
        return displayColor(vec3(light), toneSettings(mapper, defaultCurve(), kOutputRec2020Pq, 0.0203f)).y;
    };
    EXPECT_NEAR(shown(kToneMapLinear, 1000.0f / 203), 0.751827f, 1e-4f);
    for (const int mapper : { kToneMapAces, kToneMapAgx, kToneMapMobile, kToneMapPbrNeutral })
        EXPECT_LE(shown(mapper, 1e4f), 0.5808f) << mapper;
}

TEST(Tone, AnSrgbDisplayGetsWhatItGotBefore) {
    for (const int mapper : { kToneMapLinear, kToneMapAces, kToneMapFilmic, kToneMapMobile }) {
        for (const vec3 light : { vec3(0.18f), vec3(3, 0.2f, 0.01f), vec3(-1, 90, 2) }) {
            const vec3 color = toneMap(light, mapper);
            EXPECT_EQ(displayColor(light, toneSettings(mapper, vec4(0.0f), kOutputSrgb, 0)),
                      toneMapIncludesTransfer(mapper) ? color : srgbFromLinear(color));
        }
    }
}

TEST(NightVision, ShiftsDarkColoursToBlue) {
    EXPECT_EQ(nightVision(vec3(0.3f, 0.2f, 0.1f), 0), vec3(0.3f, 0.2f, 0.1f));
    EXPECT_EQ(nightVision(vec3(0.0f), 1), vec3(0.0f));
    float last = 1e9f;
    for (const float light : { 1e-4f, 1e-3f, 1e-2f, 0.18f, 1.0f, 10.0f, 1e4f }) {
        const vec3 grey = nightVision(vec3(light), 1) / light;
        EXPECT_GT(grey.z, grey.y) << light;
        EXPECT_GE(grey.y, 1.0f) << light;
        EXPECT_LT(grey.z, last) << "less in brighter light";
        last = grey.z;
    }
    EXPECT_LT(last, 1.01f) << "none in daylight";
    const float red = luminance(nightVision(vec3(0.001f, 0, 0), 1)) / luminance(vec3(0.001f, 0, 0));
    const float blue = luminance(nightVision(vec3(0, 0, 0.001f), 1)) / luminance(vec3(0, 0, 0.001f));
    EXPECT_GT(blue, 4 * red) << "rods do not see red: the Purkinje shift";
}

} // namespace
} // namespace filament_core::shader::lib
