// SPDX-License-Identifier: Apache-2.0
// What every filter of shadow maps has to pass on both APIs: planes that do not shadow themselves, shadows that begin
// at the caster, penumbrae and blurs of known width, edges that stand still, and extremes.
#include "tests/filament_core/engine/ShadowStage.h"

#include <numbers>
#include <variant>

namespace filament_core {
namespace {

using prepare::Random;
using test::kShadowFilters;
using test::shadowedView;
using test::ShadowStage;

// A centimetre to a kilometre, the sun from a degree to the zenith, from all sides.
TEST(ShadowFilters, ALitPlaneIsNotDarkenedByItself) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        for (const double scale : { 0.01, 1.0, 37.0, 1000.0 }) {
            for (const double degrees : { 1.0, 2.0, 5.0, 17.0, 45.0, 70.0, 90.0 }) {
                Scene scene(stage.engine);
                stage.square.add(scene, stage.white, {}, scale);
                const double up = glm::radians(degrees), around = glm::radians(degrees * 31);
                scene.add(SunLight{ .directionWorld = { static_cast<float>(std::cos(up) * std::cos(around)),
                                                        static_cast<float>(std::cos(up) * std::sin(around)),
                                                        static_cast<float>(-std::sin(up)) },
                                    .illuminance = Lux{ 50'000 } });
                const double3 eye = double3(0.3, -1.4, 1.1) * scale;
                const Image plain = test::renderLinear(stage.engine, scene, shadowedView(eye, {}, ShadowFilter::Off));
                for (const ShadowFilter filter : kShadowFilters) {
                    const Image shadowed = test::renderLinear(stage.engine, scene, shadowedView(eye, {}, filter));
                    EXPECT_EQ(test::differingPixels(plain, shadowed), 0u)
                            << toString(backend) << ' ' << toString(filter) << ' ' << scale << " m, " << degrees
                            << " degrees";
                }
            }
        }
    }
}

/// From the middle of a filter, for a light without size.
double reachInTexels(ShadowFilter filter) {
    switch (filter) {
    case ShadowFilter::Hard:
        return 0.5;
    case ShadowFilter::Pcf2:
        return 1;
    case ShadowFilter::Pcf3:
    case ShadowFilter::Pcss:
        return 2;
    case ShadowFilter::Vsm:
    case ShadowFilter::Evsm:
        return 4; // the blur's three, and a bilinear look-up
    default:
        return 3;
    }
}

// A wall on a plane, seen from above: what is dark lies between the wall and where the ray over its top ends.
TEST(ShadowFilters, BeginAtTheCasterAndEndWhereTheLightPassesIt) {
    constexpr uint2 kSize{ 512, 8 };
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        for (const double degrees : { 10.0, 30.0, 60.0, 80.0 }) {
            for (const double scale : { 0.01, 1.0, 1000.0 }) {
                const double up = glm::radians(degrees), height = 0.5 * std::tan(up);
                Scene scene(stage.engine);
                stage.square.add(scene, stage.white, {}, scale);
                const double4x4 upright = glm::scale(double4x4(1), double3(scale)) *
                                          glm::translate(double4x4(1), double3(0, 0, height / 2)) *
                                          glm::rotate(double4x4(1), glm::radians(90.0), double3(0, 1, 0)) *
                                          glm::scale(double4x4(1), double3(height / 2, 0.5, 1));
                stage.square.add(scene, stage.white, upright);
                scene.add(SunLight{
                        .directionWorld = { static_cast<float>(std::cos(up)), 0, static_cast<float>(-std::sin(up)) },
                        .illuminance = Lux{ 50'000 },
                        .angularRadiusDegrees = 0 });
                // The wall is edge on, and the image as wide as the plane.
                for (const ShadowFilter filter : kShadowFilters) {
                    View view = shadowedView({ 0, 0, scale * 200 }, {}, filter, kSize);
                    view.camera.lens.verticalFovDegrees =
                            static_cast<float>(glm::degrees(2 * std::atan(1.0 * kSize.y / kSize.x / 200)));
                    const Image image = test::renderLinear(stage.engine, scene, view);
                    // A map is as wide as the scene's extent across the light, with margins.
                    const double extent = 2.0 * 1.07 * 1.07 * std::max(1.0, std::sin(up) + height * std::cos(up) / 2);
                    const double texel = extent / 512 / std::sin(up); // on the plane, along the light
                    const float lit = test::halfPixel(image, 2, 4).x;
                    for (uint32_t x = 0; x < kSize.x; ++x) {
                        const double at = 2 * (x + 0.5) / kSize.x - 1;
                        const float share = test::halfPixel(image, x, 4).x / lit;
                        const double reach = (1 + reachInTexels(filter)) * texel + 2.0 / kSize.x;
                        const bool isOutside = at < -reach || at > 0.5 + reach;
                        const bool isInside = at > reach && at < 0.5 - reach;
                        if (isOutside) {
                            EXPECT_NEAR(share, 1, 1e-3) << toString(filter) << degrees << ' ' << at;
                        }
                        if (isInside) {
                            EXPECT_NEAR(share, 0, 1e-3) << toString(filter) << degrees << ' ' << at;
                        }
                    }
                }
            }
        }
    }
}

/// The part of a disc of radius 1 around x that lies at positive x.
double visibleShare(double x) {
    if (std::abs(x) >= 1) return x > 0 ? 1 : 0;
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

/// Half of a ceiling a metre above a plane, which is seen from between them: x in [-0.5, 0.5].
template <class Light>
void expectPenumbra(ShadowStage& stage, Light const& light, double radius) {
    constexpr uint2 kSize{ 512, 64 };
    Scene scene(stage.engine);
    stage.square.add(scene, stage.white);
    stage.square.add(scene, stage.white, { -1, 0, 1 }, 1);
    scene.add(light);
    View view{ .camera = Camera::lookAt({ 0, 0, 0.9 }, { 0, 0, 0 }, { .nearMeters = 1e-3f }, {}, { 0, 1, 0 }),
               .size = kSize };
    view.camera.lens.verticalFovDegrees =
            static_cast<float>(glm::degrees(2 * std::atan(0.5 / 0.9 * kSize.y / kSize.x)));
    view.quality.shadowMapSize = 512;
    view.quality.shadows = ShadowFilter::Off;
    const Image plain = test::renderLinear(stage.engine, scene, view);
    view.quality.shadows = ShadowFilter::Pcss;
    const Image soft = test::renderLinear(stage.engine, scene, view);
    for (uint32_t x = 0; x < kSize.x; ++x) {
        double share = 0;
        for (uint32_t y = 0; y < kSize.y; ++y)
            share += test::halfPixel(soft, x, y).x / test::halfPixel(plain, x, y).x / kSize.y;
        const double at = (x + 0.5) / kSize.x - 0.5;
        EXPECT_NEAR(share, visibleShare(at / radius), 0.06) << at << " m, radius " << radius;
    }
}

TEST(ShadowFilters, PenumbraeAreAsWideAsTheSizeOfTheLightMakesThem) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        for (const double degrees : { 1.0, 2.0, 4.0 }) {
            const SunLight sun{ .directionWorld = { 0, 0, -1 },
                                .illuminance = Lux{ 50'000 },
                                .angularRadiusDegrees = static_cast<float>(degrees) };
            expectPenumbra(stage, sun, std::tan(glm::radians(degrees)));
        }
        for (const double radius : { 0.05, 0.1, 0.2 }) {
            const PointLight point{ .positionWorld = { 0, 0, 2 },
                                    .intensity = Candela{ 50'000 },
                                    .sourceRadiusMeters = static_cast<float>(radius) };
            expectPenumbra(stage, point, radius);
            const DiscLight disc{ .positionWorld = { 0, 0, 2 },
                                  .directionWorld = { 0, 0, -1 },
                                  .radiusMeters = static_cast<float>(radius),
                                  .luminance = Nits{ 1e6f } };
            expectPenumbra(stage, disc, radius);
        }
    }
}

/// Of an edge `texels` away from the place of a look-up: the part of a tent's weights that is lit, between two texels.
double litShareOfBlur(double texels, int radius) {
    const auto atTexel = [&](double center) {
        double lit = 0;
        for (int i = -radius; i <= radius; ++i) lit += center + i > 0 ? radius + 1 - std::abs(i) : 0;
        return lit / ((radius + 1) * (radius + 1));
    };
    const double lower = std::floor(texels - 0.5) + 0.5;
    return std::lerp(atTexel(lower), atTexel(lower + 1), texels - lower);
}

// Two depths alone: Chebyshev's bound is exact, and what is cut off it is known.
TEST(ShadowFilters, BlurredEdgesHaveTheProfileOfTheBlur) {
    constexpr uint2 kSize{ 512, 8 };
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.white, {}, 4);
        stage.square.add(scene, stage.white, { -4, 0, 2 }, 4);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 50'000 } });
        View view = shadowedView({ 0, 0, 1 }, {}, ShadowFilter::Off, kSize);
        constexpr double width = 2; // metres of the image
        view.camera.lens.verticalFovDegrees =
                static_cast<float>(glm::degrees(2 * std::atan(width / 2 * kSize.y / kSize.x)));
        const float lit = test::halfPixel(test::renderLinear(stage.engine, scene, view), 100, 4).x;
        view.quality.shadows = ShadowFilter::Vsm;
        for (const int radius : { 0, 1, 2, 8 }) {
            view.quality.shadowBlurTexels = static_cast<uint8_t>(radius);
            const Image image = test::renderLinear(stage.engine, scene, view);
            double least = 1e9;
            for (double texel = 2.0 / 512; texel < 14.0 / 512; texel *= 1.01) { // what the fit makes it
                for (double phase = -0.5; phase < 0.5; phase += 0.05) {
                    double worst = 0;
                    for (uint32_t x = 0; x < kSize.x; x += 3) {
                        const double at = ((x + 0.5) / kSize.x - 0.5) * width;
                        const double share = litShareOfBlur(at / texel + phase, radius);
                        const double expected = std::clamp((share - 0.2) / 0.78, 0.0, 1.0);
                        worst = std::max(worst, std::abs(test::halfPixel(image, x, 4).x / lit - expected));
                    }
                    least = std::min(least, worst);
                }
            }
            EXPECT_LT(least, 0.05) << toString(backend) << ", a blur of " << radius;
        }
    }
}

// The camera moves over a plane by whole pixels, which are half a texel and less: the images are those of the first
// step, shifted.
TEST(ShadowFilters, EdgesDoNotCrawlUnderAMovingCamera) {
    constexpr uint32_t kSide = 64, kSteps = 40;
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.white, {}, 1000);
        stage.addBox(scene, { 0, 0, 6 }, { 0.4, 0.3, 0.1 }, 0.4); // above the camera
        scene.add(SunLight{ .directionWorld = { 0.3f, 0.2f, -1 }, .illuminance = Lux{ 50'000 } });
        Renderer renderer(stage.engine);
        const double pixel = 2 * 2 * std::tan(glm::radians(20.0)) / kSide;
        const auto pictureAt = [&](uint32_t step, ShadowFilter filter) {
            const double3 eye(1.5 + step * pixel, 1.2, 2);
            View view = shadowedView(eye, eye - double3(0, 0, 2), filter, { kSide, kSide });
            view.camera.lens.verticalFovDegrees = 40;
            view.quality.shadowMapSize = 64;
            return test::renderLinear(stage.engine, scene, view);
        };
        for (const ShadowFilter filter : { ShadowFilter::Hard, ShadowFilter::Pcf2, ShadowFilter::Pcf3,
                                           ShadowFilter::Pcf5, ShadowFilter::Vsm, ShadowFilter::Evsm }) {
            const Image first = pictureAt(0, filter);
            const test::Extremes range = test::extremesOf(first);
            ASSERT_LT(range.least, range.most / 2) << "the shadow is in view";
            size_t changed = 0, compared = 0;
            for (uint32_t step = 1; step < kSteps; ++step) {
                const Image now = pictureAt(step, filter);
                for (uint32_t y = 0; y < kSide; ++y) {
                    for (uint32_t x = step; x < kSide; ++x, ++compared) {
                        const float before = test::halfPixel(first, x, y).x,
                                    after = test::halfPixel(now, x - step, y).x;
                        changed += std::abs(before - after) > 0.01f * range.most;
                    }
                }
            }
            // A hard edge that meets the middle of a pixel may fall to either side by rounding.
            EXPECT_LE(changed, filter == ShadowFilter::Hard ? compared / 2000 : 0u) << toString(filter);
        }
    }
}

struct ExtremeScene {
    const char* name;
    double scale = 1, distance = 0;                        ///< of the receiver, in metres; of all from the origin
    double3 caster{ 0.3 };                                 ///< half of its size, in parts of the scale
    std::variant<SunLight, PointLight, SpotLight> light{}; ///< in parts of the scale
};

std::vector<ExtremeScene> extremeScenes() {
    const auto cone = [](double degrees) { return static_cast<float>(glm::radians(degrees / 2)); };
    const float3 down(0, 0, -1);
    const SunLight sun{ .directionWorld = { 0.3f, 0.1f, -1 }, .illuminance = Lux{ 50'000 } };
    const SunLight low{ .directionWorld = { std::cos(0.0174533f), 0, -std::sin(0.0174533f) } };
    const PointLight inside{ .positionWorld = { 0, 0, 0.5 }, .intensity = Candela{ 1e4f }, .sourceRadiusMeters = 0.1f };
    const PointLight onPlane{ .positionWorld = { 0.4, 0, 0 }, .intensity = Candela{ 1e4f } };
    const PointLight brightest{ .positionWorld = { 0, 0, 1 },
                                .intensity = Candela{ 1e9f },
                                .sourceRadiusMeters = 1e6f };
    const SpotLight narrow{ .positionWorld = { 0, 0, 2 },
                            .directionWorld = down,
                            .intensity = Candela{ 1e4f },
                            .outerConeRadians = cone(0.01) };
    const SpotLight wide{ .positionWorld = { 0.5, 0, 0.9 },
                          .directionWorld = down,
                          .intensity = Candela{ 1e4f },
                          .outerConeRadians = cone(179) };
    return { { "a millimetre", 1e-3, 0, double3(0.3), sun },
             { "100 km", 1e5, 0, double3(0.3), sun },
             { "a sun at one degree", 1, 0, double3(0.3), low },
             { "10^7 m away", 1, 1e7, double3(0.3), sun },
             { "a lamp 10^7 m away", 1, 1e7, double3(0.2), brightest },
             { "a light inside of a box", 1, 0, double3(0.3), inside },
             { "a light on the plane", 1, 0, double3(0.3), onPlane },
             { "a caster without size", 1, 0, double3(0), sun },
             { "a caster without thickness", 1, 0, double3(0.3, 0.3, 0), sun },
             { "a cone of 0.01 degrees", 1, 0, double3(0.3), narrow },
             { "a cone of 179 degrees", 1, 0, double3(0.3), wide },
             { "10^9 candela, a source of 1000 km", 1, 0, double3(0.2), brightest } };
}

TEST(ShadowFilters, ExtremesAreNumbersAndHaveTheSameBitsOnBothApis) {
    ShadowStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    for (ExtremeScene const& extreme : extremeScenes()) {
        const double3 origin(extreme.distance, -extreme.distance, extreme.distance / 2);
        for (const ShadowFilter filter : kShadowFilters) {
            std::vector<Image> images;
            for (ShadowStage* stage : { &vulkan, &gles }) {
                Scene scene(stage->engine);
                stage->square.add(scene, stage->white, origin, extreme.scale);
                stage->addBox(scene, origin + double3(0, 0, 0.5 * extreme.scale), extreme.caster * extreme.scale);
                std::visit(
                        [&](auto light) {
                            if constexpr (requires { light.positionWorld; })
                                light.positionWorld = light.positionWorld * extreme.scale + origin;
                            scene.add(light);
                        },
                        extreme.light);
                View view = shadowedView(origin + double3(0.4, -1.2, 1.3) * extreme.scale, origin, filter, { 40, 32 });
                view.camera.lens.nearMeters = static_cast<float>(1e-3 * extreme.scale);
                images.push_back(test::renderLinear(stage->engine, scene, view));
                for (uint32_t i = 0; i < 40 * 32; ++i) {
                    const float4 color = test::halfPixel(images.back(), i % 40, i / 40);
                    ASSERT_FALSE(std::isnan(color.x + color.y + color.z)) << extreme.name << ' ' << toString(filter);
                }
            }
            EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << extreme.name << ' ' << toString(filter);
        }
    }
}

} // namespace
} // namespace filament_core
