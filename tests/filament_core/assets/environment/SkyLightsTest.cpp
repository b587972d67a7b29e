// SPDX-License-Identifier: Apache-2.0
// Suns and lamps of generated skies: where they are, how bright, and that nothing is lost or counted twice. The skies
// are painted here, and irradiances are summed here, from the directions of <filament_core/Environment.h>.
#include "filament_core/assets/environment/SkyLights.h"
#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/environment/LightNumbers.h"
#include "filament_core/assets/image/HdrReader.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/LoadOptions.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace filament_core::assets {
namespace {

using std::numbers::pi;

constexpr double kDegrees = 180 / pi;

using Radiance = std::function<float3(double3)>;

double angleBetween(double3 a, double3 b) {
    return 2 * std::asin(std::min(1.0, glm::length(glm::normalize(a) - glm::normalize(b)) / 2)) * kDegrees;
}

double3 panoramaDirection(double u, double v) {
    const double azimuth = (0.5 - u) * 2 * pi, polar = v * pi;
    return { std::sin(azimuth) * std::sin(polar), std::cos(polar), std::cos(azimuth) * std::sin(polar) };
}

double solidAngleOf(HdrImage const& sky, uint32_t y) {
    return 2 * pi / sky.width * (std::cos(pi * y / sky.height) - std::cos(pi * (y + 1) / sky.height));
}

HdrImage skyOf(uint32_t height, Radiance const& radiance) {
    HdrImage sky{ .width = 2 * height, .height = height, .pixels = {}, .repairs = {} };
    for (uint32_t y = 0; y < sky.height; ++y)
        for (uint32_t x = 0; x < sky.width; ++x)
            sky.pixels.push_back(radiance(panoramaDirection((x + 0.5) / sky.width, (y + 0.5) / sky.height)));
    return sky;
}

/// A disc of this illuminance: what each pixel shows of it, from 16 x 16 points, and at least the one in its middle.
void addDisc(HdrImage& sky, double3 sun, double radiusDegrees, double3 illuminance) {
    std::vector<double> covered(sky.pixels.size());
    const double pixel = 180.0 / sky.height, chord = 2 * std::sin(radiusDegrees / kDegrees / 2);
    double total = 0, nearest = 10;
    size_t middle = 0;
    double middleSolidAngle = 0;
    for (uint32_t y = 0; y < sky.height; ++y) {
        for (uint32_t x = 0; x < sky.width; ++x) {
            const double away =
                    glm::length(panoramaDirection((x + 0.5) / sky.width, (y + 0.5) / sky.height) - sun) * kDegrees;
            const size_t index = size_t(y) * sky.width + x;
            if (away < nearest) nearest = away, middle = index, middleSolidAngle = solidAngleOf(sky, y);
            if (away > radiusDegrees + 1.5 * pixel) continue;
            int inside = 0;
            for (int i = 0; i < 256; ++i)
                inside += glm::length(panoramaDirection((x + (i % 16 + 0.5) / 16) / sky.width,
                                                        (y + (i / 16 + 0.5) / 16) / sky.height) -
                                      sun) <= chord;
            covered[index] = inside / 256.0;
            total += covered[index] * solidAngleOf(sky, y);
        }
    }
    if (total <= 0) covered[middle] = 1, total = middleSolidAngle;
    for (size_t i = 0; i < covered.size(); ++i) sky.pixels[i] += float3(illuminance * (covered[i] / total));
}

/// Pixels as directional lights: their illuminances.
struct PixelLights {
    std::vector<double3> directions, illuminances;

    explicit PixelLights(HdrImage const& sky) {
        for (uint32_t y = 0; y < sky.height; ++y) {
            for (uint32_t x = 0; x < sky.width; ++x) {
                directions.push_back(panoramaDirection((x + 0.5) / sky.width, (y + 0.5) / sky.height));
                illuminances.push_back(double3(sky.at(x, y)) * solidAngleOf(sky, y));
            }
        }
    }
    double3 irradiance(double3 normal) const {
        double3 sum(0.0);
        for (size_t i = 0; i < directions.size(); ++i)
            sum += illuminances[i] * std::max(glm::dot(directions[i], normal), 0.0);
        return sum;
    }
};

double3 irradianceOf(HdrImage const& sky, double3 normal) { return PixelLights(sky).irradiance(normal); }

double3 irradianceOf(EnvironmentLights const& lights, double3 normal) {
    double3 sum(0.0);
    for (ExtractedLight const& light : lights.found())
        sum += double3(light.illuminance) * std::max(glm::dot(double3(light.direction), normal), 0.0);
    return sum;
}

class Directions {
public:
    explicit Directions(uint32_t seed) : mRandom(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(mRandom); }
    double3 direction() {
        const double y = number(-1, 1), azimuth = number(-pi, pi), r = std::sqrt(1 - y * y);
        return { r * std::cos(azimuth), y, r * std::sin(azimuth) };
    }

private:
    std::mt19937 mRandom;
};

/// Sum of absolute differences over the sum: of the irradiance of 1000 normals.
double irradianceError(HdrImage const& sky, HdrImage const& rest, EnvironmentLights const& lights) {
    Directions random(7);
    const PixelLights ofSky(sky), ofRest(rest);
    double difference = 0, sum = 0;
    for (int i = 0; i < 1000; ++i) {
        const double3 normal = random.direction(), all = ofSky.irradiance(normal);
        const double3 parts = ofRest.irradiance(normal) + irradianceOf(lights, normal);
        for (int c = 0; c < 3; ++c) difference += std::abs(parts[c] - all[c]), sum += all[c];
    }
    return difference / sum;
}

float3 softSky(double3 d) {
    const double light = 1 + 0.5 * d.y + 0.2 * d.x;
    return { float(0.8 * light), float(light), float(1.3 * light) };
}

class SkyLightsTest : public ::testing::Test {
protected:
    EnvironmentLights take(HdrImage& sky, EnvironmentSun sun = EnvironmentSun::Extract, uint32_t most = 1) {
        return takeLights(sky, SkyLayout::Panorama, sun, most, mJobs);
    }
    jobs::JobSystem mJobs{ { .workers = 1 } };
};

/// Of any share of the light, size and place.
TEST_F(SkyLightsTest, ASunIsWhereItIsAndAsBrightAsItIs) {
    Directions random(1);
    double worstAngle = 0, worstLight = 0;
    for (int i = 0; i < 1000; ++i) {
        const uint32_t height = i % 25 == 0 ? 256 : 32u << (i % 3);
        const double3 sun = random.direction();
        const double radius = random.number(0.2665, 2), share = random.number(0.15, 0.95);
        HdrImage sky = skyOf(height, softSky);
        const double3 illuminance = double3(1.1, 1.0, 0.8) * (pi * share / (1 - share));
        addDisc(sky, sun, radius, illuminance);
        const EnvironmentLights lights = take(sky);
        ASSERT_EQ(lights.count, 1u) << i << ": " << height << " rows, radius " << radius << ", share " << share << ", "
                                    << sun.x << ' ' << sun.y << ' ' << sun.z << ' ' << explain(lights, {});
        // A sun in one pixel is up to half of it away in both directions.
        const double angle = angleBetween(double3(lights.lights[0].direction), sun) - std::sqrt(2) * 90.0 / height;
        const double light = lights.lights[0].illuminance.y / illuminance.y - 1;
        EXPECT_LE(angle, 0.1) << i << ": " << height << " rows, radius " << radius;
        EXPECT_LE(std::abs(light), 0.01) << i << ": " << height << " rows, radius " << radius << ", share " << share
                                         << ' ' << sun.y;
        worstAngle = std::max(worstAngle, angle), worstLight = std::max(worstLight, std::abs(light));
    }
    RecordProperty("worstAngle", std::to_string(worstAngle));
    RecordProperty("worstLight", std::to_string(worstLight));
}

TEST_F(SkyLightsTest, SunAndRestAddUpToTheSky) {
    Directions random(2);
    for (const uint32_t height : { 32u, 64u }) {
        HdrImage sky = skyOf(height, softSky);
        const double3 sun = random.direction();
        addDisc(sky, sun, 0.5, double3(6, 5, 4));
        HdrImage rest = sky;
        const EnvironmentLights lights = take(rest);
        ASSERT_EQ(lights.count, 1u);
        const double3 facing = irradianceOf(sky, sun), parts = irradianceOf(rest, sun) + irradianceOf(lights, sun);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c] / facing[c], 1, 0.001);
        EXPECT_LT(irradianceError(sky, rest, lights), 0.002) << height;
        const double light = skyLuminance(lights.lights[0].illuminance);
        EXPECT_NEAR(lights.lights[0].share, light / skyLuminance(float3(facing)), 0.01);
    }
}

TEST_F(SkyLightsTest, TheSkyBehindTheSunContinuesTheSkyAroundIt) {
    HdrImage sky = skyOf(256, softSky);
    const HdrImage without = sky;
    addDisc(sky, glm::normalize(double3(0.3, 0.5, -0.8)), 0.6, double3(6, 5, 4));
    ASSERT_EQ(take(sky).count, 1u);
    for (size_t i = 0; i < sky.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(sky.pixels[i][c] / without.pixels[i][c], 1, 0.01) << i;
}

TEST_F(SkyLightsTest, TheSeamAndThePolesAreNotSpecial) {
    for (const double3 sun : { double3(0, 1, 0), double3(0, -1, 0), double3(0, 0, -1), double3(0, 0.02, -1),
                               double3(1e-3, 1, 1e-3), double3(-1e-4, 0.3, -1), double3(1e-4, 0.3, -1) }) {
        const double3 towards = glm::normalize(sun);
        for (const uint32_t height : { 32u, 60u }) {
            HdrImage sky = skyOf(height, softSky);
            addDisc(sky, towards, 0.7, double3(5.0));
            HdrImage rest = sky;
            const EnvironmentLights lights = take(rest);
            ASSERT_EQ(lights.count, 1u) << sun.x << ' ' << sun.y << ' ' << sun.z;
            EXPECT_LT(angleBetween(double3(lights.lights[0].direction), towards), 0.1 + 90.0 / height);
            EXPECT_NEAR(lights.lights[0].illuminance.x, 5, 0.05);
            EXPECT_LT(irradianceError(sky, rest, lights), 0.002);
        }
    }
}

/// The radius is that of the disc as soon as pixels are smaller.
TEST_F(SkyLightsTest, ASunIsAsWideAsItsDisc) {
    for (const double radius : { 1.0, 1.5, 2.0 }) {
        HdrImage sky = skyOf(512, softSky);
        addDisc(sky, glm::normalize(double3(1, 1, 1)), radius, double3(20.0));
        EXPECT_NEAR(take(sky).lights[0].angularRadiusDegrees, radius, 0.06 * radius);
    }
    HdrImage coarse = skyOf(64, softSky); // pixels of 2.8 degrees do not make it wider
    addDisc(coarse, glm::normalize(double3(1, 1, 1)), 0.2665, double3(20.0));
    EXPECT_FLOAT_EQ(take(coarse).lights[0].angularRadiusDegrees, 0.2665f);
}

TEST_F(SkyLightsTest, SkiesWithoutASunKeepTheirLight) {
    Directions random(3);
    std::mt19937 noise(5);
    const double3 zenith = glm::normalize(double3(0.4, 0.8, 0.1));
    const std::vector<Radiance> skies{
        [](double3) { return float3(1.0f); },
        [](double3) { return float3(0.0f); },
        softSky,
        [&](double3) { return float3(float(noise() % 1000) / 1000); },
        [](double3 d) { return d.y > 0 ? float3((1 + 2 * float(d.y)) / 3) : float3(0.1f); },         // overcast
        [&](double3 d) { return float3(float(1 + 40 * std::exp(60 * (glm::dot(d, zenith) - 1)))); }, // behind clouds
        [&](double3 d) { return float3(glm::dot(d, zenith) > 0.98 ? 50.0f : 0.1f); },                // a lamp
        [](double3 d) { return float3(std::abs(d.x) < 0.2 && d.y > 0.9 ? 20.0f : 0.3f); },           // a window
    };
    for (size_t i = 0; i < skies.size(); ++i) {
        HdrImage sky = skyOf(128, skies[i]), before = sky;
        const EnvironmentLights lights = take(sky);
        EXPECT_EQ(lights.count, 0u) << i << ": " << explain(lights, {});
        EXPECT_NE(lights.search, SunSearch::Found);
        EXPECT_FALSE(explain(lights, {}).empty());
        EXPECT_EQ(sky.pixels, before.pixels);
    }
    jobs::JobSystem jobs({ .workers = 0 });
    for (const float turbidity : { 2.0f, 4.0f, 9.0f }) {
        Result<HdrImage> sky = makeAnalyticSky({ .height = 128, .turbidity = turbidity, .sunDisc = false }, jobs);
        ASSERT_TRUE(sky);
        EXPECT_EQ(take(*sky).count, 0u);
    }
}

TEST_F(SkyLightsTest, TheReasonSaysWhatThereIsInstead) {
    HdrImage wide = skyOf(128, [](double3 d) { return float3(d.y > 0.98 ? 50.0f : 0.1f); });
    EXPECT_EQ(take(wide).search, SunSearch::Wide);
    HdrImage dim = skyOf(256, softSky);
    addDisc(dim, glm::normalize(double3(1, 1, 1)), 0.5, double3(0.2));
    const EnvironmentLights spot = take(dim);
    EXPECT_EQ(spot.search, SunSearch::Dim);
    EXPECT_NEAR(spot.brightest.share, 0.05, 0.02);
    HdrImage even = skyOf(64, softSky);
    EXPECT_EQ(take(even).search, SunSearch::Even);
}

/// The sun and the sky of the model, at every height.
TEST_F(SkyLightsTest, TheSunOfAnAnalyticSkyHasItsIlluminance) {
    for (const float height : { 0.05f, 0.3f, 1.0f, 4.0f }) {
        for (const uint32_t rows : { 64u, 256u, 512u }) {
            const AnalyticSkyOptions options{ .height = rows, .sunDirection = { 0.6f, height, -0.5f } };
            if (height < 0.1f && rows < 256) continue; // the sky of a pixel is as bright as that sun
            Result<HdrImage> sky = makeAnalyticSky(options, mJobs);
            ASSERT_TRUE(sky);
            const HdrImage before = *sky;
            const EnvironmentLights lights = take(*sky);
            ASSERT_EQ(lights.count, 1u) << height << ' ' << rows << explain(lights, {});
            const float3 illuminance = analyticSunIlluminance(options);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(lights.lights[0].illuminance[c] / illuminance[c], 1, 0.03)
                        << height << ' ' << rows << ' ' << c;
            EXPECT_LT(angleBetween(double3(lights.lights[0].direction), double3(options.sunDirection)),
                      0.1 + 90.0 / rows);
            if (rows == 64) {
                EXPECT_LT(irradianceError(before, *sky, lights), 0.002);
            }
        }
    }
}

TEST_F(SkyLightsTest, LampsBecomeAsManyLightsAsAsked) {
    const double3 lamps[] = { glm::normalize(double3(1, 0.4, 0)), glm::normalize(double3(0, 0.5, -1)),
                              glm::normalize(double3(-1, 0.2, 0.3)), glm::normalize(double3(0.1, 1, 0.1)) };
    const double light[] = { 4, 3, 2, 1 };
    HdrImage sky = skyOf(64, [](double3) { return float3(0.1f); });
    for (int i = 0; i < 4; ++i) addDisc(sky, lamps[i], 8, double3(light[i], 0.9 * light[i], 0.7 * light[i]));
    for (uint32_t most = 1; most <= 4; ++most) {
        HdrImage rest = sky;
        const EnvironmentLights lights = take(rest, EnvironmentSun::Fit, most);
        ASSERT_EQ(lights.count, most) << explain(lights, {});
        for (uint32_t i = 0; i < most; ++i) {
            EXPECT_LT(angleBetween(double3(lights.lights[i].direction), lamps[i]), 0.5);
            EXPECT_NEAR(lights.lights[i].illuminance.x / light[i], 0.9, 0.1);
            EXPECT_NEAR(lights.lights[i].angularRadiusDegrees, 8, 0.6); // pixels of 2.8 degrees
        }
        EXPECT_LT(irradianceError(sky, rest, lights), 0.01) << most;
    }
}

TEST_F(SkyLightsTest, AFitFindsTheSunFirstAndKeepsTheSum) {
    HdrImage sky = skyOf(64, [](double3 d) { // a sun, and clouds around it
        return softSky(d) * float(1 + 3 * std::exp(8 * (glm::dot(d, glm::normalize(double3(0.5, 0.7, 0.4))) - 1)));
    });
    const double3 sun = glm::normalize(double3(0.4, 0.6, 0.5));
    addDisc(sky, sun, 0.3, double3(8.0));
    HdrImage rest = sky;
    const EnvironmentLights lights = take(rest, EnvironmentSun::Fit, 3);
    ASSERT_GE(lights.count, 2u);
    EXPECT_LT(angleBetween(double3(lights.lights[0].direction), sun), 0.1 + 90.0 / 64);
    EXPECT_NEAR(lights.lights[0].illuminance.x, 8, 0.08);
    EXPECT_LT(irradianceError(sky, rest, lights), 0.01);
}

TEST_F(SkyLightsTest, FitsDoNotSplitALampAtTheSeam) {
    HdrImage sky = skyOf(128, [](double3) { return float3(0.1f); });
    addDisc(sky, double3(0, 0, -1), 8, double3(3.0));
    const EnvironmentLights lights = take(sky, EnvironmentSun::Fit, 4);
    ASSERT_EQ(lights.count, 1u) << explain(lights, {});
    EXPECT_LT(angleBetween(double3(lights.lights[0].direction), double3(0, 0, -1)), 0.1);
}

TEST_F(SkyLightsTest, ACubeHasTheSameSun) {
    const double3 towards[] = { glm::normalize(double3(1, 1, 1)), glm::normalize(double3(1, 0.999, 0.1)),
                                double3(0, 0, -1) }; // a corner, an edge, the middle of a face
    for (const double3 sun : towards) {
        constexpr uint32_t kSize = 128;
        HdrImage cube{ .width = kSize, .height = 6 * kSize, .pixels = {}, .repairs = {} };
        cube.pixels.resize(size_t{ kSize } * cube.height);
        const SkyGrid grid(cube, SkyLayout::Cube);
        double discSolidAngle = 0, all = 0;
        for (size_t i = 0; i < cube.pixels.size(); ++i) {
            all += grid.solidAngle(i);
            if (angleBetween(grid.direction(i), sun) < 1.5) discSolidAngle += grid.solidAngle(i);
        }
        EXPECT_NEAR(all, 4 * pi, 1e-3);
        for (size_t i = 0; i < cube.pixels.size(); ++i) {
            const double3 d = grid.direction(i);
            cube.pixels[i] = softSky(d) + float3(angleBetween(d, sun) < 1.5 ? float(4 / discSolidAngle) : 0.0f);
        }
        const EnvironmentLights lights = takeLights(cube, SkyLayout::Cube, EnvironmentSun::Extract, 1, mJobs);
        ASSERT_EQ(lights.count, 1u) << explain(lights, {});
        EXPECT_LT(angleBetween(double3(lights.lights[0].direction), sun), 0.1 + 0.5 * 90.0 / kSize);
        EXPECT_NEAR(lights.lights[0].illuminance.x, 4, 0.04);
    }
}

/// Photographs: a beach at noon, a room with windows and a bulb, a studio with a soft box and a floor lamp.
TEST_F(SkyLightsTest, PhotographsHaveTheSunThatTheyShow) {
    const auto photograph = [](const char* name) { return readHdrImage(tools::assetDir() / "environments" / name); };
    Result<HdrImage> beach = photograph("spiaggia_di_mondello_1k.hdr"), room = photograph("st_fagans_interior_1k.hdr"),
                     studio = photograph("studio_small_03_1k.hdr");
    if (!beach || !room || !studio) GTEST_SKIP() << "FILAMENT_ASSET_DIR has no environments";
    HdrImage rest = *beach;
    const EnvironmentLights sun = take(rest);
    ASSERT_EQ(sun.count, 1u) << explain(sun, {});
    // The brightest pixel is (615, 184).
    EXPECT_LT(angleBetween(double3(sun.lights[0].direction), panoramaDirection(615.5 / 1024, 184.5 / 512)), 0.3);
    EXPECT_NEAR(sun.lights[0].share, 0.777, 0.01);
    const double3 towards(sun.lights[0].direction), whole = irradianceOf(*beach, towards);
    const double3 parts = irradianceOf(rest, towards) + irradianceOf(sun, towards);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c] / whole[c], 1, 0.001);
    HdrImage kept = *room;
    EXPECT_EQ(take(kept).search, SunSearch::Wide);
    EXPECT_EQ(kept.pixels, room->pixels);
    kept = *studio;
    EXPECT_EQ(take(kept).search, SunSearch::Wide);
    EXPECT_EQ(take(*studio, EnvironmentSun::Fit, 4).count, 2u);
    EXPECT_EQ(take(*room, EnvironmentSun::Fit, 4).count, 4u);
}

TEST_F(SkyLightsTest, BrokenAndHugePixelsGiveFiniteLights) {
    for (const float huge : { 1e6f, 1e12f, kMaxRadiance, std::numeric_limits<float>::infinity() }) {
        HdrImage sky = skyOf(64, softSky);
        sky.at(10, 20) = float3(huge);
        sky.at(11, 20) = float3(std::numeric_limits<float>::quiet_NaN(), -1, 3);
        sanitise(sky);
        for (const EnvironmentSun sun : { EnvironmentSun::Extract, EnvironmentSun::Fit }) {
            HdrImage rest = sky;
            const EnvironmentLights lights = take(rest, sun, 4);
            for (ExtractedLight const& light : lights.found()) {
                const SunLight one = sunLightOf(light, { .illuminance = Lux{ 1e12f } });
                EXPECT_TRUE(one.illuminance.value >= 0 && one.illuminance.value <= 1e12f);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(one.directionWorld[c]) && std::isfinite(one.color[c]));
                    EXPECT_GE(light.illuminance[c], 0);
                }
            }
            for (float3 const& pixel : rest.pixels)
                for (int c = 0; c < 3; ++c) ASSERT_TRUE(pixel[c] >= 0 && std::isfinite(pixel[c]));
        }
    }
    for (const uint2 size : { uint2(1, 1), uint2(2, 1), uint2(1, 7), uint2(300, 2) }) {
        HdrImage sky{ .width = size.x, .height = size.y, .pixels = {}, .repairs = {} };
        sky.pixels.resize(size_t(size.x) * size.y, float3(1.0f));
        sky.pixels[0] = float3(1000.0f);
        for (const EnvironmentSun sun : { EnvironmentSun::Extract, EnvironmentSun::Fit }) take(sky, sun, 4);
    }
}

TEST_F(SkyLightsTest, TheBitsAreThoseOfAnyNumberOfWorkers) {
    HdrImage sky = skyOf(128, softSky);
    addDisc(sky, glm::normalize(double3(0.2, 0.3, -1)), 0.5, double3(5.0));
    addDisc(sky, glm::normalize(double3(0.2, 0.3, 1)), 9, double3(3.0));
    for (const EnvironmentSun sun : { EnvironmentSun::Extract, EnvironmentSun::Fit }) {
        HdrImage first = sky;
        const EnvironmentLights expected = take(first, sun, 3);
        for (const int workers : { 0, 2, 5 }) {
            jobs::JobSystem jobs({ .workers = workers });
            HdrImage again = sky;
            const EnvironmentLights lights = takeLights(again, SkyLayout::Panorama, sun, 3, jobs);
            EXPECT_EQ(numbersOf(lights), numbersOf(expected));
            EXPECT_EQ(again.pixels, first.pixels);
        }
    }
}

} // namespace
} // namespace filament_core::assets
