// SPDX-License-Identifier: Apache-2.0
// Light cookies in images: each pixel of a wall shows the texel of its direction or place, a white cookie is a plain
// light, and unneeded images do not exist.
#include "shaders/interface/ShaderInterface.h"
#include "tests/filament_core/engine/NullFrame.h"
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <filament_core/LightImage.h>

#include <gmock/gmock.h>

#include <cstring>
#include <limits>

namespace filament_core {
namespace {

using test::Patch;
using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Linear colours, rows from the top.
struct Picture {
    uint32_t width, height;
    std::vector<float4> colors;
};

Picture checker(uint32_t width, uint32_t height) {
    Picture picture{ width, height, {} };
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const float part = static_cast<float>(x + y * width) / static_cast<float>(width * height);
            picture.colors.push_back((x + y) % 2 == 0 ? float4(1, part, 0.25f, 1) : float4(0.125f, 0, part, 1));
        }
    }
    return picture;
}

LightImage cookieOf(Engine& engine, Picture const& picture, LightImageShape shape) {
    const Result<LightImage> image = engine.create(LightImageDesc{ .width = picture.width,
                                                                   .height = picture.height,
                                                                   .format = Format::RGBA32F,
                                                                   .pixels = std::as_bytes(std::span(picture.colors)),
                                                                   .shape = shape,
                                                                   .name = "gobo" });
    if (!image) ADD_FAILURE() << image.error().message;
    return image ? *image : LightImage{};
}

class LightCookies : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
    }
    void TearDown() override { test::expectNoErrors(*engine); }

    Owned<LightImage> cookie(Picture const& picture, LightImageShape shape) {
        return engine->own(cookieOf(*engine, picture, shape));
    }
    Owned<LightImage> uniform(float4 color, LightImageShape shape) { return cookie({ 1, 1, { color } }, shape); }

    decltype(test::makeEngine(Backend::Vulkan)) engine{};
};
INSTANTIATE_TEST_SUITE_P(Apis, LightCookies, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

constexpr uint32_t kPixels = 48;

/// A white wall of z = 0 whose pixels are points of a square of 2 * kHalf metres around the origin.
struct ImageWall {
    static constexpr double kHalf = 0.17454; // 40 m away, half a degree

    explicit ImageWall(Engine& engine) : patch(engine) {
        patch.view.size = { kPixels, kPixels };
        patch.setSurface(float4(1), 0, 1);
    }
    static double3 pointAt(uint32_t x, uint32_t y) {
        const auto at = [](uint32_t i) { return ((i + 0.5) / kPixels * 2 - 1) * kHalf; };
        return { at(x), -at(y), 0 };
    }
    template <class L>
    Image with(L const& light) {
        const Light added = patch.scene.add(light);
        const Image image = patch.render();
        patch.scene.remove(added);
        return image;
    }
    float exposed(float radiance) const { return radiance / patch.view.camera.exposure.factor(); }

    Patch patch;
};

float3 rgb(Image const& image, uint32_t x, uint32_t y) { return float3(test::halfPixel(image, x, y)); }

/// Between four texels. Beyond an edge lies the same edge, the other side, or the same edge from its other end.
float3 between(Picture const& picture, double2 place, LightImageShape shape) {
    const double2 at = place * double2(picture.width, picture.height) - 0.5, whole = glm::floor(at), part = at - whole;
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    double3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const double2 step(i & 1, i >> 1), share = glm::mix(1.0 - part, part, step);
        const int column = static_cast<int>(whole.x + step.x), row = static_cast<int>(whole.y + step.y);
        int x = std::clamp(column, 0, width - 1), y = std::clamp(row, 0, height - 1);
        if (shape == LightImageShape::Tiled) x = (column + width) % width, y = (row + height) % height;
        const bool isRound = shape == LightImageShape::Octahedron;
        const bool beyondX = isRound && x != column, beyondY = isRound && y != row;
        if (beyondX) y = height - 1 - y;
        if (beyondY) x = width - 1 - x;
        sum += double3(picture.colors[static_cast<size_t>(y * width + x)]) * (share.x * share.y);
    }
    return float3(sum);
}

void expectNear(float3 seen, float3 expected, const char* what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 1e-3f * expected[c]) << what << ' ' << c;
}

/// Within a unit of half floats: the shares of four texels add up to 1 except for rounding.
void expectSame(Image const& seen, Image const& expected) {
    for (uint32_t i = 0; i < kPixels * kPixels; ++i)
        expectNear(rgb(seen, i % kPixels, i / kPixels), rgb(expected, i % kPixels, i / kPixels), "pixel");
}

void expectShares(Image const& seen, Image const& plain, auto const& shareOf, const char* name) {
    for (uint32_t y = 0; y < kPixels; ++y) {
        for (uint32_t x = 0; x < kPixels; ++x) {
            const float3 share = rgb(seen, x, y) / rgb(plain, x, y), expected = shareOf(ImageWall::pointAt(x, y));
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(share[c], expected[c], 0.012f) << name << ' ' << x << ' ' << y << ' ' << c;
        }
    }
}

TEST_P(LightCookies, AWhiteCookieIsAPlainLight) {
    const Owned<LightImage> round = uniform(float4(1), LightImageShape::Octahedron);
    const Owned<LightImage> slide = uniform(float4(1), LightImageShape::Projected);
    const Owned<LightImage> tile = uniform(float4(1), LightImageShape::Tiled);
    ImageWall wall(*engine);
    PointLight point{ .positionWorld = { 0.03, 0.02, 0.3 }, .intensity = Candela{ wall.exposed(0.1f) } };
    SpotLight spot{ .positionWorld = point.positionWorld,
                    .directionWorld = { 0.1f, 0, -1 },
                    .intensity = point.intensity,
                    .outerConeRadians = 0.4f };
    SunLight sun{ .directionWorld = { 0.2f, 0.4f, -1 }, .illuminance = Lux{ wall.exposed(1) } };
    const Image plainPoint = wall.with(point), plainSpot = wall.with(spot), plainSun = wall.with(sun);
    point.cookie = round, spot.cookie = slide, sun.cookie = tile;
    expectSame(wall.with(point), plainPoint);
    expectSame(wall.with(spot), plainSpot);
    expectSame(wall.with(sun), plainSun);
    EXPECT_GT(rgb(plainPoint, 24, 24).x, 0.01f);
    EXPECT_GT(rgb(plainSpot, 24, 24).x, 0.01f);
    EXPECT_GT(rgb(plainSun, 24, 24).x, 0.01f);
}

// The projection of a slide: places are tangents over that of the cone.
TEST_P(LightCookies, EveryPixelUnderASpotShowsTheTexelOfItsDirection) {
    for (const uint2 size : { uint2(4, 4), uint2(6, 3), uint2(2, 5) }) {
        const Picture picture = checker(size.x, size.y);
        const Owned<LightImage> image = cookie(picture, LightImageShape::Projected);
        for (const float3 up : { float3(0, 1, 0), float3(1, 0.5f, 0.2f) }) {
            ImageWall wall(*engine);
            const double height = 0.4;
            SpotLight light{ .positionWorld = { 0.02, -0.01, height },
                             .directionWorld = { 0, 0, -2 },
                             .intensity = Candela{ wall.exposed(0.1f) },
                             .innerConeRadians = 0.7f,
                             .outerConeRadians = 0.71f,
                             .upWorld = up };
            const Image plain = wall.with(light);
            light.cookie = image;
            const Image seen = wall.with(light);
            const double3 right = glm::normalize(glm::cross(double3(0, 0, -1), double3(up)));
            const double3 down = glm::cross(double3(0, 0, -1), right);
            const double aspect = double(size.y) / size.x;
            const double2 half = std::tan(0.71) * double2(std::max(1 / aspect, 1.0), std::max(aspect, 1.0));
            expectShares(
                    seen, plain,
                    [&](double3 point) {
                        const double3 away = point - light.positionWorld;
                        const double2 at(glm::dot(away, right) / height, glm::dot(away, down) / height);
                        return between(picture, at / half * 0.5 + 0.5, LightImageShape::Projected);
                    },
                    "spot");
        }
    }
}

TEST_P(LightCookies, EveryPixelUnderASunShowsTheTexelOfItsPlaceInTheWorld) {
    const Picture picture = checker(4, 2);
    const Owned<LightImage> image = cookie(picture, LightImageShape::Tiled);
    for (const bool isListed : { false, true }) {
        ImageWall wall(*engine);
        if (isListed) // the brightest is in the uniforms: it shines from behind
            wall.patch.scene.add(SunLight{ .directionWorld = { 0, 0, 1 }, .illuminance = Lux{ wall.exposed(50) } });
        SunLight light{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ wall.exposed(1) } };
        const Image plain = wall.with(light);
        light.cookie = image;
        light.cookieMeters = 0.2f, light.cookieOffsetMeters = { 0.03f, 0.01f };
        expectShares(
                wall.with(light), plain,
                [&](double3 point) {
                    const double2 at((point.x - 0.03) / 0.2, (-point.y - 0.01) / 0.1);
                    return between(picture, at - glm::floor(at), LightImageShape::Tiled);
                },
                isListed ? "listed" : "uniform");
    }
}

// The octahedral map around the direction: in the half in front x / s, y / s of s = |x| + |y| + |z|.
TEST_P(LightCookies, EveryPixelAroundAPointShowsTheTexelOfItsDirection) {
    const Picture picture = checker(8, 8);
    const Owned<LightImage> image = cookie(picture, LightImageShape::Octahedron);
    for (const bool isBehind : { false, true }) {
        ImageWall wall(*engine);
        PointLight light{ .positionWorld = { 0, 0, 0.2 }, .intensity = Candela{ wall.exposed(0.1f) } };
        const Image plain = wall.with(light);
        light.cookie = image;
        light.directionWorld = { 0, 0, isBehind ? 1.0f : -1.0f };
        expectShares(
                wall.with(light), plain,
                [&](double3 point) {
                    const double3 away = point - light.positionWorld;
                    const double sum = std::abs(away.x) + std::abs(away.y) + std::abs(away.z);
                    double2 at(isBehind ? -away.x : away.x, -away.y);
                    at /= sum;
                    if (isBehind)
                        at = { std::copysign(1 - std::abs(at.y), at.x),
                               std::copysign(1 - std::abs(-away.x / sum), at.y) };
                    return between(picture, at * 0.5 + 0.5, LightImageShape::Octahedron);
                },
                isBehind ? "behind" : "in front");
    }
}

TEST_P(LightCookies, ACubeShowsTheFaceThatTheRayMeets) {
    Picture faces{ 24, 4, std::vector<float4>(96) };
    const std::array<float3, 6> colors{ float3(1, 0, 0), float3(0, 1, 0), float3(0, 0, 1),
                                        float3(1, 1, 0), float3(0, 1, 1), float3(1, 0, 1) };
    for (size_t i = 0; i < 96; ++i) faces.colors[i] = float4(colors[i % 24 / 4], 1);
    const Owned<LightImage> image = cookie(faces, LightImageShape::Cube);
    EXPECT_EQ(engine->describe(image).width, 8u) << "an octahedron";
    ImageWall wall(*engine);
    // The frame: -Z along the direction, +X along cross(direction, up).
    const struct {
        float3 direction, up;
        size_t face; ///< that shines towards -z of the world
    } cases[] = { { { 0, 0, -1 }, { 0, 1, 0 }, 5 }, { { 0, 0, 1 }, { 0, 1, 0 }, 4 }, { { 0, 1, 0 }, { 0, 0, 1 }, 3 },
                  { { 0, 1, 0 }, { 0, 0, -1 }, 2 }, { { 0, 1, 0 }, { 1, 0, 0 }, 0 }, { { 0, 1, 0 }, { -1, 0, 0 }, 1 } };
    for (auto const& one : cases) {
        PointLight light{ .positionWorld = { 0, 0, 0.4 }, .intensity = Candela{ wall.exposed(0.1f) } };
        const float3 plain = rgb(wall.with(light), 24, 24);
        light.cookie = image, light.directionWorld = one.direction, light.upWorld = one.up;
        const float3 share = rgb(wall.with(light), 24, 24) / plain;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], colors[one.face][c], 0.01f) << one.face << ' ' << c;
    }
}

TEST_P(LightCookies, ANodeTurnsTheCookieOfItsLight) {
    const Picture picture = checker(4, 4);
    const Owned<LightImage> image = cookie(picture, LightImageShape::Projected);
    ImageWall wall(*engine);
    SpotLight light{ .positionWorld = { 0, 0, 0.4 },
                     .directionWorld = { 0, 0, -1 },
                     .intensity = Candela{ wall.exposed(0.1f) },
                     .cookie = image,
                     .upWorld = { 1, 0, 0 } };
    const Image turned = wall.with(light);
    light.upWorld = { 0, 1, 0 };
    const Image upright = wall.with(light);
    double4x4 quarter(1.0); // +Y becomes +X
    quarter[0] = { 0, -1, 0, 0 }, quarter[1] = { 1, 0, 0, 0 };
    const Node node = wall.patch.scene.add(NodeDesc{ .parentFromNode = quarter });
    const Light attached = wall.patch.scene.add(light, node);
    const Image byNode = wall.patch.render();
    wall.patch.scene.remove(attached);
    EXPECT_NE(upright.pixels, turned.pixels);
    for (uint32_t i = 0; i < kPixels; ++i) {
        const float3 a = rgb(byNode, i, 20), b = rgb(turned, i, 20);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-3f) << i;
    }
}

// From far away a pixel covers many texels: the mean of the image, and no texel of it.
TEST_P(LightCookies, WhatIsSmallerThanAPixelIsItsMean) {
    Picture picture{ 64, 64, {} };
    for (uint32_t i = 0; i < 64 * 64; ++i) picture.colors.push_back(float4(float3((i + i / 64) % 2 == 0 ? 1 : 0), 1));
    const Owned<LightImage> image = cookie(picture, LightImageShape::Tiled);
    EXPECT_NEAR(engine->describe(image).mean.x, 0.5f, 1e-6f);
    ImageWall wall(*engine);
    SunLight light{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ wall.exposed(1) } };
    const Image plain = wall.with(light);
    light.cookie = image, light.cookieMeters = 0.007f; // a pixel is as wide
    expectShares(
            wall.with(light), plain, [](double3) { return float3(0.5f); }, "mean");
}

TEST_P(LightCookies, HardCasesAreNumbers) {
    ImageWall wall(*engine);
    const auto spot = [&](Picture const& picture, float outer = 0.7f, float3 direction = { 0, 0, -1 }) {
        const Owned<LightImage> image = cookie(picture, LightImageShape::Projected);
        return wall.with(SpotLight{ .positionWorld = { 0, 0, 0.3 },
                                    .directionWorld = direction,
                                    .intensity = Candela{ wall.exposed(0.1f) },
                                    .innerConeRadians = outer * 0.9f,
                                    .outerConeRadians = outer,
                                    .cookie = image });
    };
    const auto middle = [](Image const& image) { return rgb(image, 23, 23); };
    const float3 plain = middle(spot({ 1, 1, { float4(1) } }));
    expectNear(middle(spot({ 1, 1, { float4(0.5f, 0.25f, 0, 1) } })), plain * float3(0.5f, 0.25f, 0), "one texel");
    EXPECT_EQ(middle(spot({ 2, 2, std::vector<float4>(4, float4(0)) })), float3(0)) << "black";
    EXPECT_EQ(middle(spot({ 2, 2, std::vector<float4>(4, float4(kNaN)) })), float3(0)) << "no number";
    EXPECT_EQ(middle(spot({ 2, 2, std::vector<float4>(4, float4(-1)) })), float3(0)) << "negative";
    const Picture large{ 4096, 4, std::vector<float4>(4096 * 4, float4(1)) };
    expectNear(middle(spot(large)), plain, "4096 texels");
    EXPECT_GT(middle(spot({ 1, 1, { float4(1) } }, 1.5707f)).x, 0.5f * plain.x) << "a cone of nearly 180 degrees";
    EXPECT_EQ(middle(spot({ 1, 1, { float4(1) } }, 0.7f, { 0, 0, 1 })), float3(0)) << "behind the light";
    const Owned<LightImage> image = uniform(float4(1), LightImageShape::Octahedron);
    for (float3 const& at : { float3(0), float3(0, 0, 1e-20f) }) {
        const Image touching = wall.with(PointLight{ .positionWorld = at, .intensity = Candela{ 1 }, .cookie = image });
        for (uint32_t i = 0; i < kPixels; ++i) EXPECT_TRUE(std::isfinite(rgb(touching, i, 24).x)) << i;
    }
}

// ---- what is not needed

/// A patch under one plain light, and `count` with a cookie or without.
test::NullFrame cookieFrame(PointLight other, bool hasCookie, uint32_t count = 1) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0, .hashFrames = true });
    if (!engine) {
        ADD_FAILURE() << engine.error().message;
        return {};
    }
    Patch patch(*engine);
    const Owned<LightImage> image = engine->own(cookieOf(*engine, checker(4, 4), LightImageShape::Octahedron));
    patch.scene.add(PointLight{ .positionWorld = { 0, 0, 1 } });
    if (hasCookie) other.cookie = image;
    for (uint32_t i = 0; i < count; ++i) patch.scene.add(other);
    return test::nullFrame(*engine, patch.scene, patch.view);
}

TEST(LightCookieDemand, ACookieThatNoLitSurfaceSeesChangesNoCommand) {
    const PointLight far{ .positionWorld = { 500, 0, 0 }, .rangeMeters = 1 };
    const PointLight ofOthers{ .positionWorld = { 0, 0, 1 }, .lightChannels = 0b10 };
    const PointLight dark{ .positionWorld = { 0, 0, 1 }, .intensity = Candela{ 0 } };
    for (PointLight const& light : { far, ofOthers, dark }) {
        const test::NullFrame with = cookieFrame(light, true), without = cookieFrame(light, false);
        EXPECT_NE(with.stream, 0u);
        EXPECT_EQ(with.stream, without.stream);
        EXPECT_THAT(with.explanation, HasSubstr("light images          not needed"));
    }
    const PointLight near{ .positionWorld = { 0, 0, 1 } };
    const test::NullFrame with = cookieFrame(near, true);
    EXPECT_NE(with.stream, cookieFrame(near, false).stream);
    EXPECT_THAT(with.explanation, HasSubstr("light images          needed"));
}

TEST(LightCookieDemand, LightsBeyondTheLimitStayDarkAndAreCounted) {
    const PointLight near{ .positionWorld = { 0, 0, 1 } };
    EXPECT_THAT(cookieFrame(near, true, shader::kMaxImagedLights + 3).explanation, HasSubstr("3 of them are dark"));
}

TEST(LightCookieFiles, ThatDoNotFitTheirShapeAreErrorsWithTheirName) {
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const std::vector<float4> pixels(24, float4(1));
    const auto messageOf = [&](uint32_t width, uint32_t height, LightImageShape shape) {
        const Result<LightImage> image = engine->create(LightImageDesc{ .width = width,
                                                                        .height = height,
                                                                        .format = Format::RGBA32F,
                                                                        .pixels = std::as_bytes(std::span(pixels)),
                                                                        .shape = shape,
                                                                        .name = "sky.png" });
        return image ? std::string("none") : image.error().message;
    };
    EXPECT_THAT(messageOf(4, 2, LightImageShape::Octahedron), HasSubstr("sky.png: 4 x 2 pixels; an octahedral map is"));
    EXPECT_THAT(messageOf(4, 2, LightImageShape::Cube), HasSubstr("one side is six times the other"));
    const Result<LightImage> missing = loadLightImage(*engine, "no/such/gobo.png");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
}

TEST(LightCookiesDeathTest, WrongShapesAreAssertions) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    const Owned<LightImage> tile = engine->own(cookieOf(*engine, checker(2, 2), LightImageShape::Tiled));
    EXPECT_DEATH(scene.add(SpotLight{ .cookie = tile }), "the cookie of a spot is projected");
    EXPECT_DEATH(scene.add(PointLight{ .cookie = tile }), "an octahedron or a cube");
    EXPECT_DEATH(scene.add(SunLight{ .cookie = tile, .cookieMeters = 0 }), "metres wide");
}

} // namespace
} // namespace filament_core
