// SPDX-License-Identifier: Apache-2.0
// Suns in the sky: the light of the disc and of its halo against closed forms, wherever the sun is and however small;
// and what stays as it is without them.
#include "backend/layers/Captured.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <numbers>

namespace filament_core {
namespace {

using prepare::Random;

constexpr double kDiscPi = std::numbers::pi;
constexpr double kLargestHalf = 65504;

double radiansOf(double degrees) { return degrees * kDiscPi / 180; }

constexpr const char* kBlack = R"(material { name : black, shadingModel : unlit, doubleSided : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.0, 0.5, 0.0);
} })";

struct DiscStage : test::SquareStage {
    const MaterialInstance black = instance;
    Renderer renderer{ engine };

    explicit DiscStage(Backend backend) : SquareStage(backend, kBlack, std::make_shared<backend::FrameCapture>()) {}

    Image draw(Scene const& scene, View const& view) { return test::renderLinear(engine, renderer, scene, view); }
    Image drawSun(SunLight const& sun, View const& view) {
        Scene scene(engine);
        scene.add(sun);
        return draw(scene, view);
    }

    backend::CapturedFrame drawCaptured(Scene const& scene, View const& view, Image& image) {
        for (int i = 0; i < 4; ++i) draw(scene, view); // until nothing is made any more
        engine.waitIdle();
        capture->arm({});
        image = draw(scene, view);
        engine.waitIdle();
        return capture->take().value_or(backend::CapturedFrame{});
    }
};

View skyView(double fovDegrees, uint2 size = { 64, 48 }) {
    return { .camera = Camera::lookAt({ 3, -2, 5 }, { 3, -2, 4 },
                                      { .verticalFovDegrees = static_cast<float>(fovDegrees) }),
             .size = size };
}

/// View direction of a point on screen; unit.
double3 directionAt(View const& view, double2 pixel) {
    const double4x4 clip(view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y)));
    const double2 ndc = pixel / double2(view.size) * 2.0 - 1.0;
    return glm::normalize(double3x3(view.camera.worldFromView) * double3(ndc.x / clip[0][0], ndc.y / clip[1][1], -1));
}

/// Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle".
double solidAngle(double3 a, double3 b, double3 c) {
    return 2 *
           std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

double solidAngleOf(View const& view, uint32_t x, uint32_t y) {
    const double2 at(x, y);
    const double3 a = directionAt(view, at), b = directionAt(view, at + double2(1, 0)),
                  c = directionAt(view, at + double2(1, 1)), d = directionAt(view, at + double2(0, 1));
    return solidAngle(a, b, c) + solidAngle(a, c, d);
}

/// A sun at a point on screen, whose disc has a pre-exposed luminance.
SunLight sunAt(View const& view, double2 pixel, double radiusDegrees, double luminance) {
    const double sine = std::sin(radiansOf(radiusDegrees));
    const double lux = luminance * kDiscPi * sine * sine / static_cast<double>(view.camera.exposure.factor());
    return { .directionWorld = -float3(directionAt(view, pixel)),
             .illuminance = Lux{ static_cast<float>(lux) },
             .angularRadiusDegrees = static_cast<float>(radiusDegrees),
             .showsDisc = true,
             .haloSize = 1 };
}

/// What a surface facing the sun receives from the image, pre-exposed.
double illuminanceOf(Image const& image, View const& view, double3 towardsSun) {
    double sum = 0;
    for (uint32_t y = 0; y < view.size.y; ++y) {
        for (uint32_t x = 0; x < view.size.x; ++x) {
            const double cosine = glm::dot(directionAt(view, double2(x + 0.5, y + 0.5)), towardsSun);
            sum += static_cast<double>(test::halfPixel(image, x, y).x) * solidAngleOf(view, x, y) * cosine;
        }
    }
    return sum;
}

class SunDiscs : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, SunDiscs, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

struct DiscCase {
    double radius, fov, luminance;
};

// From a hundredth of a pixel to most of the image; anywhere in it, and anywhere in a pixel.
TEST_P(SunDiscs, GiveTheIlluminanceOfTheSun) {
    DiscStage stage(GetParam());
    Random random(3);
    for (const DiscCase disc :
         { DiscCase{ 0.001, 40, 60'000 }, DiscCase{ 0.01, 40, 60'000 }, DiscCase{ 0.01, 1, 9'000 },
           DiscCase{ 0.2665, 40, 9'000 }, DiscCase{ 0.2665, 3, 500 }, DiscCase{ 1, 60, 900 }, DiscCase{ 3, 60, 100 },
           DiscCase{ 20, 100, 10 }, DiscCase{ 0.2665, 120, 9'000 }, DiscCase{ 0.05, 0.2, 7 } }) {
        const View view = skyView(disc.fov);
        // The image must hold all of it; its edges are the furthest from the axis.
        const double margin = disc.radius >= 20 ? 22 : 0.55 * disc.radius / disc.fov * view.size.y * 2 + 2;
        for (int i = 0; i < 8; ++i) {
            double2 pixel(random.within(margin, view.size.x - margin), random.within(margin, view.size.y - margin));
            if (i == 0) pixel = double2(view.size) * 0.5;                   // a corner
            if (i == 1) pixel = glm::floor(double2(view.size) * 0.5) + 0.5; // a pixel's middle
            const SunLight sun = sunAt(view, pixel, disc.radius, disc.luminance);
            const Image image = stage.drawSun(sun, view);
            const double sum = illuminanceOf(image, view, directionAt(view, pixel));
            const double lux = static_cast<double>(sun.illuminance.value * view.camera.exposure.factor());
            // Half floats round; and pixels are taken as flat, with the cosine of their middle.
            const double pixelRadians = 2 * std::tan(radiansOf(disc.fov / 2)) / view.size.y;
            EXPECT_NEAR(sum / lux, 1, 1e-3 + 1.2 * pixelRadians * pixelRadians)
                    << disc.radius << " degrees of " << disc.fov << " at " << pixel.x << ' ' << pixel.y;
        }
    }
}

// By 32 x 32 points of each pixel.
TEST_P(SunDiscs, CoverEachPixelAsFarAsTheyReachIntoIt) {
    DiscStage stage(GetParam());
    Random random(17);
    constexpr int kPoints = 32;
    for (const double radius : { 0.3, 0.8, 2.0, 7.0 }) {
        const View view = skyView(50, { 24, 18 });
        for (int i = 0; i < 4; ++i) {
            const double2 pixel(random.within(-1, 25), random.within(-1, 19));
            const Image image = stage.drawSun(sunAt(view, pixel, radius, 100), view);
            const double3 sun = directionAt(view, pixel);
            size_t partly = 0;
            for (uint32_t p = 0; p < 24 * 18; ++p) {
                int covered = 0;
                for (int k = 0; k < kPoints * kPoints; ++k) {
                    const double2 at(p % 24 + (k % kPoints + 0.5) / kPoints, p / 24 + (k / kPoints + 0.5) / kPoints);
                    covered += glm::length(glm::cross(directionAt(view, at), sun)) < std::sin(radiansOf(radius)) &&
                               glm::dot(directionAt(view, at), sun) > 0;
                }
                const double share = static_cast<double>(covered) / (kPoints * kPoints);
                partly += share > 0 && share < 1;
                EXPECT_NEAR(static_cast<double>(test::halfPixel(image, p % 24, p / 24).x) / 100, share, 0.012)
                        << radius << " degrees, pixel " << p;
            }
            EXPECT_GT(partly, 0u);
        }
    }
}

TEST_P(SunDiscs, FadeIntoTheirHalo) {
    DiscStage stage(GetParam());
    for (const auto& [radius, size, falloff] :
         { std::array{ 0.5, 10.0, 80.0 }, std::array{ 2.0, 8.0, 3.0 }, std::array{ 1.0, 15.0, 0.0 },
           std::array{ 4.0, 3.0, 1.0 }, std::array{ 20.0, 1000.0, 2.0 } }) {
        const View view = skyView(70, { 96, 72 });
        const double2 pixel(45.3, 33.8);
        SunLight sun = sunAt(view, pixel, radius, 1000);
        sun.color = { 1, 0.5f, 0.25f };
        sun.haloSize = static_cast<float>(size);
        sun.haloFalloff = static_cast<float>(falloff);
        const Image image = stage.drawSun(sun, view);
        const double3 towards = directionAt(view, pixel);
        const double inner = std::cos(radiansOf(radius)), outer = std::cos(std::min(radiansOf(radius * size), kDiscPi));
        double sum = 0;
        for (uint32_t y = 0; y < view.size.y; ++y) {
            for (uint32_t x = 0; x < view.size.x; ++x) {
                const double cosine = glm::dot(directionAt(view, double2(x + 0.5, y + 0.5)), towards);
                const double3 shown(test::halfPixel(image, x, y));
                if (cosine < inner) sum += shown.x * solidAngleOf(view, x, y);
                // Away from the disc's edge and from the halo's.
                const double angle = std::acos(cosine) * 180 / kDiscPi;
                if (std::abs(angle - radius) < 1 || std::abs(angle - radius * size) < 0.01) continue;
                double share = angle < radius ? 1 : 0;
                if (angle > radius && cosine > outer) share = std::pow((cosine - outer) / (inner - outer), falloff);
                EXPECT_NEAR(shown.x, 1000 * share, 1000 * share * 2e-3 + 1e-4) << radius << ' ' << angle;
                EXPECT_NEAR(shown.z, 250 * share, 250 * share * 2e-3 + 1e-4);
            }
        }
        // The integral of the formula, where all of the halo is in the image and pixels resolve it.
        if (radius * size > 20 || falloff > 10) continue;
        EXPECT_NEAR(sum, 1000 * 2 * kDiscPi * (inner - outer) / (falloff + 1), 0.03 * sum) << radius;
    }
}

std::string explained(DiscStage const& stage) { return stage.renderer.explain(); }

TEST_P(SunDiscs, OutOfViewOrSwitchedOffAreNotDrawn) {
    DiscStage stage(GetParam());
    const View view = skyView(60);
    Scene none(stage.engine);
    stage.square.add(none, stage.black, { 3.2, -2, 4 }, 0.3);
    Image expected;
    const backend::CapturedFrame without = stage.drawCaptured(none, view, expected);
    EXPECT_NE(explained(stage).find("sun disc              not needed                        none in the scene"),
              std::string::npos)
            << explained(stage);
    const auto expectNothing = [&](SunLight const& sun, const char* why) {
        Scene scene(stage.engine);
        stage.square.add(scene, stage.black, { 3.2, -2, 4 }, 0.3);
        scene.add(sun);
        Image image;
        const backend::CapturedFrame frame = stage.drawCaptured(scene, view, image);
        EXPECT_EQ(image.pixels, expected.pixels) << why;
        ASSERT_EQ(frame.draws.size(), without.draws.size()) << why;
        for (size_t i = 0; i < frame.draws.size(); ++i) {
            EXPECT_EQ(frame.draws[i].pipeline, without.draws[i].pipeline);
            EXPECT_EQ(frame.draws[i].position, without.draws[i].position) << why;
        }
        EXPECT_NE(explained(stage).find(why), std::string::npos) << explained(stage);
    };
    SunLight sun = sunAt(view, { 20, 20 }, 2, 100);
    sun.showsDisc = false;
    expectNothing(sun, "none in the scene");
    sun.showsDisc = true;
    sun.lightChannels = 0;
    expectNothing(sun, "none in the scene");
    sun.lightChannels = 1;
    sun.illuminance = Lux{ 0 };
    expectNothing(sun, "none in the scene");
    sun = sunAt(view, { 20, 20 }, 2, 100);
    sun.directionWorld = -sun.directionWorld; // behind the camera
    expectNothing(sun, "none of 1 is in view");
    for (const double2 beside : { double2(-20, 24), double2(90, 24), double2(32, -25), double2(32, 75) })
        expectNothing(sunAt(view, beside, 2, 100), "none of 1 is in view");
}

// Also where only a part of the disc or of the halo is in the image.
TEST_P(SunDiscs, AreDrawnWhereAnyPartOfThemIsInView) {
    DiscStage stage(GetParam());
    const View view = skyView(60);
    for (const double2 pixel :
         { double2(-1, 24), double2(65, 24), double2(32, -1), double2(32, 49), double2(-1, -1) }) {
        const Image image = stage.drawSun(sunAt(view, pixel, 4, 100), view);
        EXPECT_GT(test::extremesOf(image).most, 99.0f) << pixel.x;
        EXPECT_NE(explained(stage).find("1 of 1 in view"), std::string::npos);
    }
    SunLight aside = sunAt(view, { -10, 24 }, 2, 100);
    EXPECT_EQ(test::extremesOf(stage.drawSun(aside, view)).most, 0.0f);
    aside.haloSize = 10;
    aside.haloFalloff = 1;
    EXPECT_GT(test::extremesOf(stage.drawSun(aside, view)).most, 10.0f);
    SunLight behind = sunAt(view, { 32, 24 }, 10, 100); // a halo around all of the sky
    behind.directionWorld = -behind.directionWorld;
    behind.haloSize = 1000;
    behind.haloFalloff = 0;
    EXPECT_NEAR(test::extremesOf(stage.drawSun(behind, view)).least, 100.0f, 0.1f);
}

TEST_P(SunDiscs, LieBehindEverythingAndAddToTheBackground) {
    DiscStage stage(GetParam());
    View view = skyView(60);
    view.clearColor = { 0.5f, 1, 2, 1 };
    Scene scene(stage.engine);
    stage.square.add(scene, stage.black, { 3.2, -2, 4 }, 0.3);
    const Image plain = stage.draw(scene, view);
    const double2 pixel(33.4, 24.2);
    scene.add(sunAt(view, pixel, 20, 100));
    const Image shown = stage.draw(scene, view);
    size_t hidden = 0, added = 0;
    for (uint32_t i = 0; i < 64 * 48; ++i) {
        const float4 before = test::halfPixel(plain, i % 64, i / 64), after = test::halfPixel(shown, i % 64, i / 64);
        if (before.y == 0.5f) {
            ++hidden;
            EXPECT_EQ(before, after) << "a surface";
        } else if (glm::dot(directionAt(view, double2(i % 64 + 0.5, i / 64 + 0.5)), directionAt(view, pixel)) >
                   std::cos(radiansOf(18))) {
            ++added;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c] + 100, 0.07f);
            EXPECT_EQ(after.w, 1.0f);
        }
    }
    EXPECT_GT(hidden, 50u);
    EXPECT_GT(added, 150u);
    scene.add(sunAt(view, pixel, 20, 300)); // two of them; 300 of 65504 of what is behind gives way
    EXPECT_NEAR(test::halfPixel(stage.draw(scene, view), 20, 24).z, 300 + 102 * (1 - 300.0f / 65504), 0.5f);
    EXPECT_NE(explained(stage).find("2 of 2 in view"), std::string::npos);
}

// Above what half floats hold; over backgrounds that are as bright themselves.
TEST_P(SunDiscs, AreNoBrighterThanAHalfFloatHolds) {
    DiscStage stage(GetParam());
    for (const float sky : { 0.0f, 100.0f, 65'504.0f }) {
        View view = skyView(30);
        view.clearColor = { sky, sky, sky, 1 };
        for (const float lux : { 1e5f, 1e9f, std::numeric_limits<float>::max() }) {
            for (const float degrees : { 0.0f, 0.01f, 3.0f }) {
                const Image image = stage.drawSun({ .directionWorld = { 0, 0, 1 },
                                                    .illuminance = Lux{ lux },
                                                    .angularRadiusDegrees = degrees,
                                                    .showsDisc = true },
                                                  view);
                const test::Extremes extremes = test::extremesOf(image); // expects finite numbers
                EXPECT_LE(extremes.most, 65504.0f);
                if (lux > 1e8f) {
                    EXPECT_EQ(extremes.most, static_cast<float>(kLargestHalf)) << degrees;
                }
            }
        }
    }
}

TEST(SunDiscsOfBothApis, HaveTheSameBits) {
    DiscStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    Random random(11);
    size_t lit = 0;
    for (int i = 0; i < 60; ++i) {
        View view = skyView(std::exp(random.within(std::log(0.02), std::log(170))), { 17 + random.next() % 40, 13 });
        if (i % 3 == 0) view.samples = 4;
        if (i % 4 == 0) view.quality.depthRange = DepthRange::Ordinary;
        const double2 pixel(random.within(-5, view.size.x + 5), random.within(-5, view.size.y + 5));
        SunLight sun = sunAt(view, pixel, std::exp(random.within(std::log(1e-3), std::log(20))), 50);
        if (i % 2) sun.haloSize = static_cast<float>(random.within(1, 20));
        sun.haloFalloff = static_cast<float>(random.within(0, 80));
        const Image one = vulkan.drawSun(sun, view);
        EXPECT_EQ(one.pixels, gles.drawSun(sun, view).pixels) << i;
        lit += test::extremesOf(one).most > 0;
    }
    EXPECT_GT(lit, 40u);
}

} // namespace
} // namespace filament_core
