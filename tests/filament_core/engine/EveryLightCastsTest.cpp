// SPDX-License-Identifier: Apache-2.0
// Shadows of the lights that stand in the list: further suns, and areas.
#include "tests/filament_core/engine/ShadowStage.h"

#include <gtest/gtest.h>

namespace filament_core {
namespace {

using test::shadowedView;
using test::ShadowStage;

/// A plane with boxes above it.
struct BoxesOnAPlane {
    ShadowStage& stage;
    Scene scene{ stage.engine };

    explicit BoxesOnAPlane(ShadowStage& shadowStage) : stage(shadowStage) {
        stage.square.add(scene, stage.white, {}, 3);
        stage.addBox(scene, { -0.5, 0.3, 0.6 }, { 0.4, 0.3, 0.2 }, 0.5);
        stage.addBox(scene, { 0.6, -0.4, 0.3 }, { 0.2, 0.3, 0.3 });
    }
};

template <class... Lights>
Image pictureOf(ShadowStage& stage, View const& view, Lights const&... lights) {
    BoxesOnAPlane boxes(stage);
    (boxes.scene.add(lights), ...);
    return test::renderLinear(stage.engine, boxes.scene, view);
}

/// The largest difference, as a part of the brightest pixel.
template <class Expected>
double worstOf(Image const& image, uint2 size, Expected const& expected) {
    double worst = 0, most = 0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const double found = test::halfPixel(image, x, y).x;
            worst = std::max(worst, std::abs(found - expected(x, y)));
            most = std::max(most, found);
        }
    }
    return most > 0 ? worst / most : 1;
}

View viewOfBoxes(ShadowFilter filter) { return shadowedView({ 0.5, -2.5, 3 }, { 0, 0, 0.2 }, filter); }

TEST(EveryLightCasts, LightOfSeveralSunsIsTheSumOfTheirs) {
    const SunLight noon{ .directionWorld = { 0.3f, 0.2f, -1 }, .illuminance = Lux{ 60'000 } };
    const SunLight morning{ .directionWorld = { 1, -0.4f, -0.8f }, .illuminance = Lux{ 40'000 } };
    const SunLight evening{ .directionWorld = { -1, 0.5f, -0.7f }, .illuminance = Lux{ 30'000 } };
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        for (const ShadowFilter filter : test::kShadowFilters) {
            View view = viewOfBoxes(filter);
            view.quality.shadowMapSize = 256; // all of them fit at full size
            const Image a = pictureOf(stage, view, noon), b = pictureOf(stage, view, morning),
                        c = pictureOf(stage, view, evening), all = pictureOf(stage, view, noon, morning, evening);
            const auto sum = [&](uint32_t x, uint32_t y) {
                return double{ test::halfPixel(a, x, y).x } + double{ test::halfPixel(b, x, y).x } +
                       double{ test::halfPixel(c, x, y).x };
            };
            EXPECT_LT(worstOf(all, view.size, sum), 2e-3) << toString(backend) << ' ' << toString(filter);
            const auto alone = [&](uint32_t x, uint32_t y) { return double{ test::halfPixel(a, x, y).x }; };
            EXPECT_GT(worstOf(all, view.size, alone), 0.1) << "the others shine";
        }
    }
}

TEST(EveryLightCasts, ASunThatDoesNotCastLeavesTheShadowsOfOthers) {
    const SunLight noon{ .directionWorld = { 0.3f, 0.2f, -1 }, .illuminance = Lux{ 60'000 }, .castsShadows = false };
    const SunLight morning{ .directionWorld = { 1, -0.4f, -0.8f }, .illuminance = Lux{ 40'000 } };
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const View view = viewOfBoxes(ShadowFilter::Pcf3);
        const Image a = pictureOf(stage, view, noon), b = pictureOf(stage, view, morning),
                    both = pictureOf(stage, view, noon, morning);
        const auto sum = [&](uint32_t x, uint32_t y) {
            return double{ test::halfPixel(a, x, y).x } + double{ test::halfPixel(b, x, y).x };
        };
        EXPECT_LT(worstOf(both, view.size, sum), 2e-3) << toString(backend);
    }
}

// What a hard filter lets through does not depend on what shines from there.
TEST(EveryLightCasts, AreasHaveTheShadowsOfAPointInTheirMiddle) {
    const double3 at(0.4, 0.3, 2);
    const float3 down(0, 0, -1);
    const PointLight point{ .positionWorld = at, .intensity = Candela{ 50'000 } };
    const RectLight rect{ .positionWorld = at, .directionWorld = down, .luminance = Nits{ 1e5f } };
    const DiscLight disc{ .positionWorld = at, .directionWorld = down, .luminance = Nits{ 1e5f } };
    const TubeLight tube{ .positionWorld = at, .luminance = Nits{ 1e6f } };
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        View view = shadowedView({ 0, 0, 5 }, {}, ShadowFilter::Hard); // what the lights graze is out of view
        View plain = view;
        plain.quality.shadows = ShadowFilter::Off;
        const auto sharesOf = [&](auto const& light) {
            const Image with = pictureOf(stage, view, light), without = pictureOf(stage, plain, light);
            std::vector<double> shares;
            for (uint32_t y = 0; y < view.size.y; ++y) {
                for (uint32_t x = 0; x < view.size.x; ++x) {
                    const double all = test::halfPixel(without, x, y).x;
                    shares.push_back(all > 0 ? test::halfPixel(with, x, y).x / all : -1);
                }
            }
            return shares;
        };
        const std::vector<double> ofPoint = sharesOf(point);
        EXPECT_GT(std::ranges::count(ofPoint, 0.0), 100) << "boxes cast";
        const auto expectSame = [&](std::vector<double> const& shares, const char* name) {
            size_t compared = 0, other = 0;
            for (size_t i = 0; i < shares.size(); ++i) {
                if (shares[i] < 0 || ofPoint[i] < 0) continue; // sides of boxes that only an area sees
                ++compared;
                other += std::abs(shares[i] - ofPoint[i]) > 1e-3;
            }
            EXPECT_GT(compared, shares.size() / 2) << name;
            EXPECT_EQ(other, 0u) << name << ' ' << toString(backend);
        };
        expectSame(sharesOf(rect), "rectangle");
        expectSame(sharesOf(disc), "disc");
        expectSame(sharesOf(tube), "tube");
        RectLight silent = rect;
        silent.castsShadows = false;
        EXPECT_EQ(std::ranges::count(sharesOf(silent), 0.0), 0) << "switched off";
    }
}

TEST(EveryLightCasts, AreasShineOnTheirChannels) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const View view = viewOfBoxes(ShadowFilter::Pcf3);
        RectLight rect{ .positionWorld = { 0, 0, 2 }, .directionWorld = { 0, 0, -1 }, .luminance = Nits{ 1e5f } };
        const test::Extremes lit = test::extremesOf(pictureOf(stage, view, rect));
        rect.lightChannels = 2;
        const test::Extremes off = test::extremesOf(pictureOf(stage, view, rect));
        EXPECT_GT(lit.most, 0);
        EXPECT_EQ(off.most, 0) << "nothing is on channel 1";
    }
}

} // namespace
} // namespace filament_core
