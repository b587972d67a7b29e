// SPDX-License-Identifier: Apache-2.0
#include "base/math/Half.h"
#include "filament_core/assets/environment/AnalyticSky.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <cmath>

namespace filament_core::assets {
namespace {

class HdrSkyTest : public ::testing::Test {
protected:
    jobs::JobSystem mJobs{ { .workers = 1 } };
    HdrImage make(AnalyticSkyOptions const& options) { return makeAnalyticSky(options, mJobs).value(); }
};

double pixelSolidAngle(HdrImage const& image, uint32_t y) {
    return 2 * std::numbers::pi / image.width *
           (std::cos(std::numbers::pi * y / image.height) - std::cos(std::numbers::pi * (y + 1) / image.height));
}

double luminance(float3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

TEST_F(HdrSkyTest, EveryPixelIsFiniteLightForLowAndHighSunsAndAnyHaze) {
    for (const float turbidity : { 1.7f, 3.0f, 10.0f }) {
        for (const float height : { 0.0f, 0.02f, 0.5f, 100.0f }) {
            const HdrImage sky = make({ .height = 32, .sunDirection = { 0.3f, height, 0.8f }, .turbidity = turbidity });
            for (float3 const& pixel : sky.pixels) {
                ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z) && pixel.x >= 0 && pixel.y >= 0 && pixel.z >= 0)
                        << turbidity << " " << height;
            }
        }
    }
}

TEST_F(HdrSkyTest, TheSunIsWhereItWasPutAndBrighterThanHalfFloats) {
    const float3 sun = glm::normalize(float3(0.45f, 0.55f, 0.70f));
    const HdrImage sky = make({ .height = 256, .sunDirection = sun });
    size_t brightest = 0;
    for (size_t i = 0; i < sky.pixels.size(); ++i) {
        if (sky.pixels[i].y > sky.pixels[brightest].y) brightest = i;
    }
    EXPECT_GT(sky.pixels[brightest].y, kMaxHalf);
    const float3 found = directionFromEquirect({ (float(brightest % sky.width) + 0.5f) / float(sky.width),
                                                 (float(brightest / sky.width) + 0.5f) / float(sky.height) });
    EXPECT_GT(glm::dot(found, sun), std::cos(2 * kPi / float(sky.width) * 1.5f));
}

// The disc adds exactly the illuminance of the corresponding directional light, at any resolution.
TEST_F(HdrSkyTest, TheDiscCarriesTheSunsIlluminanceEvenWhenSmallerThanAPixel) {
    for (const uint32_t height : { 16u, 128u, 512u }) {
        for (const float3 direction : { float3(0.45f, 0.55f, 0.70f), float3(0.001f, 1, 0), float3(0, 0.2f, -1) }) {
            AnalyticSkyOptions options{ .height = height, .sunDirection = direction };
            const HdrImage with = make(options);
            options.sunDisc = false;
            HdrImage without = make(options);
            double illuminance = 0;
            for (uint32_t y = 0; y < with.height / 2; ++y) {
                for (uint32_t x = 0; x < with.width; ++x) {
                    illuminance += pixelSolidAngle(with, y) * (luminance(with.at(x, y)) - luminance(without.at(x, y)));
                }
            }
            EXPECT_NEAR(illuminance / luminance(analyticSunIlluminance(options)), 1.0, 0.01) << height;
        }
    }
}

// Preetham et al. 1999, figures 6 to 8, and CIE tables: about 100 klx from the sun and 10 to 20 klx from a blue sky at
// noon.
TEST_F(HdrSkyTest, AClearNoonHasTheIlluminanceOfAClearNoon) {
    const AnalyticSkyOptions options{
        .height = 64, .sunDirection = { 0.2f, 1, 0.2f }, .turbidity = 2.5f, .sunDisc = false
    };
    const double sun = luminance(analyticSunIlluminance(options));
    EXPECT_GT(sun, 80);
    EXPECT_LT(sun, 133);
    const HdrImage sky = make(options);
    double diffuse = 0;
    for (uint32_t y = 0; y < sky.height / 2; ++y) {
        const double cosine = std::cos(std::numbers::pi * (y + 0.5) / sky.height);
        for (uint32_t x = 0; x < sky.width; ++x) diffuse += pixelSolidAngle(sky, y) * cosine * luminance(sky.at(x, y));
    }
    EXPECT_GT(diffuse, 8);
    EXPECT_LT(diffuse, 30);
    const float3 awayFromSun = sky.at(0, 16);
    EXPECT_GT(awayFromSun.z, 1.3f * awayFromSun.x) << "the sky is blue";
}

TEST_F(HdrSkyTest, TheSunReddensAndDimsTowardsTheHorizon) {
    const float3 high = analyticSunIlluminance({ .sunDirection = { 0, 1, 0 } });
    const float3 low = analyticSunIlluminance({ .sunDirection = { 1, 0.05f, 0 } });
    EXPECT_LT(low.y, 0.5f * high.y);
    EXPECT_GT(low.x / low.z, 3 * high.x / high.z);
}

TEST_F(HdrSkyTest, TheGroundReflectsItsAlbedoOfWhatFallsOnIt) {
    const AnalyticSkyOptions dark{ .height = 32, .groundAlbedo = float3(0.1f), .sunDisc = false };
    AnalyticSkyOptions bright = dark;
    bright.groundAlbedo = float3(0.2f);
    const float3 a = make(dark).at(5, 30), b = make(bright).at(5, 30);
    EXPECT_NEAR(b.y / a.y, 2.0f, 1e-4f);
    AnalyticSkyOptions sunny = dark;
    sunny.sunDisc = true;
    const float sunOnGround = analyticSunIlluminance(sunny).y * glm::normalize(sunny.sunDirection).y;
    EXPECT_NEAR(make(sunny).at(5, 30).y - a.y, 0.1f * sunOnGround / kPi, 0.01f * a.y);
}

TEST_F(HdrSkyTest, WorkersDoNotChangeTheBits) {
    const HdrImage one = make({ .height = 64 });
    jobs::JobSystem none({ .workers = 0 });
    EXPECT_EQ(makeAnalyticSky({ .height = 64 }, none)->pixels, one.pixels);
}

TEST_F(HdrSkyTest, OptionsOutsideOfTheirRangeAreErrorsThatNameThem) {
    const auto message = [&](AnalyticSkyOptions const& options) {
        return makeAnalyticSky(options, mJobs).error().message;
    };
    EXPECT_NE(message({ .height = 7 }).find("height 7"), std::string::npos);
    EXPECT_NE(message({ .turbidity = 1 }).find("turbidity"), std::string::npos);
    EXPECT_NE(message({ .sunDirection = { 0, -1, 0 } }).find("horizon"), std::string::npos);
    EXPECT_NE(message({ .sunDirection = { 0, 0, 0 } }).find("horizon"), std::string::npos);
}

} // namespace
} // namespace filament_core::assets
