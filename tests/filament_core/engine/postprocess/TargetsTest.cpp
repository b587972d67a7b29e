// SPDX-License-Identifier: Apache-2.0
// Views into faces, layers, slices and levels; passes without a view, into one colour and into several.
#include "tests/filament_core/engine/postprocess/PassStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using test::input;
using test::kPassSide;
using test::PassStage;
using test::passText;
using testing::HasSubstr;

struct PartsTest : testing::TestWithParam<Backend>, PassStage {
    PartsTest() : PassStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, PartsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(PartsTest, AViewIntoALayerOrAFaceIsThatIntoATexture) {
    for (const Format format : { Format::RGBA8, Format::RGBA16F }) {
        const Owned<RenderTarget> plain = engine.own(engine.create(
                RenderTargetDesc{ .color = texture({ .format = format, .width = kPassSide, .height = kPassSide }) }));
        for (const TextureKind kind :
             { TextureKind::Texture2DArray, TextureKind::Cube, TextureKind::CubeArray, TextureKind::Texture3D }) {
            const uint32_t layers = kind == TextureKind::CubeArray || kind == TextureKind::Texture3D ? 12 : 6;
            const uint32_t first = kind == TextureKind::CubeArray ? 6 : 0; // half of the slices are in level 1
            const Texture film = texture({ .kind = kind,
                                           .format = format,
                                           .width = 2 * kPassSide,
                                           .height = 2 * kPassSide,
                                           .layers = layers,
                                           .levels = 3 });
            std::vector<Owned<RenderTarget>> parts;
            for (uint32_t layer = 0; layer < 6; ++layer)
                parts.push_back(engine.own(
                        engine.create(RenderTargetDesc{ .color = film, .level = 1, .layer = first + layer })));
            std::vector<Image> drawn;
            for (size_t i = 0; i < parts.size(); ++i) {
                view.camera = Camera::lookAt({ 0.3 * static_cast<double>(i), 0, 3 }, { 0, 0, 0 },
                                             { .verticalFovDegrees = 40 });
                renderer.render(scene, view, plain);
                drawn.push_back(pixelsOf(plain));
                renderer.render(scene, view, parts[i]);
            }
            for (size_t i = 0; i < parts.size(); ++i) {
                const Image part = pixelsOf(parts[i]);
                EXPECT_EQ(part.width, kPassSide);
                EXPECT_EQ(part.pixels, drawn[i].pixels) << i << ": what other layers were given did not change it";
                EXPECT_TRUE(i == 0 || part.pixels != drawn[i - 1].pixels) << "each shows something else";
            }
        }
    }
}

TEST_P(PartsTest, ViewportsAndDepthsOfALayerAreThoseOfATexture) {
    const Texture film = texture({ .kind = TextureKind::Texture2DArray,
                                   .width = kPassSide,
                                   .height = kPassSide,
                                   .layers = 2 }),
                  depth = texture({ .format = Format::R32F, .width = kPassSide, .height = kPassSide }),
                  flatFilm = texture({ .width = kPassSide, .height = kPassSide });
    const Owned<RenderTarget> layer = engine.own(
                                      engine.create(RenderTargetDesc{ .color = film, .depth = depth, .layer = 1 })),
                              plain = engine.own(engine.create(RenderTargetDesc{ .color = flatFilm }));
    for (const ViewBlending blending : { ViewBlending::Opaque, ViewBlending::Translucent }) {
        for (const TargetContents contents : { TargetContents::Clear, TargetContents::Keep }) {
            view.size = { 15, 11 };
            view.viewport = filament_core::Viewport{ .offset = { 5, contents == TargetContents::Keep ? 9u : 4u },
                                                     .contents = contents,
                                                     .blending = blending,
                                                     .clearColor = { 0.25f, 0.5f, 0.125f, 0.5f } };
            renderer.render(scene, view, layer);
            renderer.render(scene, view, plain);
            EXPECT_EQ(pixelsOf(layer).pixels, pixelsOf(plain).pixels);
        }
    }
}

// Each face has a colour of its own; a pass looks along the six axes.
TEST_P(PartsTest, FacesOfACubeAreThoseOfItsAxes) {
    const Texture cube =
            texture({ .kind = TextureKind::Cube, .format = Format::RGBA16F, .width = 8, .height = 8, .layers = 6 });
    const MaterialInstance fill = instance(
            passText("{ type : float3, name : paint }", "inputs.color = vec4(materialParams.paint, 1.0);", "fill"));
    for (uint32_t face = 0; face < 6; ++face) {
        const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = cube, .layer = face }));
        ASSERT_TRUE(engine.set(fill, "paint", float3(static_cast<float>(face), 0.5f, 0)));
        renderer.render(fill, target);
    }
    const MaterialInstance look = pass(passText("{ type : samplerCubemap, name : around }",
                                                R"(int column = getPixel().x / 4;
        vec3 axis = vec3(0.0);
        axis[column / 2] = (column & 1) == 0 ? 1.0 : -1.0;
        inputs.color = texture(materialParams_around, axis);)"),
                                       PassPlace::Last);
    ASSERT_TRUE(engine.set(look, "around", cube));
    const Image seen = light();
    for (uint32_t face = 0; face < 6; ++face)
        EXPECT_EQ(test::halfPixel(seen, 4 * face + 1, 3), float4(face, 0.5f, 0, 1)) << face;
}

TEST_P(PartsTest, APassWithoutAViewWritesSeveralColours) {
    const Texture first = texture({ .format = Format::RGBA16F, .width = 16, .height = 8 }),
                  second = texture({ .width = 16, .height = 8 }),
                  third = texture({ .format = Format::RGBA16F, .width = 16, .height = 8 });
    const Owned<RenderTarget> target = engine.own(
                                      engine.create(RenderTargetDesc{ .color = first, .others = { second, third } })),
                              ofSecond = engine.own(engine.create(RenderTargetDesc{ .color = second })),
                              ofThird = engine.own(engine.create(RenderTargetDesc{ .color = third }));
    const char* const kThree = R"(material { name : three, domain : postprocess,
        parameters : [ { type : float, name : share } ],
        outputs : [ { name : light }, { name : codes }, { name : place } ] }
    fragment { void postProcess(inout PostProcessInputs inputs) {
        inputs.light = vec4(materialParams.share, getUserTime().x, 0.0, 1.0);
        inputs.codes = vec4(1.0, 0.0, materialParams.share, 1.0);
        inputs.place = vec4(vec2(getPixel()), getResolution().xy);
    } })";
    const MaterialInstance three = instance(kThree);
    ASSERT_TRUE(engine.set(three, "share", 0.25f));
    renderer.render(scene, view, engine.own(engine.create(SwapChainDesc{ .size = view.size })));
    const std::string before = renderer.explain();
    renderer.render(three, target, View{ .timeSeconds = 2.5 });
    EXPECT_EQ(renderer.explain(), before) << "of the view";
    EXPECT_EQ(test::halfPixel(pixelsOf(target), 3, 2), float4(0.25f, 2.5f, 0, 1));
    EXPECT_EQ(glm::round(255.0f * test::bytePixel(pixelsOf(ofSecond), 3, 2)), float4(255, 0, 64, 255));
    EXPECT_EQ(test::halfPixel(pixelsOf(ofThird), 3, 2), float4(3, 2, 16, 8));
    // A view draws to the first colour alone.
    view.size = { 16, 8 };
    renderer.render(scene, view, target);
    EXPECT_NE(test::halfPixel(pixelsOf(target), 3, 2), float4(0.25f, 2.5f, 0, 1));
    EXPECT_EQ(test::halfPixel(pixelsOf(ofThird), 3, 2), float4(3, 2, 16, 8));

    renderer.render(three, ofThird);
    EXPECT_THAT(error(), HasSubstr("'three' writes 3 colours, and is drawn to 1; give `outputs`"));
    passes.push_back({ three, PassPlace::Last });
    view.postProcess = passes;
    EXPECT_FALSE(renderer.renderToImage(scene, view));
    EXPECT_THAT(error(), HasSubstr("leave `outputs` out"));
}

TEST_P(PartsTest, PassesWithoutAViewFollowEachOtherAndBlend) {
    const Texture a = texture({ .format = Format::RGBA16F, .width = 8, .height = 8 }),
                  b = texture({ .format = Format::RGBA16F, .width = 8, .height = 8 });
    const Owned<RenderTarget> toA = engine.own(engine.create(RenderTargetDesc{ .color = a })),
                              toB = engine.own(engine.create(RenderTargetDesc{ .color = b }));
    const MaterialInstance
            grown = instance(passText(input("last"),
                                      "inputs.color = texelFetch(materialParams_last, getPixel(), 0) * 2.0;", "grown")),
            added = instance(
                    "material { name : added, domain : postprocess, blending : add }\n"
                    "fragment { void postProcess(inout PostProcessInputs inputs) { inputs.color = vec4(0.25); } }");
    renderer.render(added, toA);
    renderer.render(added, toA);
    EXPECT_EQ(test::halfPixel(pixelsOf(toA), 4, 4), float4(0.5f)) << "over nothing, then over itself";
    ASSERT_TRUE(engine.set(grown, "last", a));
    renderer.render(grown, toB);
    EXPECT_EQ(test::halfPixel(pixelsOf(toB), 4, 4), float4(1));
    ASSERT_TRUE(engine.set(grown, "last", b));
    renderer.render(grown, toB);
    EXPECT_THAT(error(), HasSubstr("'grown' samples by 'last' what the frame draws to"));
    const MaterialInstance reads =
            instance(passText(input("color"), "inputs.color = texelFetch(materialParams_color, getPixel(), 0);"));
    renderer.render(reads, toB);
    EXPECT_THAT(error(), HasSubstr("has no texture for 'color'; give it one by Engine::set(): a pass without a view"));
}

// What a layer holds is the layer's, whichever of its targets has drawn it.
TEST_P(PartsTest, TargetsOfOneLayerDrawOverEachOther) {
    const Texture film = texture(
            { .kind = TextureKind::Texture2DArray, .format = Format::RGBA16F, .width = 8, .height = 8, .layers = 2 });
    const RenderTarget first = target({ .color = film, .layer = 1 }), second = target({ .color = film, .layer = 1 });
    const MaterialInstance added =
            instance("material { name : added, domain : postprocess, blending : add }\n"
                     "fragment { void postProcess(inout PostProcessInputs inputs) { inputs.color = vec4(0.25); } }");
    for (const RenderTarget part : { first, second, first }) renderer.render(added, part);
    EXPECT_EQ(test::halfPixel(pixelsOf(second), 4, 4), float4(0.75f));
}

// A table of colours, as a 3D texture: red and blue change places.
TEST_P(PartsTest, ATableOfColoursIsA3DTexture) {
    std::vector<uint8_t> texels;
    for (uint32_t slice = 0; slice < 2; ++slice)
        for (uint32_t row = 0; row < 2; ++row)
            for (uint32_t column = 0; column < 2; ++column)
                for (const uint32_t share : { slice, row, column, 1u })
                    texels.push_back(static_cast<uint8_t>(255 * share));
    const Owned<Texture> table = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Texture3D,
                                                                       .width = 2,
                                                                       .height = 2,
                                                                       .layers = 2,
                                                                       .pixels = std::as_bytes(std::span(texels)),
                                                                       .name = "table" }));
    const Image plain = codes();
    const MaterialInstance graded = pass(passText(input("color") + ", { type : sampler3d, name : table }",
                                                  R"(vec4 color = texelFetch(materialParams_color, getPixel(), 0);
        inputs.color = vec4(texture(materialParams_table, color.rgb * 0.5 + 0.25).rgb, color.a);)"),
                                         PassPlace::AfterToneMapping);
    ASSERT_TRUE(
            engine.set(graded, "table", table, Sampler{ .magFilter = Filter::Linear, .mipFilter = MipFilter::None }));
    const Image seen = codes();
    for (uint32_t i = 0; i < kPassSide; ++i) {
        const float4 was = test::bytePixel(plain, i, i), is = test::bytePixel(seen, i, i);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], was[2 - c], 3.0f / 255) << i;
    }
}

} // namespace
} // namespace filament_core
