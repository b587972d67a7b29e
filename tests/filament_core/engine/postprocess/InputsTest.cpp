// SPDX-License-Identifier: Apache-2.0
// What passes of the app read: inputs of the frame, textures and values of the app, their own history; and the errors
// of passes with wrong inputs or materials.
#include "tests/filament_core/engine/postprocess/PassStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using test::input;
using test::PassStage;
using test::passText;
using testing::HasSubstr;

struct InputsTest : testing::TestWithParam<Backend>, PassStage {
    InputsTest() : PassStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, InputsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

const std::string kDistance =
        passText(input("depth"), R"(float meters = texelFetch(materialParams_depth, getPixel(), 0).x;
    inputs.color = vec4(min(meters, 1000.0), 0.0, 0.0, 1.0);)");
const std::string kNormal =
        passText(input("normals"), "inputs.color = texelFetch(materialParams_normals, getPixel(), 0);");
const std::string kCounter =
        passText(input("history"), R"(vec4 last = texelFetch(materialParams_history, getPixel(), 0);
    inputs.color = vec4(last.rgb + 0.0625, 1.0);)");

TEST_P(InputsTest, DepthIsMetresAlongTheView) {
    for (const PassPlace place : { PassPlace::AfterOpaque, PassPlace::BeforeToneMapping, PassPlace::Last }) {
        for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
            clear();
            view.samples = samples;
            pass(kDistance, place);
            const Image seen = light();
            EXPECT_NEAR(test::halfPixel(seen, 7, 14).x, 3, 4e-3f) << toString(place);
            EXPECT_NEAR(test::halfPixel(seen, 14, 9).x, 4, 4e-3f);
            EXPECT_EQ(test::halfPixel(seen, 0, 0).x, 1000) << "nothing";
            EXPECT_TRUE(ran("distances"));
            EXPECT_FALSE(ran("normals"));
        }
    }
}

TEST_P(InputsTest, NormalsAreThoseOfTheWorld) {
    // A lit material has normals; the unlit ones of the stage have none.
    const Result<Material> lit = createBuiltInMaterial(engine, "lit");
    ASSERT_TRUE(lit);
    materials.push_back(engine.own(*lit));
    instances.push_back(engine.own(engine.createInstance(*lit)));
    double4x4 turned(1.0); // about y by the angle of 3-4-5
    turned[0] = { 0.4, 0, -0.3, 0 };
    turned[1] = { 0, 0.5, 0, 0 };
    turned[2] = { 0.3, 0, 0.4, 0 };
    turned[3] = { 0, 0, 1, 1 };
    square.add(scene, instances.back(), turned);
    pass(kNormal, PassPlace::BeforeToneMapping);
    const Image seen = light();
    const float4 normal = test::halfPixel(seen, 12, 12), none = test::halfPixel(seen, 0, 0);
    EXPECT_NEAR(normal.x, 0.6f, 2e-3f);
    EXPECT_NEAR(normal.y, 0, 2e-3f);
    EXPECT_NEAR(normal.z, 0.8f, 2e-3f);
    EXPECT_EQ(normal.w, 1);
    EXPECT_EQ(none, float4(0));
    EXPECT_TRUE(ran("normals"));
    EXPECT_FALSE(ran("distances"));
}

TEST_P(InputsTest, HistoryIsTheImageOfTheLastFrameOfThePassItself) {
    for (const PassPlace place : { PassPlace::BeforeToneMapping, PassPlace::Last }) {
        clear();
        Renderer anew(engine);
        const auto next = [&] { return test::halfPixel(test::renderLinear(engine, anew, scene, view), 5, 5).x; };
        const MaterialInstance counter = pass(kCounter, place);
        passes.push_back({ counter, place }); // the same once more: the image of each is its own
        view.postProcess = passes;
        for (int frame = 1; frame < 5; ++frame) EXPECT_EQ(next(), 0.0625f * static_cast<float>(frame)) << frame;
        view.size = { 20, 20 };
        EXPECT_EQ(next(), 0.0625f) << "another size begins anew";
        EXPECT_EQ(next(), 0.125f);
        Scene other(engine);
        EXPECT_EQ(test::halfPixel(test::renderLinear(engine, anew, other, view), 5, 5).x, 0.0625f);
        view.size = uint2(test::kPassSide);
    }
}

TEST_P(InputsTest, TexturesAndValuesAreThoseOfTheInstance) {
    const std::array<uint8_t, 8> texels{ 255, 0, 0, 255, 0, 0, 255, 255 };
    const Owned<Texture> stripes = engine.own(engine.create(
            TextureDesc{ .width = 2, .height = 1, .pixels = std::as_bytes(std::span(texels)), .name = "stripes" }));
    const MaterialInstance instance = pass(
            passText(
                    input("paper") + ", { type : float3, name : ink }",
                    "inputs.color = texture(materialParams_paper, getNormalizedUV()) + vec4(materialParams.ink, 0.0);"),
            PassPlace::Last);
    ASSERT_TRUE(engine.set(instance, "paper", stripes, kUnfilteredSampler));
    ASSERT_TRUE(engine.set(instance, "ink", float3(0, 0.25f, 0)));
    Image seen = light();
    EXPECT_EQ(test::halfPixel(seen, 2, 2), float4(1, 0.25f, 0, 1));
    EXPECT_EQ(test::halfPixel(seen, 22, 2), float4(0, 0.25f, 1, 1));
    ASSERT_TRUE(engine.set(instance, "ink", float3(0, 0.5f, 0)));
    ASSERT_TRUE(engine.set(instance, "paper", stripes,
                           Sampler{ .magFilter = Filter::Linear, .mipFilter = MipFilter::None }));
    seen = light();
    EXPECT_EQ(test::halfPixel(seen, 2, 2).y, 0.5f);
    EXPECT_NEAR(test::halfPixel(seen, 12, 2).x, 0.5f, 0.05f) << "between two texels";
}

TEST_P(InputsTest, ATextureOfTheAppReplacesThatOfTheFrame) {
    const std::array<uint8_t, 4> texel{ 0, 255, 0, 255 };
    const Owned<Texture> green =
            engine.own(engine.create(TextureDesc{ .pixels = std::as_bytes(std::span(texel)), .name = "green" }));
    const MaterialInstance instance =
            pass(passText(input("color"), "inputs.color = texture(materialParams_color, getNormalizedUV());"),
                 PassPlace::Last);
    EXPECT_NE(test::halfPixel(light(), 3, 3), float4(0, 1, 0, 1));
    ASSERT_TRUE(engine.set(instance, "color", green));
    EXPECT_EQ(test::halfPixel(light(), 3, 3), float4(0, 1, 0, 1));
}

TEST_P(InputsTest, ErrorsNameTheMaterialAndTheCure) {
    const auto refused = [&](std::string const& text, PassPlace place = PassPlace::Last) {
        clear();
        pass(text, place);
        EXPECT_FALSE(renderer.renderToImage(scene, view));
        return error();
    };
    const Image before = codes();
    EXPECT_THAT(refused(kSolid), HasSubstr("'solid' is of domain surface; say domain : postprocess"));
    const std::string unknown = refused(
            passText(input("colour"), "inputs.color = texelFetch(materialParams_colour, getPixel(), 0);", "typo"));
    EXPECT_THAT(unknown, HasSubstr("'typo' has no texture for 'colour'"));
    EXPECT_THAT(unknown, HasSubstr("did you mean 'color'?"));
    EXPECT_THAT(refused(passText("{ type : samplerCubemap, name : normals }",
                                 "inputs.color = texture(materialParams_normals, vec3(1.0));")),
                HasSubstr("has the input 'normals' as samplerCubemap; declare it as { type : sampler2d"));
    EXPECT_THAT(refused(passText("{ type : sampler2d, name : depth, currentPixel : true }",
                                 "inputs.color = getCurrentPixel(materialParams_depth);")),
                HasSubstr("only color can have it"));
    EXPECT_THAT(refused("material { name : mixed, domain : postprocess, blending : add }\n"
                        "fragment { void postProcess(inout PostProcessInputs inputs) { inputs.color = vec4(1.0); } }"),
                HasSubstr("'mixed' blends; leave blending out"));
    clear();
    passes.push_back({});
    view.postProcess = passes;
    EXPECT_FALSE(renderer.renderToImage(scene, view));
    EXPECT_THAT(error(), HasSubstr("has no material"));
    renderer.prewarm(scene, view, engine.own(engine.create(SwapChainDesc{ .size = view.size })));
    EXPECT_THAT(error(), HasSubstr("has no material"));

    clear();
    const Owned<Texture> film = engine.own(engine.create(
            TextureDesc{ .width = test::kPassSide, .height = test::kPassSide, .renderable = true, .name = "film" }));
    const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = film }));
    const MaterialInstance loop =
            pass(passText(input("paper"), "inputs.color = texelFetch(materialParams_paper, getPixel(), 0);", "loop"),
                 PassPlace::Last);
    ASSERT_TRUE(engine.set(loop, "paper", film));
    renderer.render(scene, view, target);
    EXPECT_THAT(error(), HasSubstr("'loop' samples by 'paper' what the frame draws to"));
    clear();
    EXPECT_EQ(codes().pixels, before.pixels) << "the next frame is drawn";
}

TEST_P(InputsTest, APassThatWasDestroyedIsNamed) {
    materials.push_back(test::loadMaterial(engine, kCounter));
    const MaterialInstance gone = engine.createInstance(materials.back(), "faded");
    passes.push_back({ gone, PassPlace::Last });
    view.postProcess = passes;
    engine.destroy(gone);
    EXPECT_DEATH((void)renderer.renderToImage(scene, view), "destroyed");
}

TEST_P(InputsTest, ExpectedFramesMakeTheirPipelines) {
    pass(kDistance, PassPlace::BeforeToneMapping);
    const Owned<SwapChain> target =
            engine.own(engine.create(SwapChainDesc{ .size = view.size, .format = Format::RGBA16F }));
    renderer.prewarm(scene, view, target);
    const auto asked = engine.compile(solid);
    ASSERT_TRUE(asked);
    while (!engine.progress(*asked).isComplete()) engine.waitIdle();
    engine.waitIdle();
    const uint64_t before = engine.statistics().pipelinesCreatedInPasses;
    renderer.render(scene, view, target);
    engine.waitIdle();
    EXPECT_EQ(engine.statistics().pipelinesCreatedInPasses, before);
}

} // namespace
} // namespace filament_core
