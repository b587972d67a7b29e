// SPDX-License-Identifier: Apache-2.0
// DebugDraw in images: which pixels lines and characters cover, what hides them, in which colour, on both APIs.
#include "filament_core/prepare/DebugFont.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <limits>

namespace filament_core {
namespace {

using prepare::Random;

constexpr uint2 kDebugSize(64, 48);
constexpr float4 kRed{ 1, 0, 0, 1 };

constexpr const char* kWall = R"(material { name : wall, shadingModel : unlit, culling : none }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.0, 0.0, 0.25, 1.0); } })";

struct LinesStage : test::SquareStage {
    Scene scene{ engine };
    Renderer renderer{ engine };
    DebugDraw draw;
    View view{ .camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = kDebugSize };

    explicit LinesStage(Backend backend) : SquareStage(backend, kWall) { view.debugDraw = &draw; }

    Image picture() {
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    /// Pixels that are not the background's black.
    static std::vector<uint2> covered(Image const& image) {
        std::vector<uint2> pixels;
        for (uint32_t y = 0; y < image.height; ++y)
            for (uint32_t x = 0; x < image.width; ++x)
                if (float3(test::bytePixel(image, x, y)) != float3(0)) pixels.emplace_back(x, y);
        return pixels;
    }
    double2 pixelOf(double3 world) const {
        const float4x4 clip =
                view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y));
        const double4 at = double4x4(clip) * glm::inverse(view.camera.worldFromView) * double4(world, 1);
        return (double2(at) / at.w + 1.0) * 0.5 * double2(view.size);
    }
};

struct DebugDrawTest : testing::TestWithParam<Backend>, LinesStage {
    DebugDrawTest() : LinesStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, DebugDrawTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(DebugDrawTest, LinesOnTheScreenCoverThePixelsOfTheirRectangles) {
    draw.screenLine({ 3, 5.5f }, { 9, 5.5f }, { .color = kRed });
    draw.screenLine({ 20.5f, 10 }, { 20.5f, 14 }, { .color = { 0, 1, 0, 1 } });
    draw.screenLine({ 40, 21 }, { 44, 21 }, { .color = { 0, 0, 1, 1 }, .widthPixels = 2 });
    const Image image = picture();
    std::vector<uint2> expected;
    for (uint32_t x = 3; x < 9; ++x) expected.emplace_back(x, 5);
    for (uint32_t y = 10; y < 14; ++y) expected.emplace_back(20, y);
    for (uint32_t y = 20; y < 22; ++y)
        for (uint32_t x = 40; x < 44; ++x) expected.emplace_back(x, y);
    EXPECT_THAT(covered(image), testing::UnorderedElementsAreArray(expected));
    EXPECT_EQ(test::bytePixel(image, 4, 5), kRed);
    EXPECT_EQ(test::bytePixel(image, 20, 12), float4(0, 1, 0, 1));
}

TEST_P(DebugDrawTest, CharactersCoverThePixelsOfTheirGlyphs) {
    std::string all;
    for (char c = 33; c < 127; ++c) all += c;
    view.size = { 94 * prepare::kCellWidth + 8, 40 };
    draw.screenText({ 3, 2 }, all + "\n\x01", { .color = kRed, .pixels = 1 });
    draw.screenText({ 20.4f, 22.6f }, "A", { .color = kRed, .pixels = 2 });
    const Image image = picture();
    const auto isSet = [](char c, uint32_t x, uint32_t y) {
        return x < prepare::kGlyphWidth && y < prepare::kGlyphHeight &&
               (prepare::glyphOf(c)[y] >> (prepare::kGlyphWidth - 1 - x) & 1) != 0;
    };
    size_t wrong = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            bool expected = false;
            if (y >= 2 && x >= 3) {
                const uint32_t row = (y - 2) / prepare::kCellHeight, column = (x - 3) / prepare::kCellWidth;
                const uint32_t inX = (x - 3) % prepare::kCellWidth, inY = (y - 2) % prepare::kCellHeight;
                if (row == 0 && column < all.size()) expected = isSet(all[column], inX, inY);
                if (row == 1 && column == 0) expected = isSet('\x01', inX, inY);
            }
            if (x >= 20 && x < 30 && y >= 23 && y < 37) expected = isSet('A', (x - 20) / 2, (y - 23) / 2);
            wrong += expected != (test::bytePixel(image, x, y).x > 0);
        }
    }
    EXPECT_EQ(wrong, 0u);
}

TEST_P(DebugDrawTest, SurfacesHideWhatIsTestedBehindThemAndNothingElse) {
    square.add(scene, instance, { 0, 0, 0 }, 0.8);
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
            view.samples = samples;
            view.quality.depthRange = range;
            const auto shown = [&](double z, DebugDepth depth) {
                draw.clear();
                draw.line({ -0.5, 0.03, z }, { 0.5, 0.03, z }, { .color = kRed, .widthPixels = 3, .depth = depth });
                const double2 at = pixelOf({ 0, 0.03, z });
                return test::bytePixel(picture(), static_cast<uint32_t>(at.x), static_cast<uint32_t>(at.y)) == kRed;
            };
            EXPECT_FALSE(shown(-0.5, DebugDepth::Tested)) << int{ samples };
            EXPECT_TRUE(shown(0.5, DebugDepth::Tested));
            EXPECT_TRUE(shown(0, DebugDepth::Tested)) << "in the surface";
            EXPECT_TRUE(shown(-0.5, DebugDepth::Through));
        }
    }
    draw.clear();
    draw.text({ 0, 0.2, -1 }, "W", { .color = kRed, .depth = DebugDepth::Tested });
    EXPECT_EQ(test::bytePixel(picture(), 0, 0).x, 0);
    const auto red = [&] {
        const Image image = picture();
        size_t pixels = 0;
        for (uint2 at : covered(image)) pixels += test::bytePixel(image, at.x, at.y) == kRed;
        return pixels;
    };
    EXPECT_EQ(red(), 0u);
    draw.text({ 0, 0.2, -1 }, "W", { .color = kRed });
    EXPECT_GT(red(), 10u);
}

TEST_P(DebugDrawTest, AWorldsLineIsWhereItsPointsAreSeen) {
    Random random(2);
    for (int i = 0; i < 20; ++i) {
        draw.clear();
        double3 from; // in one order with all compilers
        for (int axis = 0; axis < 3; ++axis) from[axis] = axis == 2 ? random.within(-2, 2) : random.within(-1, 1);
        const double3 to = from + double3(0.3, 0.4, -0.5);
        draw.line(from, to, { .color = kRed, .widthPixels = 1.5f });
        const Image image = picture();
        for (const double share : { 0.1, 0.5, 0.9 }) {
            const double2 at = pixelOf(glm::mix(from, to, share));
            if (at.x < 1 || at.y < 1 || at.x >= view.size.x - 1 || at.y >= view.size.y - 1) continue;
            // The middle of the pixel may lie farther along than the point, by up to half of its diagonal.
            if (std::min(glm::distance(at, pixelOf(from)), glm::distance(at, pixelOf(to))) < 0.75) continue;
            EXPECT_EQ(test::bytePixel(image, static_cast<uint32_t>(at.x), static_cast<uint32_t>(at.y)), kRed) << i;
        }
        EXPECT_LT(covered(image).size(), 90u);
    }
}

TEST_P(DebugDrawTest, IsInDisplayColoursWhateverTheExposureAndMixesByItsAlpha) {
    view.display.toneMapper = ToneMapper::Filmic;
    view.effects.autoExposure.enabled = view.effects.vignette.enabled = view.effects.bloom.enabled = true;
    view.clearColor = { 0.5f, 0.5f, 0.5f, 1 };
    const float4 bare = test::bytePixel(picture(), 40, 30);
    draw.screenLine({ 0, 20 }, { 64, 20 }, { .color = { 0.2f, 0.4f, 0.6f, 1 }, .widthPixels = 8 });
    draw.screenLine({ 0, 32 }, { 64, 32 }, { .color = { 1, 0, 0, 0.25f }, .widthPixels = 8 });
    const Image image = picture();
    EXPECT_EQ(test::bytePixel(image, 40, 20), float4(51, 102, 153, 255) / 255.0f);
    const float4 mixed = test::bytePixel(image, 40, 30);
    EXPECT_NEAR(mixed.x, 0.25f + 0.75f * bare.x, 1.01f / 255);
    EXPECT_NEAR(mixed.y, 0.75f * bare.y, 1.01f / 255);
}

TEST_P(DebugDrawTest, CostsNothingWhenEmpty) {
    square.add(scene, instance);
    view.debugDraw = nullptr;
    const Image expected = picture();
    const uint32_t passes = renderer.statistics().passesRun;
    view.debugDraw = &draw;
    EXPECT_EQ(picture().pixels, expected.pixels);
    EXPECT_EQ(renderer.statistics().passesRun, passes);
    EXPECT_THAT(renderer.explain(), testing::Not(testing::HasSubstr("debug draw")));
    draw.screenText({ 1, 1 }, "x");
    EXPECT_NE(picture().pixels, expected.pixels);
    EXPECT_THAT(renderer.explain(), testing::HasSubstr("debug draw"));
    draw.clear();
    EXPECT_EQ(picture().pixels, expected.pixels);
}

TEST_P(DebugDrawTest, WhatIsNotFiniteOrBehindTheCameraIsNotDrawn) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                     kInfinity = std::numeric_limits<double>::infinity();
    draw.line({ kNaN, 0, 0 }, { 1, 0, 0 });
    draw.line({ 0, 0, 0 }, { kInfinity, 0, 0 });
    draw.line({ 0, 0, 5 }, { 1, 0, 6 });
    draw.line({ 0, 0, 4 }, { 0, 0, 4 });
    draw.text({ 0, kNaN, 0 }, "text");
    draw.text({ 0, 0, 9 }, "text");
    draw.screenText({ 1e30f, 4 }, "text");
    draw.screenLine({ -1e30f, 100 }, { 1e30f, 100 });
    draw.screenLine({ 0, 0 }, { 1, 1 }, { .color = { std::nanf(""), 0, 0, 1 } });
    draw.box(Box{});
    EXPECT_EQ(covered(picture()).size(), 0u);
    draw.line({ 0.1, 0.1, 100 }, { 0.1, 0.1, -100 }, { .color = kRed }); // through the near plane
    draw.screenLine({ -1e5f, 10.5f }, { 1e5f, 10.5f }, { .color = kRed });
    const Image image = picture();
    for (uint32_t x = 0; x < view.size.x; ++x) EXPECT_EQ(test::bytePixel(image, x, 10), kRed) << x;
    EXPECT_GT(covered(image).size(), view.size.x + 4u);
}

/// Everything that there is, at random.
void addDrawings(DebugDraw& draw, Random& random) {
    const auto at = [&](double size) {
        return double3(random.within(-size, size), random.within(-size, size), random.within(-size, size));
    };
    for (int i = 0; i < 60; ++i) {
        const float4 color(random.within(0, 1), random.within(0, 1), random.within(0, 1), random.within(0.2, 1));
        const DebugStyle style{ color, static_cast<float>(random.within(0.5, 4)),
                                i % 2 ? DebugDepth::Tested : DebugDepth::Through };
        draw.line(at(3), at(3), style);
        if (i % 6 == 0) draw.sphere(at(1), 0.7, style, 3 + random.next() % 30);
        if (i % 6 == 1)
            draw.box(Box{ double3(-1, -0.3, -0.2), double3(0.1, 0.4, 0.5) }, glm::translate(double4x4(1), at(1)),
                     style);
        if (i % 6 == 2) draw.frustum(Camera::lookAt(at(2), { 0, 0, 0 }), 1.5f, 1, style);
        if (i % 6 == 3) draw.axes(glm::translate(double4x4(1), at(1)), 0.5);
        if (i % 6 == 4)
            draw.text(at(1), "p = 0.5", { .color = color, .background = { 0, 0, 0, 0.5f }, .depth = style.depth });
        if (i % 6 == 5) draw.screenBox(float2(at(20)) + 30.0f, float2(at(20)) + 30.0f, style);
    }
}

TEST(DebugDraw, BothApisDrawTheSameBits) {
    std::vector<std::byte> first[3];
    for (const Backend backend : test::kBothApis) {
        LinesStage stage(backend);
        stage.square.add(stage.scene, stage.instance, { 0, 0, -0.2 }, 0.9);
        for (uint32_t seed = 0; seed < std::size(first); ++seed) {
            Random random(seed);
            stage.draw.clear();
            addDrawings(stage.draw, random);
            stage.view.samples = seed == 1 ? 4 : 1;
            stage.view.size = seed == 2 ? uint2(201, 133) : kDebugSize;
            const Image image = stage.picture();
            if (first[seed].empty()) first[seed] = image.pixels;
            EXPECT_EQ(image.pixels, first[seed]) << seed;
            EXPECT_GT(LinesStage::covered(image).size(), 500u);
        }
    }
}

TEST(DebugDraw, ShapesHaveTheLinesOfTheirEdges) {
    DebugDraw draw;
    draw.box(Box{ double3(-1), double3(1, 2, 3) });
    ASSERT_EQ(draw.lines().size(), 12u);
    double length = 0;
    for (DebugLine const& line : draw.lines()) length += glm::distance(line.from, line.to);
    EXPECT_DOUBLE_EQ(length, 4 * (2 + 3 + 4));
    draw.clear();
    draw.sphere({ 1, 2, 3 }, 0.5, {}, 16);
    EXPECT_EQ(draw.lines().size(), 48u);
    for (DebugLine const& line : draw.lines()) EXPECT_NEAR(glm::distance(line.from, double3(1, 2, 3)), 0.5, 1e-12);
    draw.clear();
    draw.frustum(Camera::lookAt({ 0, 0, 2 }, { 0, 0, 0 }, { .verticalFovDegrees = 90, .nearMeters = 0.5f }), 2, 1);
    EXPECT_EQ(draw.lines().size(), 12u);
    double highest = 0, widest = 0;
    for (DebugLine const& line : draw.lines())
        highest = std::max(highest, line.from.y), widest = std::max(widest, line.to.x);
    EXPECT_NEAR(highest, 1, 1e-12);
    EXPECT_NEAR(widest, 2, 1e-12);
    draw.clear();
    EXPECT_TRUE(draw.empty());
}

TEST(DebugDrawDeathTest, RefusesInvisibleWidths) {
    DebugDraw draw;
    EXPECT_DEATH(draw.line({}, {}, { .widthPixels = 0 }), "up to 64 pixels wide");
    EXPECT_DEATH(draw.screenLine({}, {}, { .widthPixels = std::nanf("") }), "up to 64 pixels wide");
    EXPECT_DEATH(draw.text({}, "x", { .pixels = 0 }), "1 to 16 pixels");
    EXPECT_DEATH(draw.sphere({}, 1, {}, 2), "3 to 256");
}

} // namespace
} // namespace filament_core
