// SPDX-License-Identifier: Apache-2.0
// Several views in one target: a view has in its viewport the bits that it has alone, whatever its effects, and the
// rest of the target stays as it was.
#include "tests/filament_core/engine/ShadowStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using prepare::Random;

constexpr uint2 kTargetSize(80, 64), kViewSize(33, 25), kOffset(21, 30);

size_t bytesAPixel(Format format) { return format == Format::RGBA16F ? 8 : 4; }

/// The part of an image.
std::vector<std::byte> cut(Image const& image, uint2 offset, uint2 size) {
    std::vector<std::byte> bytes;
    const size_t pixel = bytesAPixel(image.format);
    for (uint32_t y = offset.y; y < offset.y + size.y; ++y) {
        const auto row =
                image.pixels.begin() + static_cast<std::ptrdiff_t>((size_t{ y } * image.width + offset.x) * pixel);
        bytes.insert(bytes.end(), row, row + static_cast<std::ptrdiff_t>(size.x * pixel));
    }
    return bytes;
}

/// Without that part, which becomes 0.
std::vector<std::byte> around(Image const& image, uint2 offset, uint2 size) {
    std::vector<std::byte> bytes = image.pixels;
    const size_t pixel = bytesAPixel(image.format);
    for (uint32_t y = offset.y; y < offset.y + size.y; ++y)
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>((size_t{ y } * image.width + offset.x) * pixel),
                    size.x * pixel, std::byte{ 0 });
    return bytes;
}

struct ViewportTest : testing::TestWithParam<Backend> {
    test::ShadowStage stage{ GetParam() };
    Scene scene{ stage.engine }, other{ stage.engine };
    Renderer renderer{ stage.engine }, small{ stage.engine };
    View whole = test::shadowedView({ 0, -5, 6 }, { 0, 0, 0.5 }, ShadowFilter::Pcf3, kTargetSize);
    View part = test::shadowedView({ 4, -1, 3 }, { 0, 0, 0.5 }, ShadowFilter::Hard, kViewSize);

    ViewportTest() {
        Random random(3);
        test::addCrowd(stage, scene, random, 1);
        stage.addBox(other, { 0, 0, 0.5 }, double3(0.8), 0.4);
        other.add(SunLight{ .directionWorld = { -0.6f, 0.2f, -1 }, .illuminance = Lux{ 60'000 } });
        whole.clearColor = { 0.1f, 0.2f, 0.3f, 1 };
    }

    Owned<SwapChain> chain(Format format, uint2 size = kTargetSize, uint32_t images = 1) {
        return stage.engine.own(
                stage.engine.create(SwapChainDesc{ .size = size, .imageCount = images, .format = format }));
    }
    Image read(SwapChain target) {
        auto image = renderer.waitPixels(renderer.readPixels(target));
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    /// `view` of `other` after so many frames, in a target of its own.
    Image alone(View const& view, Format format, int frames) {
        Renderer own(stage.engine);
        const Owned<SwapChain> target = chain(format, view.size);
        for (int i = 0; i < frames; ++i) own.render(other, view, target);
        return read(target);
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, ViewportTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(ViewportTest, AViewHasInItsPlaceTheBitsThatItHasAloneWithEveryEffect) {
    struct Case {
        const char* name;
        void (*change)(View&);
        int frames = 1;
    };
    const Case cases[] = {
        { "plain", [](View&) {} },
        { "samples", [](View& view) { view.samples = 4; } },
        { "fxaa and dither",
          [](View& view) {
              view.quality.antiAliasing = AntiAliasing::Fxaa;
              view.display.dither = true;
          } },
        { "taa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Taa; }, 3 },
        { "bloom, vignette and grain",
          [](View& view) {
              view.effects.bloom.enabled = view.effects.vignette.enabled = view.effects.grain.enabled = true;
          } },
        { "depth of field",
          [](View& view) {
              view.effects.depthOfField.enabled = true;
              view.effects.depthOfField.focusMeters = 2;
          } },
        { "debug view", [](View& view) { view.debugView = DebugView::Cascades; } },
    };
    for (Case const& one : cases) {
        for (const Format format : { Format::RGBA8, Format::RGBA16F }) {
            View view = part;
            one.change(view);
            const Image expected = alone(view, format, one.frames);
            const Owned<SwapChain> target = chain(format);
            renderer.render(scene, whole, target);
            const Image before = read(target);
            view.viewport = filament_core::Viewport{ .offset = kOffset };
            Renderer own(stage.engine);
            for (int i = 0; i < one.frames; ++i) own.render(other, view, target);
            const Image after = read(target);
            EXPECT_EQ(cut(after, kOffset, kViewSize), expected.pixels) << one.name << " " << static_cast<int>(format);
            EXPECT_EQ(around(after, kOffset, kViewSize), around(before, kOffset, kViewSize)) << one.name;
        }
    }
}

TEST_P(ViewportTest, AClearedTargetHasTheColourAroundTheView) {
    const Owned<SwapChain> target = chain(Format::RGBA8);
    renderer.render(scene, whole, target);
    View view = part;
    view.viewport = filament_core::Viewport{ .offset = kOffset,
                                             .contents = TargetContents::Clear,
                                             .clearColor = { 1, 0.2f, 0, 0.6f } };
    small.render(other, view, target);
    const Image image = read(target);
    EXPECT_EQ(cut(image, kOffset, kViewSize), alone(part, Format::RGBA8, 1).pixels);
    for (const uint2 at : { uint2(0, 0), kOffset - 1u, kOffset + kViewSize, kTargetSize - 1u })
        EXPECT_EQ(test::bytePixel(image, at.x, at.y), float4(255, 51, 0, 153) / 255.0f) << at.x << " " << at.y;
}

TEST_P(ViewportTest, AnUndrawnTargetIsCleared) {
    const Owned<SwapChain> target = chain(Format::RGBA8);
    View view = part;
    view.viewport = filament_core::Viewport{ .offset = kOffset, .clearColor = { 0, 0, 1, 1 } };
    small.render(other, view, target);
    EXPECT_EQ(test::bytePixel(read(target), 0, 0), float4(0, 0, 1, 1));
}

TEST_P(ViewportTest, ViewsThatKeepContentsJoinTheLastImageOfASwapChain) {
    const Owned<SwapChain> target = chain(Format::RGBA8, kTargetSize, 3);
    View view = part;
    for (uint32_t frame = 0; frame < 5; ++frame) {
        whole.clearColor.x = 0.2f * static_cast<float>(frame);
        renderer.render(scene, whole, target);
        const Image before = read(target);
        view.viewport = filament_core::Viewport{ .offset = { frame, 2 * frame } };
        small.render(other, view, target);
        view.viewport->offset = { 40, 30 };
        small.render(other, view, target);
        const Image after = read(target);
        EXPECT_EQ(cut(after, { frame, 2 * frame }, { 30, 20 }), cut(alone(part, Format::RGBA8, 1), {}, { 30, 20 }));
        EXPECT_EQ(cut(after, { 40, 30 }, kViewSize), alone(part, Format::RGBA8, 1).pixels);
        EXPECT_EQ(cut(after, { 0, 55 }, { 40, 9 }), cut(before, { 0, 55 }, { 40, 9 }));
    }
}

TEST_P(ViewportTest, AViewportThatIsTheWholeTargetCostsNoPass) {
    const Owned<SwapChain> target = chain(Format::RGBA8);
    for (int i = 0; i < 2; ++i) renderer.render(scene, whole, target); // the second keeps the shadow maps
    const Image expected = read(target);
    const uint32_t passes = renderer.statistics().passesRun;
    whole.viewport = filament_core::Viewport{};
    renderer.render(scene, whole, target);
    EXPECT_EQ(read(target).pixels, expected.pixels);
    EXPECT_EQ(renderer.statistics().passesRun, passes);
    EXPECT_THAT(renderer.explain(), testing::Not(testing::HasSubstr("\nplace")));
}

// ---- translucent views

constexpr const char* kGlassPane = R"(material { name : pane, shadingModel : unlit, blending : transparent,
    parameters : [ { type : float4, name : color } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = materialParams.color;
} })";

/// A view of a pane, pre-multiplied light and alpha, over an image.
struct TranslucentTest : ViewportTest {
    Owned<Material> material = test::loadMaterial(stage.engine, kGlassPane);
    Owned<MaterialInstance> pane = stage.engine.own(stage.engine.createInstance(material));
    Scene panes{ stage.engine };
    View over = test::SquareMesh::view(kViewSize);

    TranslucentTest() {
        stage.square.add(panes, pane, { -0.5, 0, 0 }, 0.5);
        over.clearColor = float4(0);
        over.viewport = filament_core::Viewport{ .offset = kOffset, .blending = ViewBlending::Translucent };
        over.display.toneMapper = ToneMapper::Linear;
    }
    void setLight(float4 premultiplied) { EXPECT_TRUE(stage.engine.set(pane, "color", premultiplied)); }
};
INSTANTIATE_TEST_SUITE_P(BothApis, TranslucentTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

float encodedSrgb(float light) {
    return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
}

TEST_P(TranslucentTest, ShowsThePictureThroughItsAlphaAndNothingWhereNothingIsDrawn) {
    Image first;
    for (const AntiAliasing smoothing : { AntiAliasing::Off, AntiAliasing::Fxaa }) {
        over.quality.antiAliasing = smoothing;
        const Owned<SwapChain> target = chain(Format::RGBA8);
        renderer.render(scene, whole, target);
        const Image before = read(target);
        const float4 color(0.9f, 0.3f, 0.02f, 0.4f); // what a colour filter of 40 % shows
        setLight(float4(float3(color) * color.w, color.w));
        small.render(panes, over, target);
        const Image after = read(target);
        EXPECT_EQ(around(after, kOffset, kViewSize), around(before, kOffset, kViewSize));
        const uint2 bare = kOffset + kViewSize - 1u; // the right half of the view is empty
        EXPECT_EQ(test::bytePixel(after, bare.x, bare.y), test::bytePixel(before, bare.x, bare.y));
        const uint2 covered = kOffset + uint2(8, 12);
        const float4 under = test::bytePixel(before, covered.x, covered.y),
                     seen = test::bytePixel(after, covered.x, covered.y);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], encodedSrgb(color[c]) * color.w + under[c] * (1 - color.w), 1.6f / 255) << c;
        EXPECT_NEAR(seen.w, 1, 0.5f / 255);
    }
}

TEST_P(TranslucentTest, ScenesOfLightAreAddedAsLight) {
    const Owned<SwapChain> target = chain(Format::RGBA16F);
    renderer.render(scene, whole, target);
    const Image before = read(target);
    setLight({ 2, 0.5f, 0, 0.25f });
    small.render(panes, over, target);
    const Image after = read(target);
    const uint2 covered = kOffset + uint2(8, 12);
    const float4 under = test::halfPixel(before, covered.x, covered.y),
                 seen = test::halfPixel(after, covered.x, covered.y);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], float3(2, 0.5f, 0)[c] + 0.75f * under[c], 2e-3f * std::max(1.0f, seen[c])) << c;
}

TEST_P(TranslucentTest, IsOpaqueWhereItsAlphaIsOneWhateverTheToneMapper) {
    for (const ToneMapper mapper : { ToneMapper::Aces, ToneMapper::Filmic, ToneMapper::Linear }) {
        View view = part;
        view.display.toneMapper = mapper;
        const Image expected = alone(view, Format::RGBA8, 1); // its background has alpha 1
        const Owned<SwapChain> target = chain(Format::RGBA8);
        renderer.render(scene, whole, target);
        view.viewport = filament_core::Viewport{ .offset = kOffset, .blending = ViewBlending::Translucent };
        small.render(other, view, target);
        EXPECT_EQ(cut(read(target), kOffset, kViewSize), expected.pixels) << toString(mapper);
    }
}

TEST(Viewport, BothApisComposeTheSameBits) {
    std::vector<std::byte> first;
    for (const Backend backend : test::kBothApis) {
        test::ShadowStage stage(backend);
        Scene scene(stage.engine), panes(stage.engine);
        Random random(5);
        test::addCrowd(stage, scene, random, 1);
        Owned<Material> material = test::loadMaterial(stage.engine, kGlassPane);
        Owned<MaterialInstance> pane = stage.engine.own(stage.engine.createInstance(material));
        EXPECT_TRUE(stage.engine.set(pane, "color", float4(0.31f, 0.07f, 0.12f, 0.37f)));
        for (int i = 0; i < 5; ++i) stage.square.add(panes, pane, { 0.3 * i - 0.7, 0.2 * i - 0.4, 0.01 * i }, 0.4);
        const Owned<SwapChain> target = stage.engine.own(stage.engine.create(SwapChainDesc{ .size = kTargetSize }));
        Renderer renderer(stage.engine);
        View view = test::shadowedView({ 0, -5, 6 }, { 0, 0, 0.5 }, ShadowFilter::Pcf3, kTargetSize);
        renderer.render(scene, view, target);
        View over = test::SquareMesh::view(kViewSize);
        over.samples = 4;
        over.clearColor = float4(0);
        over.viewport = filament_core::Viewport{ .offset = kOffset, .blending = ViewBlending::Translucent };
        renderer.render(panes, over, target);
        const auto image = renderer.waitPixels(renderer.readPixels(target));
        ASSERT_TRUE(image);
        if (first.empty()) first = image->pixels;
        EXPECT_EQ(image->pixels, first);
    }
}

TEST(ViewportDeathTest, AViewportLiesInItsTarget) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // an engine has threads
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = { 64, 48 } }));
    View view{ .size = { 32, 32 } };
    EXPECT_DEATH(renderer.render(scene, view, target), "without a viewport has the size of its swap chain");
    for (const uint2 offset : { uint2(33, 0), uint2(0, 17), uint2(~0u, 0), uint2(64, 48) }) {
        view.viewport = filament_core::Viewport{ .offset = offset };
        EXPECT_DEATH(renderer.render(scene, view, target), "a viewport lies in its target");
    }
    view.viewport = filament_core::Viewport{ .clearColor = { 0, std::nanf(""), 0, 1 } };
    EXPECT_DEATH(renderer.render(scene, view, target), "clearColor is finite");
    view.viewport = filament_core::Viewport{ .offset = { 32, 16 } };
    renderer.render(scene, view, target);
    test::expectNoErrors(*engine);
}

} // namespace
} // namespace filament_core
