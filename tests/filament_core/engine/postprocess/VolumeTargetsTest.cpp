// SPDX-License-Identifier: Apache-2.0
// Slices of 3D textures as render targets: passes without a view, mesh passes and views draw to them, materials sample
// them.
#include "tests/filament_core/engine/postprocess/PassStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using test::kPassSide;
using test::PassStage;
using test::passText;
using testing::HasSubstr;

struct VolumeTargetsTest : testing::TestWithParam<Backend>, PassStage {
    VolumeTargetsTest() : PassStage(GetParam()) {}

    Texture volume(uint32_t side, uint32_t levels, Format format = Format::RGBA16F) {
        return texture({ .kind = TextureKind::Texture3D,
                         .format = format,
                         .width = side,
                         .height = side,
                         .layers = side,
                         .levels = levels });
    }
    /// Texels are where they are in the unit cube, or 1 less that.
    void fill(Texture volume, uint32_t side, uint32_t level, bool isReversed) {
        const MaterialInstance place = instance(passText("{ type : float, name : w }, { type : bool, name : reversed }",
                                                         R"(vec3 at = vec3(getNormalizedUV(), materialParams.w);
            inputs.color = vec4(materialParams.reversed ? 1.0 - at : at, 1.0);)",
                                                         "place"));
        ASSERT_TRUE(engine.set(place, "reversed", isReversed));
        const uint32_t slices = side >> level;
        for (uint32_t i = 0; i < slices; ++i) {
            const uint32_t slice = (i * 5 + 2) % slices; // in no order
            ASSERT_TRUE(engine.set(place, "w", (static_cast<float>(slice) + 0.5f) / static_cast<float>(slices)));
            renderer.render(place, target({ .color = volume, .level = level, .layer = slice }));
        }
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, VolumeTargetsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// Interpolation along all three axes of what is linear there.
TEST_P(VolumeTargetsTest, SlicesThatPassesFillAreFilteredTogether) {
    const Texture filled = volume(8, 2);
    fill(filled, 8, 0, false);
    fill(filled, 8, 1, true);
    const MaterialInstance look = pass(passText("{ type : sampler3d, name : volume }, { type : float, name : level }",
                                                R"(vec2 at = getNormalizedUV() * 0.75 + 0.125;
        inputs.color = textureLod(materialParams_volume, vec3(at, 0.5 * (at.x + at.y)), materialParams.level);)"),
                                       PassPlace::Last);
    ASSERT_TRUE(engine.set(
            look, "volume", filled,
            Sampler{ .magFilter = Filter::Linear, .minFilter = Filter::Linear, .mipFilter = MipFilter::Nearest }));
    for (const float level : { 0.0f, 1.0f }) {
        ASSERT_TRUE(engine.set(look, "level", level));
        const Image seen = light();
        for (uint32_t y = 0; y < kPassSide; y += 5) {
            for (uint32_t x = 0; x < kPassSide; x += 3) {
                const float2 at = (float2(x, y) + 0.5f) / static_cast<float>(kPassSide) * 0.75f + 0.125f;
                const float3 place(at, 0.5f * (at.x + at.y));
                const float3 expected = level > 0 ? 1.0f - place : place;
                const float4 is = test::halfPixel(seen, x, y);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], expected[c], 2e-3f) << level << ": " << x << ", " << y;
            }
        }
    }
}

TEST_P(VolumeTargetsTest, WhatOtherSlicesHoldIsKept) {
    for (const Format format : { Format::RGBA8, Format::RGBA8Srgb }) {
        const Texture held = volume(4, 1, format);
        const MaterialInstance third =
                instance(passText("{ type : float4, name : paint }", "inputs.color = materialParams.paint;", "third"));
        const MaterialInstance added =
                instance("material { name : added, domain : postprocess, blending : add }\n"
                         "fragment { void postProcess(inout PostProcessInputs inputs) { inputs.color = vec4(0.2); } }");
        const RenderTarget first = target({ .color = held, .layer = 0 }), last = target({ .color = held, .layer = 3 });
        ASSERT_TRUE(engine.set(third, "paint", float4(1, 0, 0.2f, 1)));
        renderer.render(third, first);
        const std::vector<uint8_t> texels(4 * 4 * 4, 51);
        engine.update(held, { .pixels = std::as_bytes(std::span(texels)), .firstLayer = 1 });
        ASSERT_TRUE(engine.set(third, "paint", float4(0, 1, 0, 1)));
        renderer.render(third, last);
        renderer.render(added, first);
        renderer.render(added, target({ .color = held, .layer = 1 }));
        EXPECT_EQ(glm::round(255.0f * test::bytePixel(pixelsOf(first), 2, 1)), float4(255, 51, 102, 255));
        EXPECT_EQ(glm::round(255.0f * test::bytePixel(pixelsOf(last), 2, 1)), float4(0, 255, 0, 255));
        EXPECT_EQ(glm::round(255.0f * test::bytePixel(pixelsOf(target({ .color = held, .layer = 1 })), 2, 1)),
                  float4(102));
    }
}

TEST_P(VolumeTargetsTest, AMeshPassIntoASliceIsThatIntoATexture) {
    const RenderTarget slice = target({ .color = volume(kPassSide, 1), .layer = 7 }),
                       plain = target(
                               { .color = texture(
                                         { .format = Format::RGBA16F, .width = kPassSide, .height = kPassSide }) });
    const MaterialInstance mask = instance(R"(material { name : mask, shadingModel : unlit, culling : none }
    fragment { void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = vec4(fract(getUserWorldPosition()), 1.0);
    } })");
    for (const RenderTarget to : { slice, plain }) renderer.render(scene, MeshPass{ .material = mask }, to, view);
    EXPECT_EQ(pixelsOf(slice).pixels, pixelsOf(plain).pixels);
}

TEST_P(VolumeTargetsTest, ASliceIsNotDrawnByWhatSamplesAnother) {
    const Texture both = volume(8, 1);
    const MaterialInstance look =
            instance(passText("{ type : sampler3d, name : volume }",
                              "inputs.color = texture(materialParams_volume, vec3(0.5));", "look"));
    ASSERT_TRUE(engine.set(look, "volume", both));
    renderer.render(look, target({ .color = both, .layer = 2 }));
    EXPECT_THAT(error(), HasSubstr("'look' samples by 'volume' what the frame draws to"));
}

// A part of such a texture may be as small as the device allows.
TEST_P(VolumeTargetsTest, PartsOfTexturesThatTheDeviceRefusesAreNotWaitedFor) {
    const MaterialInstance fill = instance(passText("{ type : float4, name : paint }", "inputs.color = vec4(1.0);"));
    const DeviceDescription device = engine.device();
    for (const TextureKind kind : { TextureKind::Texture2D, TextureKind::Texture3D }) {
        const uint32_t most = kind == TextureKind::Texture3D ? device.max3DTextureSize : device.maxTextureSize;
        const RenderTarget half =
                target({ .color = texture({ .kind = kind, .width = most + 2, .height = 2, .levels = 2 }), .level = 1 });
        EXPECT_THAT(error(), HasSubstr("this device supports at most"));
        renderer.render(fill, half);
        EXPECT_FALSE(renderer.waitPixels(renderer.readPixels(half)));
        (void)engine.takeErrors();
    }
}

TEST(VolumeTargetsDeathTest, TargetsAreSlicesThatTheLevelHas) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // an engine has threads
    Engine engine = std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }));
    TextureDesc desc{ .kind = TextureKind::Texture3D, .width = 8, .height = 8, .layers = 8, .levels = 2 };
    const Owned<Texture> plain = engine.own(engine.create(desc));
    desc.renderable = true;
    const Owned<Texture> volume = engine.own(engine.create(desc));
    engine.destroy(engine.create(RenderTargetDesc{ .color = volume, .level = 1, .layer = 3 }));
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = volume, .level = 1, .layer = 4 }),
                 "level 1 of a 3D texture has 4 slices, and the render target is slice 4");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = volume, .level = 2 }), "the level and the layer");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = volume, .generateMips = true }),
                 "mips of a 3D texture are not generated; draw to the slices of each level");
    EXPECT_DEATH((void)engine.create(RenderTargetDesc{ .color = plain }), "renderable texture of RGBA8");
}

} // namespace
} // namespace filament_core
