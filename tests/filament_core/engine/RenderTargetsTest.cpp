// SPDX-License-Identifier: Apache-2.0
// Pictures of one view on the surfaces of another, in the same frame: colours, depths and mips of render targets, on
// both APIs. Row 0 is at the top.
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using prepare::Random;

constexpr uint32_t kFilmSide = 32;
constexpr float kDecoding = 2e-3f; ///< samplers decode sRGB by a polynomial (tests/backend/create/TextureTest.cpp)

constexpr const char* kScreen = R"(material { name : screen, shadingModel : unlit, requires : [ uv0 ], flipUV : false,
    parameters : [ { type : sampler2d, name : picture, precision : high }, { type : float, name : level } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = textureLod(materialParams_picture, getUV0(), materialParams.level).rgb;
} })";
constexpr const char* kFlat = R"(material { name : flat, shadingModel : unlit, culling : none,
    parameters : [ { type : float4, name : color } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";

struct TargetStage {
    Engine engine;
    test::SquareMesh square{ engine };
    Owned<Material> screenMaterial = test::loadMaterial(engine, kScreen),
                    flatMaterial = test::loadMaterial(engine, kFlat);
    Owned<MaterialInstance> screen = engine.own(engine.createInstance(screenMaterial, "television"));
    std::vector<Owned<MaterialInstance>> flats;
    std::vector<Owned<Texture>> textures;
    Scene scene{ engine }, room{ engine }; ///< what is filmed, and where it is shown
    Renderer camera{ engine }, renderer{ engine };
    View filmed{ .camera = Camera::lookAt({ 0.3, -0.2, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                 .size = uint2(kFilmSide) };
    /// The square of the room is all of its image, a texel a pixel.
    View shown{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }),
                .size = uint2(kFilmSide) };

    explicit TargetStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))) {
        Random random(4);
        for (int i = 0; i < 9; ++i) {
            flats.push_back(engine.own(engine.createInstance(flatMaterial)));
            const auto some = [&] { return static_cast<float>(random.within(0, 1)); };
            EXPECT_TRUE(engine.set(flats.back(), "color", float4(some(), some(), some(), 1)));
            square.add(scene, flats.back(), { random.within(-1, 1), random.within(-1, 1), random.within(-1, 1) }, 0.3);
        }
        square.add(room, screen);
        EXPECT_TRUE(engine.set(screen, "level", 0.0f));
        filmed.clearColor = { 0.25f, 0.5f, 0.125f, 1 };
    }
    ~TargetStage() { test::expectNoErrors(engine); }

    Texture texture(Format format, uint32_t levels = 1, uint32_t side = kFilmSide) {
        textures.push_back(engine.own(engine.create(TextureDesc{ .format = format,
                                                                 .width = side,
                                                                 .height = side,
                                                                 .levels = levels,
                                                                 .renderable = true,
                                                                 .name = "film" })));
        return textures.back();
    }
    Owned<RenderTarget> target(RenderTargetDesc const& desc) { return engine.own(engine.create(desc)); }
    void show(Texture film) { EXPECT_TRUE(engine.set(screen, "picture", film, kUnfilteredSampler)); }
    Image room16() { return test::renderLinear(engine, room, shown); }
    Image pixelsOf(RenderTarget film) {
        auto image = camera.waitPixels(camera.readPixels(film));
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
};

struct RenderTargetsTest : testing::TestWithParam<Backend>, TargetStage {
    RenderTargetsTest() : TargetStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, RenderTargetsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(RenderTargetsTest, ASquareShowsWhatAnotherViewHasDrawnTopRowUppermost) {
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA16F) });
    show(engine.colorOf(film));
    EXPECT_FALSE(engine.depthOf(film));
    for (int frame = 0; frame < 3; ++frame) {
        filmed.camera = Camera::lookAt({ 0.3 * frame, -0.2, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 });
        camera.render(scene, filmed, film);
        const Image seen = room16(), drawn = test::renderLinear(engine, scene, filmed);
        EXPECT_EQ(test::differingPixels(seen, drawn), 0u) << frame;
        EXPECT_NE(test::halfPixel(drawn, 16, 8), test::halfPixel(drawn, 16, 24)) << "above is not below";
    }
}

TEST_P(RenderTargetsTest, EightBitColoursAreThoseOfAPicture) {
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA8) });
    show(engine.colorOf(film));
    camera.render(scene, filmed, film);
    const Image seen = room16();
    const auto drawn = camera.waitPixels(camera.readPixels(film));
    ASSERT_TRUE(drawn);
    for (uint32_t y = 0; y < kFilmSide; ++y) {
        for (uint32_t x = 0; x < kFilmSide; ++x) {
            const float4 a = test::halfPixel(seen, x, y), b = test::bytePixel(*drawn, x, y);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 5e-4f);
        }
    }
}

/// Views of a target of kFilmSide that exercise what its last passes can be.
std::vector<std::pair<const char*, View>> viewsOfEveryLastPass(View const& filmed) {
    std::vector<std::pair<const char*, View>> views;
    const auto add = [&](const char* name, auto const& change) {
        views.emplace_back(name, filmed);
        change(views.back().second);
    };
    add("plain", [](View&) {});
    add("samples", [](View& view) { view.samples = 4; });
    add("dither", [](View& view) { view.display.dither = true; });
    add("fxaa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Fxaa; });
    add("enlarged", [](View& view) { view.effects.resolution.scale = float2(0.5f); });
    add("bloom and grain", [](View& view) { view.effects.bloom.enabled = view.effects.grain.enabled = true; });
    add("a part", [](View& view) {
        view.size = { 15, 11 };
        view.viewport = filament_core::Viewport{ .offset = { 9, 4 } };
    });
    add("a part of a cleared target", [](View& view) {
        view.size = { 15, 11 };
        view.viewport = filament_core::Viewport{ .offset = { 9, 4 },
                                                 .contents = TargetContents::Clear,
                                                 .clearColor = { 0.25f, 0.5f, 0.125f, 0.5f } };
    });
    add("translucent", [](View& view) {
        view.clearColor = { 0.5f, 0.25f, 0, 0.5f };
        view.viewport = filament_core::Viewport{ .blending = ViewBlending::Translucent };
    });
    return views;
}

TEST_P(RenderTargetsTest, AnSrgbPictureHasTheBytesOfAnRgba8One) {
    const Owned<RenderTarget> plain = target({ .color = texture(Format::RGBA8) }),
                              srgb = target({ .color = texture(Format::RGBA8Srgb), .depth = texture(Format::R32F) });
    DebugDraw debug;
    debug.screenText({ 2, 2 }, "over it", { .color = { 1, 0.5f, 0, 0.5f } });
    std::vector<std::byte> before;
    for (auto& [name, view] : viewsOfEveryLastPass(filmed)) {
        for (const DebugDraw* drawn :
             { static_cast<const DebugDraw*>(nullptr), static_cast<const DebugDraw*>(&debug) }) {
            view.debugDraw = drawn;
            camera.render(scene, view, plain);
            camera.render(scene, view, srgb);
            const Image expected = pixelsOf(plain), seen = pixelsOf(srgb);
            EXPECT_EQ(seen.format, Format::RGBA8Srgb);
            EXPECT_EQ(seen.pixels, expected.pixels) << name;
            EXPECT_NE(seen.pixels, before) << name << ": each shows something else";
            before = seen.pixels;
        }
        if (!view.viewport || view.viewport->contents != TargetContents::Clear) continue;
        const float4 corner = test::bytePixel(pixelsOf(srgb), 31, 31) * 255.0f;
        EXPECT_EQ(glm::round(corner), float4(64, 128, 32, 128)) << "the clear colour as it is, not encoded";
    }
}

// The transfer function is applied once on the way in, by the tone mapper, and once on the way out, by the sampler.
TEST_P(RenderTargetsTest, ASquareShowsTheLightOfAnSrgbPicture) {
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA8Srgb) }),
                              again = target({ .color = texture(Format::RGBA8Srgb) });
    filmed.display.toneMapper = shown.display.toneMapper = ToneMapper::Linear;
    camera.render(scene, filmed, film);
    show(engine.colorOf(film));
    const Image seen = room16(), codes = pixelsOf(film), light = test::renderLinear(engine, scene, filmed);
    renderer.render(room, shown, again);
    const Image shownAgain = pixelsOf(again);
    for (uint32_t y = 0; y < kFilmSide; ++y) {
        for (uint32_t x = 0; x < kFilmSide; ++x) {
            const float3 code(test::bytePixel(codes, x, y)), linear = color::linearFromSrgb(code);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(test::halfPixel(seen, x, y)[c], linear[c], kDecoding) << x << " " << y;
                EXPECT_NEAR(test::halfPixel(light, x, y)[c], linear[c], 5e-3f) << "half a code, where it is steep";
                EXPECT_NEAR(test::bytePixel(shownAgain, x, y)[c], code[c], 1.01f / 255) << x << " " << y;
            }
        }
    }
}

// Display-referred and scene-linear targets side by side, each square a texel a pixel of a parallel lens: the top rows
// of all are the top row of what shows them.
TEST_P(RenderTargetsTest, ACompositeShowsTargetsOfEveryFormatInTheFrameThatDrawsThem) {
    constexpr Format kFormats[] = { Format::RGBA8, Format::RGB10A2, Format::RGBA16F, Format::RGBA8Srgb };
    std::vector<Owned<RenderTarget>> films;
    std::vector<Owned<MaterialInstance>> screens;
    Scene wall(engine);
    for (const Format format : kFormats) {
        films.push_back(target({ .color = texture(format) }));
        screens.push_back(engine.own(engine.createInstance(screenMaterial)));
        EXPECT_TRUE(engine.set(screens.back(), "picture", engine.colorOf(films.back()), Sampler{}));
        square.add(wall, screens.back(), { 2.0 * static_cast<double>(films.size()) - 5, 0, 0 });
    }
    View composite{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, Lens::orthographic(-4, 4, -1, 1)),
                    .size = { 4 * kFilmSide, kFilmSide } };
    for (Owned<RenderTarget> const& film : films) camera.render(scene, filmed, film);
    const Image seen = test::renderLinear(engine, renderer, wall, composite);
    const Image light = test::renderLinear(engine, scene, filmed);
    const auto display = camera.waitPixels(camera.readPixels(films[0]));
    ASSERT_TRUE(display);
    float fromTop = 0, fromBottom = 0;
    for (uint32_t y = 0; y < kFilmSide; ++y) {
        for (uint32_t x = 0; x < kFilmSide; ++x) {
            const float4 bytes = test::halfPixel(seen, x, y), ten = test::halfPixel(seen, kFilmSide + x, y);
            const float3 decoded = color::linearFromSrgb(float3(test::bytePixel(*display, x, y)));
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(test::halfPixel(seen, 3 * kFilmSide + x, y)[c], decoded[c], kDecoding) << "decoded once";
                EXPECT_NEAR(bytes[c], test::bytePixel(*display, x, y)[c], 5e-4f) << "codes as they are, encoded once";
                EXPECT_NEAR(ten[c], bytes[c], 6e-3f) << "a code of eight bits";
            }
            EXPECT_EQ(test::halfPixel(seen, 2 * kFilmSide + x, y), test::halfPixel(light, x, y));
            fromTop += std::abs(bytes.x - test::bytePixel(*display, x, y).x);
            fromBottom += std::abs(bytes.x - test::bytePixel(*display, x, kFilmSide - 1 - y).x);
        }
    }
    EXPECT_GT(fromBottom, 10 * fromTop) << "the picture is not its own mirror image";
}

TEST_P(RenderTargetsTest, DepthsOfAParallelLensAreMetresToo) {
    Scene walls(engine);
    square.add(walls, flats[0], { -1.5, 0, -2 }, 1.5);
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA8), .depth = texture(Format::R32F) });
    show(engine.depthOf(film));
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        View view{ .camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, Lens::orthographic(-2, 2, -2, 2, 0, 40)),
                   .size = uint2(kFilmSide) };
        view.quality.depthRange = range;
        camera.render(walls, view, film);
        const Image seen = room16();
        EXPECT_NEAR(test::halfPixel(seen, 8, 16).x, 5, 4e-3f);
        EXPECT_GT(test::halfPixel(seen, 24, 16).x, 30) << "at the far plane, or nothing";
    }
}

TEST_P(RenderTargetsTest, DepthsAreMetresAlongTheView) {
    Scene walls(engine);
    square.add(walls, flats[0], { -1.5, 0, -2 }, 1.5); // the left half of the image
    filmed.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 });
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA8), .depth = texture(Format::R32F) });
    EXPECT_TRUE(engine.depthOf(film));
    const auto depthsOf = [&](View const& view, std::vector<float>& depths) {
        camera.render(walls, view, film);
        // Its texels, by a material: metres, limited to what half floats hold.
        show(engine.depthOf(film));
        const Image seen = room16();
        for (uint32_t y = 0; y < kFilmSide; ++y)
            for (uint32_t x = 0; x < kFilmSide; ++x) depths.push_back(test::halfPixel(seen, x, y).x);
    };
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
            View view = filmed;
            view.samples = samples;
            view.quality.depthRange = range;
            std::vector<float> depths;
            depthsOf(view, depths);
            EXPECT_NEAR(depths[16 * kFilmSide + 8], 5, 4e-3f) << int{ samples };
            EXPECT_GT(depths[16 * kFilmSide + 24], 60'000) << "nothing is there";
        }
    }
    View part = filmed;
    part.size = uint2(16);
    part.viewport = filament_core::Viewport{ .offset = { 10, 4 } };
    std::vector<float> depths;
    depthsOf(part, depths);
    EXPECT_NEAR(depths[12 * kFilmSide + 12], 5, 4e-3f) << "the left half of the part";
    EXPECT_GT(depths[12 * kFilmSide + 24], 60'000) << "its right half";
    EXPECT_NEAR(depths[16 * kFilmSide + 4], 5, 4e-3f) << "what was there";
}

TEST_P(RenderTargetsTest, MipsFollowEveryView) {
    const Owned<RenderTarget> film =
            target({ .color = texture(Format::RGBA8, 6), .generateMips = true, .name = "mips" });
    EXPECT_TRUE(engine.set(screen, "picture", engine.colorOf(film),
                           Sampler{ Filter::Nearest, Filter::Nearest, MipFilter::Nearest, WrapMode::ClampToEdge,
                                    WrapMode::ClampToEdge }));
    for (int frame = 0; frame < 2; ++frame) {
        filmed.clearColor.x = 0.7f * static_cast<float>(frame);
        camera.render(scene, filmed, film);
        const auto level0 = camera.waitPixels(camera.readPixels(film));
        ASSERT_TRUE(level0);
        EXPECT_TRUE(engine.set(screen, "level", 1.0f));
        const Image level1 = room16();
        for (uint32_t y = 0; y < kFilmSide; y += 2) {
            for (uint32_t x = 0; x < kFilmSide; x += 2) {
                float4 mean(0);
                for (uint32_t i = 0; i < 4; ++i) mean += test::bytePixel(*level0, x + i % 2, y + i / 2) * 0.25f;
                const float4 seen = test::halfPixel(level1, x, y);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], mean[c], 1.05f / 255) << x << " " << y;
            }
        }
    }
}

TEST_P(RenderTargetsTest, AFrameThatSamplesItsOwnTargetIsLeftOutAndSaysWhy) {
    const Owned<RenderTarget> film = target({ .color = texture(Format::RGBA8) });
    show(engine.colorOf(film));
    shown.clearColor = { 0, 0, 1, 1 };
    camera.render(scene, filmed, film);
    const auto before = camera.waitPixels(camera.readPixels(film));
    camera.render(room, shown, film);
    const std::vector<std::string> errors = engine.takeErrors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_THAT(errors[0], testing::HasSubstr("material 'television' samples 'film', which the frame draws to"));
    EXPECT_EQ(camera.waitPixels(camera.readPixels(film))->pixels, before->pixels);
    room16(); // elsewhere it may
    EXPECT_TRUE(engine.takeErrors().empty());
    shown.visibleLayers = 2; // the screen is hidden
    camera.render(room, shown, film);
    EXPECT_NE(camera.waitPixels(camera.readPixels(film))->pixels, before->pixels);
}

TEST(RenderTargets, BothApisShowTheSameBits) {
    for (const bool isSrgb : { false, true }) {
        std::vector<std::byte> first, firstCodes;
        for (const Backend backend : test::kBothApis) {
            TargetStage stage(backend);
            const Texture color = stage.texture(isSrgb ? Format::RGBA8Srgb : Format::RGBA8, 6);
            const Owned<RenderTarget> film = stage.target({ .color = color, .generateMips = true });
            EXPECT_TRUE(stage.engine.set(stage.screen, "picture", stage.engine.colorOf(film),
                                         Sampler{ Filter::Linear, Filter::Linear, MipFilter::Linear,
                                                  WrapMode::ClampToEdge, WrapMode::ClampToEdge }));
            EXPECT_TRUE(stage.engine.set(stage.screen, "level", 1.5f));
            stage.camera.render(stage.scene, stage.filmed, film);
            const Image seen = stage.room16(), codes = stage.pixelsOf(film);
            if (first.empty()) first = seen.pixels, firstCodes = codes.pixels;
            EXPECT_EQ(seen.pixels, first);
            EXPECT_EQ(codes.pixels, firstCodes);
        }
    }
}

TEST(RenderTargetsDeathTest, RefusesTexturesThatDoNotFit) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // an engine has threads
    TargetStage stage(Backend::Null);
    Engine& engine = stage.engine;
    const Texture color = stage.texture(Format::RGBA8), depth = stage.texture(Format::R32F),
                  small = stage.texture(Format::R32F, 1, kFilmSide / 2);
    const Owned<Texture> plain = engine.own(engine.create(TextureDesc{ .width = kFilmSide, .height = kFilmSide }));
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{}), "a render target has a colour");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = plain }),
                 "renderable texture of RGBA8, RGBA8Srgb, RGB10A2, RGBA16F or RGBA32F");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = depth }),
                 "renderable texture of RGBA8, RGBA8Srgb, RGB10A2, RGBA16F or RGBA32F");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = color, .depth = color }), "texture of R32F");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = color, .depth = small }), "as large as what is drawn");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = color, .generateMips = true }), "has several levels");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = color, .layer = 1 }), "the layer of a render target");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = color, .others = { small } }),
                 "as large as what is drawn");
    const Texture srgb = stage.texture(Format::RGBA8Srgb);
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = srgb, .generateMips = true }), "has several levels");
    EXPECT_DEATH((void)engine.create(SwapChainDesc{ .size = { 4, 4 }, .format = Format::RGBA8Srgb }),
                 "a swap chain of sRGB codes has format RGBA8");
    engine.destroy(engine.create(RenderTargetDesc{ .color = color, .depth = depth }));
}

} // namespace
} // namespace filament_core
