// SPDX-License-Identifier: Apache-2.0
// Where passes of the app are drawn, and that frames without them are what they were.
#include "tests/filament_core/engine/postprocess/PassStage.h"

namespace filament_core {
namespace {

using test::input;
using test::kPassSide;
using test::PassStage;
using test::passText;

struct PlacesTest : testing::TestWithParam<Backend>, PassStage {
    PlacesTest() : PassStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, PlacesTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

const std::string kDoubled = passText(input("color"), R"(vec4 color = texelFetch(materialParams_color, getPixel(), 0);
    inputs.color = vec4(2.0 * color.rgb, color.a);)");
const std::string kInverse = passText(input("color"), R"(vec4 color = texelFetch(materialParams_color, getPixel(), 0);
    inputs.color = vec4(1.0 - color.rgb, color.a);)");
const std::string kHere = passText("{ type : sampler2d, name : color, currentPixel : true }",
                                   "inputs.color = getCurrentPixel(materialParams_color) * vec4(vec3(0.5), 1.0);");

TEST_P(PlacesTest, LightBeforeToneMappingIsLight) {
    const Image plain = light();
    pass(kDoubled, PassPlace::BeforeToneMapping);
    const Image seen = light();
    for (uint32_t y = 0; y < kPassSide; ++y)
        for (uint32_t x = 0; x < kPassSide; ++x)
            EXPECT_EQ(float3(test::halfPixel(seen, x, y)), 2.0f * float3(test::halfPixel(plain, x, y)));
    pass(kHere, PassPlace::BeforeToneMapping);
    EXPECT_EQ(test::differingPixels(light(), plain), 0u) << "half of twice the light, in the order of the list";
}

TEST_P(PlacesTest, TransparentObjectsCoverWhatFollowsOpaqueOnes) {
    add(flat, { 0.25f, 0, 0, 0.5f }, { 0, 0, 0.5 }, 0.5);
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        clear();
        view.samples = samples;
        const Image plain = light();
        pass(passText("", "inputs.color = vec4(0.0, 0.5, 0.0, 1.0);"), PassPlace::AfterOpaque);
        const Image seen = light();
        EXPECT_EQ(test::halfPixel(seen, 1, 1), float4(0, 0.5f, 0, 1));
        EXPECT_EQ(test::halfPixel(seen, 12, 12), float4(0.25f, 0.25f, 0, 1)) << "half of what lies behind";
        EXPECT_NE(test::halfPixel(plain, 12, 12), test::halfPixel(seen, 12, 12));
    }
}

TEST_P(PlacesTest, CodesAfterToneMappingAreThoseOfTheDisplay) {
    for (const PassPlace place : { PassPlace::AfterToneMapping, PassPlace::Last }) {
        clear();
        const Image plain = codes();
        pass(kInverse, place);
        const Image seen = codes();
        ASSERT_EQ(seen.pixels.size(), plain.pixels.size());
        for (size_t i = 0; i < seen.pixels.size(); ++i) {
            const int was = std::to_integer<int>(plain.pixels[i]), is = std::to_integer<int>(seen.pixels[i]);
            // Before it is stored, a code has a fraction.
            EXPECT_LE(std::abs(is - (i % 4 == 3 ? was : 255 - was)), place == PassPlace::Last ? 0 : 1) << i;
        }
    }
}

TEST_P(PlacesTest, NoiseOfTheFrameFollowsThePassesAfterToneMapping) {
    view.display.dither = true;
    view.effects.grain.enabled = true;
    const Image plain = codes();
    pass(passText(input("color"), "inputs.color = texelFetch(materialParams_color, getPixel(), 0);"),
         PassPlace::AfterToneMapping);
    EXPECT_LE(test::differenceOf(codes(), plain).largest, 1) << "a half float between the passes";
    pass(passText("", "inputs.color = vec4(0.5);"), PassPlace::AfterToneMapping);
    EXPECT_GT(test::differenceOf(codes(), plain).pixels, 0u);
    const Image noise = codes();
    EXPECT_NE(test::bytePixel(noise, 3, 4), test::bytePixel(noise, 9, 5)) << "over a constant";
    clear();
    pass(passText("", "inputs.color = vec4(0.5);"), PassPlace::Last);
    const Image even = codes();
    for (size_t i = 4; i < even.pixels.size(); ++i) EXPECT_EQ(even.pixels[i], even.pixels[i - 4]);
}

TEST_P(PlacesTest, PassesOfAllPlacesFollowEachOther) {
    // Codes of a linear tone mapper without a curve: each place adds a share that only it has.
    const auto adding = [](const char* share) {
        return passText(input("color"), std::string("inputs.color = texelFetch(materialParams_color, getPixel(), 0) + "
                                                    "vec4(vec3(") +
                                                share + "), 0.0);");
    };
    view.clearColor = { 0, 0, 0, 1 };
    pass(adding("0.25"), PassPlace::Last); // the order of the list is that of one place
    pass(adding("0.125"), PassPlace::AfterToneMapping);
    pass(adding("0.5"), PassPlace::BeforeToneMapping);
    pass(adding("0.0625"), PassPlace::AfterOpaque);
    EXPECT_EQ(float3(test::halfPixel(light(), 0, 0)), float3(0.9375f));
    for (PostProcessPass const& one : passes) {
        View only = view;
        only.postProcess = std::span(&one, 1);
        const Image seen = test::renderLinear(engine, scene, only);
        EXPECT_GT(test::halfPixel(seen, 0, 0).x, 0) << toString(one.place);
    }
}

TEST_P(PlacesTest, DebugViewsAndAovsShowTheFrameWithoutPasses) {
    view.debugView = DebugView::Normals;
    const Image plain = codes();
    pass(kInverse, PassPlace::Last);
    EXPECT_EQ(codes().pixels, plain.pixels);
    view.debugView = DebugView::None;
    EXPECT_NE(codes().pixels, plain.pixels);
}

/// What can follow the tone mapper, and what can come before.
std::vector<std::pair<const char*, View>> viewsWithPasses(View const& plain) {
    std::vector<std::pair<const char*, View>> views;
    const auto add = [&](const char* name, auto const& change) {
        views.emplace_back(name, plain);
        change(views.back().second);
    };
    add("plain", [](View&) {});
    add("samples", [](View& view) { view.samples = 4, view.quality.msaaResolve = MsaaResolve::ToneAware; });
    add("fxaa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Fxaa; });
    add("taa", [](View& view) {
        view.quality.antiAliasing = AntiAliasing::Taa;
        view.effects.resolution.scale = float2(0.5f);
    });
    add("sraa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Sraa; });
    add("enlarged", [](View& view) {
        view.effects.resolution.scale = float2(0.5f);
        view.effects.sharpening.enabled = true;
    });
    add("bloom in a band", [](View& view) {
        view.effects.bloom.enabled = view.effects.grain.enabled = true;
        view.effects.guardBand.enabled = true;
    });
    add("a part", [](View& view) {
        view.size = { 15, 11 };
        view.viewport = filament_core::Viewport{ .offset = { 5, 4 } };
    });
    add("translucent", [](View& view) {
        view.clearColor = { 0.5f, 0.25f, 0, 0.5f };
        view.viewport = filament_core::Viewport{ .blending = ViewBlending::Translucent };
    });
    return views;
}

const std::string kEverything = passText(input("color") + ", " + input("depth") + ", " + input("normals") + ", " +
                                                 input("history") + ", { type : float, name : share }",
                                         R"(vec2 at = getNormalizedUV();
    vec4 color = texture(materialParams_color, at);
    vec3 normal = texture(materialParams_normals, at).xyz;
    float near = 1.0 / (1.0 + texture(materialParams_depth, at).x);
    vec4 history = texture(materialParams_history, at);
    inputs.color = vec4(mix(color.rgb + 0.125 * near * (normal + 1.0), history.rgb, materialParams.share), color.a);)");

std::vector<Image> picturesOfEveryView(PassStage& stage, PassPlace place) {
    stage.add(stage.flat, { 0.25f, 0, 0, 0.5f }, { 0, 0, 0.5 }, 0.5);
    EXPECT_TRUE(stage.engine.set(stage.pass(kEverything, place), "share", 0.25f));
    std::vector<Image> images;
    for (auto& [name, view] : viewsWithPasses(stage.view)) {
        Renderer renderer(stage.engine);
        const Owned<SwapChain> target =
                stage.engine.own(stage.engine.create(SwapChainDesc{ .size = uint2(kPassSide), .imageCount = 1 }));
        for (int frame = 0; frame < 3; ++frame) {
            view.camera = Camera::lookAt({ 0.1 * frame, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 });
            renderer.render(stage.scene, view, target);
            auto image = renderer.waitPixels(renderer.readPixels(target));
            EXPECT_TRUE(image) << name;
            if (image) images.push_back(std::move(*image));
        }
    }
    return images;
}

class SameBitsOfPlace : public testing::TestWithParam<PassPlace> {};
INSTANTIATE_TEST_SUITE_P(EveryPlace, SameBitsOfPlace,
                         testing::Values(PassPlace::AfterOpaque, PassPlace::BeforeToneMapping,
                                         PassPlace::AfterToneMapping, PassPlace::Last),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(SameBitsOfPlace, OnBothApisWithAnyNumberOfWorkers) {
    const std::vector<Image> images =
            test::sameOnBothApis<PassStage>([&](PassStage& stage) { return picturesOfEveryView(stage, GetParam()); });
    PassStage many(Backend::Vulkan, 3);
    const std::vector<Image> others = picturesOfEveryView(many, GetParam());
    ASSERT_EQ(others.size(), images.size());
    for (size_t i = 0; i < images.size(); ++i) {
        EXPECT_EQ(others[i].pixels, images[i].pixels) << i;
        if (i % 3 == 0) continue;
        EXPECT_NE(images[i].pixels, images[i - 1].pixels) << "the camera moves: " << i;
    }
}

} // namespace
} // namespace filament_core
