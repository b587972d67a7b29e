// SPDX-License-Identifier: Apache-2.0
// Shadow maps on both APIs: which maps are drawn, and when; which materials cast and receive; and the same bits
// everywhere.
#include "tests/filament_core/engine/ShadowStage.h"

#include <map>

namespace filament_core {
namespace {

using prepare::Random;
using test::kShadowFilters;
using test::shadowedView;
using test::ShadowStage;

constexpr const char* kCatcher = R"(material { name : catcher, shadingModel : unlit, shadowMultiplier : true,
    blending : transparent }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(0.0, 0.25, 0.5, 0.5);
} })";

constexpr const char* kPane = R"(material { name : pane, shadingModel : unlit, blending : transparent,
    transparentShadow : true, transparency : twoPassesTwoSides, parameters : [ { type : float, name : alpha } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(0.0, 0.0, 0.0, materialParams.alpha);
} })";

constexpr const char* kVisible = R"(material { name : visible, shadingModel : lit, customSurfaceShading : true }
fragment {
    void material(inout MaterialInputs material) { prepareMaterial(material); }
    vec3 surfaceShading(const MaterialInputs inputs, const ShadingData shading, const LightData light) {
        return vec3(light.visibility, 1.0, light.NdotL);
    }
})";

/// `passesOfMaps`: of a frame that draws a map.
void expectMapsOfAStillSceneDrawnOnce(ShadowStage& stage, ShadowFilter filter, uint32_t passesOfMaps) {
    Scene scene(stage.engine);
    stage.square.add(scene, stage.white);
    const Renderable caster = stage.square.add(scene, stage.white, { 0, 0, 0.5 }, 0.3);
    scene.add(SunLight{ .directionWorld = { 0.5f, 0.2f, -1 } });
    Renderer renderer(stage.engine);
    View view = shadowedView({ 0.2, -1, 1.5 }, {}, filter);
    const auto passes = [&] {
        EXPECT_TRUE(renderer.renderToImage(scene, view).ok());
        return renderer.statistics().passesRun;
    };
    const uint32_t first = passes();
    EXPECT_EQ(passes(), first - passesOfMaps) << "a still light over a still scene";
    view.camera = Camera::lookAt({ 0.3, -1, 1.4 }, { 0.1, 0, 0 });
    EXPECT_EQ(passes(), first - passesOfMaps) << "and a moving camera";
    double4x4 moved(0.3);
    moved[3] = double4(0.1, 0, 0.5, 1);
    scene.setTransform(caster, moved);
    const Result<Image> again = renderer.renderToImage(scene, view);
    EXPECT_EQ(renderer.statistics().passesRun, first);
    Renderer other(stage.engine);
    const Result<Image> anew = other.renderToImage(scene, view);
    ASSERT_TRUE(again && anew);
    EXPECT_EQ(again->pixels, anew->pixels) << "a tile that is drawn over holds nothing of before";
}

TEST(Shadows, MapsOfAStillSceneAreDrawnOnce) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        expectMapsOfAStillSceneDrawnOnce(stage, ShadowFilter::Pcf3, 1);
        expectMapsOfAStillSceneDrawnOnce(stage, ShadowFilter::Vsm, 1 + 2 + 4); // the blur, and levels
    }
}

TEST(Shadows, FiltersMayChangeFromFrameToFrame) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        Scene scene(stage.engine);
        Random random(3);
        addCrowd(stage, scene, random, 1);
        Renderer renderer(stage.engine);
        View view = shadowedView({ 4, 3, 3 }, {}, ShadowFilter::Off, { 96, 80 });
        for (const ShadowFilter filter :
             { ShadowFilter::Pcf3, ShadowFilter::Vsm, ShadowFilter::Evsm, ShadowFilter::Vsm, ShadowFilter::Pcss }) {
            view.quality.shadows = filter;
            for (const uint8_t blur : { uint8_t{ 2 }, uint8_t{ 5 } }) {
                view.quality.shadowBlurTexels = blur;
                const Result<Image> image = renderer.renderToImage(scene, view);
                Renderer other(stage.engine);
                const Result<Image> anew = other.renderToImage(scene, view);
                ASSERT_TRUE(image && anew);
                EXPECT_EQ(image->pixels, anew->pixels) << toString(backend) << ' ' << toString(filter) << ' ' << +blur;
            }
        }
    }
}

TEST(Shadows, RandomScenesHaveTheSameBitsOnBothApis) {
    ShadowStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    for (uint32_t seed = 1; seed <= 24; ++seed) {
        std::vector<Image> images;
        for (ShadowStage* stage : { &vulkan, &gles }) {
            Random random(seed);
            const double scale = std::pow(10.0, random.within(-2, 2));
            Scene scene(stage->engine);
            addCrowd(*stage, scene, random, scale);
            const double3 eye = double3(random.within(-6, 6), random.within(-6, 6), random.within(0.5, 6)) * scale;
            View view = shadowedView(eye, { 0, 0, 0 }, kShadowFilters[seed % std::size(kShadowFilters)], { 96, 80 });
            view.quality.shadowCascades = static_cast<uint8_t>(1 + seed % 4);
            images.push_back(test::renderLinear(stage->engine, scene, view));
            view.quality.shadows = ShadowFilter::Off;
            EXPECT_GT(test::differingPixels(images.back(), test::renderLinear(stage->engine, scene, view)), 200u)
                    << seed;
        }
        EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << seed;
    }
}

TEST(Shadows, SixtyFourSpotsOverLittlestTokyoFitIntoTheAtlas) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        auto model = loadGltf(stage.engine,
                              std::filesystem::path(tools::assetDir()) / "models/LittlestTokyo/LittlestTokyo.glb");
        ASSERT_TRUE(model.ok()) << model.error().message;
        Scene scene(stage.engine);
        scene.add(*model, fitToUnitCube(model->bounds()));
        Random random(1);
        for (int i = 0; i < 64; ++i) {
            scene.add(SpotLight{ .positionWorld = { (i % 8 - 3.5) * 0.12, 0.7, (i / 8 - 3.5) * 0.12 },
                                 .directionWorld = { static_cast<float>(random.within(-0.4, 0.4)), -1,
                                                     static_cast<float>(random.within(-0.4, 0.4)) },
                                 .intensity = Candela{ 2'000 },
                                 .rangeMeters = 1.5f,
                                 .outerConeRadians = 0.4f });
        }
        View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                   .size = { 160, 90 } };
        Renderer renderer(stage.engine);
        const auto draw = [&] {
            Result<Image> image = renderer.renderToImage(scene, view);
            EXPECT_TRUE(image) << (image ? "" : image.error().message);
            return image ? std::move(*image) : Image{};
        };
        images.push_back(draw());
        EXPECT_NE(renderer.explain().find("64 maps, 64 of them drawn in this frame\n"), std::string::npos)
                << renderer.explain();
        EXPECT_EQ(draw().pixels, images.back().pixels);
        EXPECT_NE(renderer.explain().find("64 maps, 0 of them drawn in this frame\n"), std::string::npos)
                << renderer.explain();
        view.quality.shadowAtlasMegabytes = 1; // 512 x 512 texels
        EXPECT_NE(draw().pixels, images.back().pixels);
        EXPECT_EQ(renderer.explain().find("64 maps, 64 of them drawn in this frame; "), std::string::npos)
                << "maps get smaller before they are left out";
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

TEST(Shadows, TransparentObjectsOccludeTheirAlphaOfTheLight) {
    std::map<float, Image> first;
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const Owned<Material> material = test::loadMaterial(stage.engine, kPane);
        const Owned<MaterialInstance> pane = stage.engine.own(stage.engine.createInstance(material));
        Scene scene(stage.engine);
        stage.square.add(scene, stage.white);
        stage.square.add(scene, pane, { 0, 0, 5 }); // above the camera
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        View view = shadowedView({ 0, 0, 1 }, {}, ShadowFilter::Off);
        const float lit = test::halfPixel(test::renderLinear(stage.engine, scene, view), 32, 32).x;
        view.quality.shadows = ShadowFilter::Pcf5;
        for (const float alpha : { 0.0f, 0.25f, 0.5f, 0.8f, 1.0f }) {
            ASSERT_TRUE(stage.engine.set(pane, "alpha", alpha));
            const Image image = test::renderLinear(stage.engine, scene, view);
            double sum = 0;
            for (uint32_t y = 0; y < 64; ++y)
                for (uint32_t x = 0; x < 64; ++x) sum += test::halfPixel(image, x, y).x / lit / (64 * 64);
            EXPECT_NEAR(sum, 1 - alpha, 0.01);
            EXPECT_EQ(test::differingPixels(first.try_emplace(alpha, image).first->second, image), 0u);
        }
    }
}

// A square above the camera, whose front faces the light or does not: the map follows the culling of its material.
TEST(Shadows, FacesThatAreCulledStopNoLight) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const Owned<MaterialInstance> caster = stage.engine.own(stage.engine.createInstance(stage.material));
        for (const bool facesLight : { true, false }) {
            Scene scene(stage.engine);
            stage.square.add(scene, stage.white);
            const double turn = glm::radians(facesLight ? 0.0 : 180.0);
            stage.square.add(scene, caster,
                             glm::translate(double4x4(1), double3(0, 0, 5)) *
                                     glm::rotate(double4x4(1), turn, double3(1, 0, 0)) *
                                     glm::scale(double4x4(1), double3(0.3)));
            scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
            Renderer renderer(stage.engine);
            const View view = shadowedView({ 0, 0, 1 }, {}, ShadowFilter::Hard);
            for (const Culling culling : { Culling::Back, Culling::Front, Culling::None, Culling::FrontAndBack }) {
                stage.engine.setCulling(caster, culling);
                const Result<Image> image = renderer.renderToImage(scene, view);
                ASSERT_TRUE(image);
                const bool casts = culling == Culling::None || culling == (facesLight ? Culling::Back : Culling::Front);
                EXPECT_EQ(image->pixels[(32 * 64 + 32) * 4] == std::byte{ 0 }, casts)
                        << toString(backend) << ' ' << facesLight << ' ' << static_cast<int>(culling);
            }
        }
    }
}

// The same square: whatever faces are drawn, those that are chosen cast.
TEST(Shadows, FacesThatAreChosenForThemStopLight) {
    for (const bool facesLight : { true, false }) {
        ShadowStage stage(Backend::Vulkan);
        const Owned<MaterialInstance> caster = stage.engine.own(stage.engine.createInstance(stage.material));
        Scene scene(stage.engine);
        stage.square.add(scene, stage.white);
        const double turn = glm::radians(facesLight ? 0.0 : 180.0);
        stage.square.add(scene, caster,
                         glm::translate(double4x4(1), double3(0, 0, 5)) *
                                 glm::rotate(double4x4(1), turn, double3(1, 0, 0)) *
                                 glm::scale(double4x4(1), double3(0.3)));
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        Renderer renderer(stage.engine);
        const View view = shadowedView({ 0, 0, 1 }, {}, ShadowFilter::Hard);
        const auto expectCasts = [&](bool casts, const char* what) {
            const Result<Image> image = renderer.renderToImage(scene, view);
            ASSERT_TRUE(image);
            EXPECT_EQ(image->pixels[(32 * 64 + 32) * 4] == std::byte{ 0 }, casts) << what << facesLight;
        };
        for (const Culling drawn : { Culling::Back, Culling::Front, Culling::None }) {
            stage.engine.setCulling(caster, drawn);
            stage.engine.setShadowCulling(caster, Culling::Back);
            expectCasts(facesLight, "front faces, ");
            stage.engine.setShadowCulling(caster, Culling::Front);
            expectCasts(!facesLight, "back faces, ");
            stage.engine.setShadowCulling(caster, Culling::None);
            expectCasts(true, "both, ");
            stage.engine.setShadowCulling(caster, Culling::FrontAndBack);
            expectCasts(false, "none, ");
        }
        stage.engine.setShadowCulling(caster, {});
        expectCasts(true, "as drawn, ");
    }
}

TEST(Shadows, CatchersShowTheirColourWhereTheSunDoesNot) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const Owned<Material> material = test::loadMaterial(stage.engine, kCatcher);
        const Owned<MaterialInstance> catcher = stage.engine.own(stage.engine.createInstance(material));
        Scene scene(stage.engine);
        stage.square.add(scene, catcher);
        stage.square.add(scene, stage.white, { 0, 0, 5 }, 0.3); // above the camera
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        View view = test::SquareMesh::view({ 64, 64 });
        view.quality.shadows = ShadowFilter::Hard;
        view.clearColor = { 0, 0, 0, 0 };
        const Image image = test::renderLinear(stage.engine, scene, view);
        const float4 dark = test::halfPixel(image, 32, 32), lit = test::halfPixel(image, 4, 4);
        EXPECT_EQ(lit, float4(0)) << toString(backend);
        EXPECT_NEAR(dark.y, 0.25f, 1e-3f);
        EXPECT_NEAR(dark.w, 0.5f, 1e-3f);
    }
}

TEST(Shadows, AuthorsModelsSeeTheVisibilityOfALight) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const Owned<Material> material = test::loadMaterial(stage.engine, kVisible);
        const Owned<MaterialInstance> shaded = stage.engine.own(stage.engine.createInstance(material));
        Scene scene(stage.engine);
        stage.square.add(scene, shaded);
        stage.square.add(scene, stage.white, { 0, 0, 5 }, 0.3);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        View view = test::SquareMesh::view({ 64, 64 });
        view.quality.shadows = ShadowFilter::Hard;
        const Image image = test::renderLinear(stage.engine, scene, view);
        EXPECT_EQ(test::halfPixel(image, 32, 32), float4(0, 1, 1, 1)) << toString(backend);
        EXPECT_EQ(test::halfPixel(image, 4, 4), float4(1, 1, 1, 1));
    }
}

TEST(Shadows, MaterialsWithoutVarianceShadowsReceiveNone) {
    constexpr const char* kPlain = R"(material { name : plain, shadingModel : lit, variantFilter : [ vsm ] }
        fragment { void material(inout MaterialInputs material) {
            prepareMaterial(material);
            material.baseColor.rgb = vec3(0.8);
        } })";
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const Owned<Material> material = test::loadMaterial(stage.engine, kPlain);
        const Owned<MaterialInstance> plain = stage.engine.own(stage.engine.createInstance(material));
        Scene scene(stage.engine);
        stage.square.add(scene, plain);
        stage.square.add(scene, stage.white, { 0, 0, 5 }, 0.3);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
        const auto picture = [&](ShadowFilter filter) {
            return test::renderLinear(stage.engine, scene, shadowedView({ 0, 0, 1 }, {}, filter));
        };
        const Image lit = picture(ShadowFilter::Off);
        EXPECT_EQ(test::differingPixels(lit, picture(ShadowFilter::Vsm)), 0u);
        EXPECT_EQ(test::differingPixels(lit, picture(ShadowFilter::Evsm)), 0u);
        EXPECT_GT(test::differingPixels(lit, picture(ShadowFilter::Pcf3)), 0u);
    }
}

TEST(Shadows, RenderablesThatReceiveNoneAreLitAmongOthersThatDo) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const auto centreOf = [&](bool receives) {
            Scene scene(stage.engine);
            scene.add({ .vertices = stage.square.vertices(),
                        .indices = stage.square.indices(),
                        .material = stage.white,
                        .bounds = Box{ double3(-1, -1, 0), double3(1, 1, 0) },
                        .receivesShadows = receives });
            stage.square.add(scene, stage.white, { 0, 0, 5 }, 0.3);
            stage.square.add(scene, stage.white, { 0.9, 0.9, 0.1 }, 0.01);
            scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
            View view = test::SquareMesh::view({ 64, 64 });
            view.quality.shadows = ShadowFilter::Hard;
            return test::halfPixel(test::renderLinear(stage.engine, scene, view), 32, 32).x;
        };
        EXPECT_EQ(centreOf(true), 0);
        EXPECT_GT(centreOf(false), 0);
    }
}

} // namespace
} // namespace filament_core
