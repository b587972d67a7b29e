// SPDX-License-Identifier: Apache-2.0
// Quality choices of the view as images: texture filters, depth ranges, positions relative to the camera.
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <cmath>

namespace filament_core {
namespace {

using test::Patch;

class QualityViewTest : public testing::TestWithParam<Backend> {};

constexpr float kStep = 40.0f / 255; // each mip level of stepTexture() is this much brighter than the previous one

/// 128 x 128; level n holds n * kStep, so that a pixel tells which levels it was made of.
Owned<Texture> stepTexture(Engine& engine) {
    std::vector<uint8_t> texels;
    for (uint32_t level = 0; level < 7; ++level) {
        const size_t count = size_t{ 128u >> level } * (128u >> level);
        for (size_t i = 0; i < count; ++i) {
            for (const uint32_t value : { level * 40, level * 40, level * 40, 255u })
                texels.push_back(static_cast<uint8_t>(value));
        }
    }
    return engine.own(engine.create(
            TextureDesc{ .width = 128, .height = 128, .levels = 7, .pixels = std::as_bytes(std::span(texels)) }));
}

MaterialDesc textured() {
    return { .package = shader::engineMaterial("gltf_unlit_opaque"), .constants = { { "hasBaseColorMap", true } } };
}

MaterialDesc plain() { return { .package = shader::engineMaterial("gltf_unlit_opaque") }; }

/// The centre of a patch with stepTexture(), in levels.
float levelSeen(Engine& engine, double viewDegrees, TextureFilter filter, Sampler const& sampler = kUnfilteredSampler) {
    const Owned<Texture> texture = stepTexture(engine);
    Patch patch(engine, viewDegrees, textured());
    EXPECT_TRUE(engine.set(patch.instance(), "baseColorFactor", float4(1)));
    EXPECT_TRUE(engine.set(patch.instance(), "baseColorMap", texture, sampler));
    patch.view.quality.textureFilter = filter;
    return patch.renderCenter().x / kStep;
}

// A pixel covers 0.349 m / 16 / 2 m * 128 = 1.396 texels: log2 of it is 0.48. Seen from 60 degrees, twice that in x.
TEST_P(QualityViewTest, EachTextureFilterReadsTheLevelsThatItsNameSays) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    EXPECT_EQ(levelSeen(*engine, 0, TextureFilter::AsAuthored), 0.0f) << "the sampler asks for no mip levels";
    const float bilinear = levelSeen(*engine, 60, TextureFilter::Bilinear);
    EXPECT_NEAR(bilinear, std::round(bilinear), 0.01f) << "one level";
    EXPECT_GT(bilinear, 0.99f);
    EXPECT_NEAR(levelSeen(*engine, 0, TextureFilter::Trilinear), 0.48f, 0.1f);
    EXPECT_NEAR(levelSeen(*engine, 60, TextureFilter::Trilinear), 1.48f, 0.1f);
    EXPECT_LT(levelSeen(*engine, 60, TextureFilter::Anisotropic), 0.9f) << "the short side of the footprint decides";
    test::expectNoErrors(*engine);
}

TEST_P(QualityViewTest, ASamplerIsTrilinearAndRepeatsUnlessItSaysOtherwise) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    EXPECT_EQ(levelSeen(*engine, 60, TextureFilter::AsAuthored, Sampler{}),
              levelSeen(*engine, 60, TextureFilter::Trilinear));
    EXPECT_EQ(Sampler{}.wrapU, WrapMode::Repeat);
    EXPECT_EQ(Sampler{}.wrapV, WrapMode::Repeat);
    test::expectNoErrors(*engine);
}

TEST_P(QualityViewTest, ATextureFilterMayChangeFromFrameToFrame) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const Owned<Texture> texture = stepTexture(*engine);
    Patch patch(*engine, 60, textured());
    ASSERT_TRUE(engine->set(patch.instance(), "baseColorFactor", float4(1)));
    ASSERT_TRUE(engine->set(patch.instance(), "baseColorMap", texture, kUnfilteredSampler));
    const float authored = patch.renderCenter().x;
    patch.view.quality.textureFilter = TextureFilter::Trilinear;
    EXPECT_GT(patch.renderCenter().x, authored);
    patch.view.quality.textureFilter = TextureFilter::AsAuthored;
    EXPECT_EQ(patch.renderCenter().x, authored);
    test::expectNoErrors(*engine);
}

/// The number of pixels of two patches, 2 mm apart and 40 m away, that show the colour of the one behind.
size_t pixelsOfThePatchBehind(Engine& engine, DepthRange range, bool swapMaterials) {
    Patch patch(engine, 0, plain());
    const Owned<Material> material = engine.own(*engine.create(plain()));
    const Owned<MaterialInstance> other = engine.own(engine.createInstance(material));
    const float4 front(0, 1, 0, 1), behind(1, 0, 0, 1);
    EXPECT_TRUE(engine.set(patch.instance(), "baseColorFactor", swapMaterials ? behind : front));
    EXPECT_TRUE(engine.set(other, "baseColorFactor", swapMaterials ? front : behind));
    const Renderable second = patch.add(other, { 0, 0, swapMaterials ? 0.002 : -0.002 });
    patch.view.quality.depthRange = range;
    const Image image = patch.render();
    size_t count = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) count += test::halfPixel(image, x, y).x > 0.5f;
    }
    patch.scene.remove(second); // before its material goes
    return count;
}

// A step of ordinary depth at 40 m is 2^-24 * 40^2 / 0.01 m = 1 cm; of reversed depth, some micrometres.
TEST_P(QualityViewTest, OrdinaryDepthFightsInTheDistanceAndReversedDepthDoesNot) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    size_t fought = 0;
    for (const bool swapMaterials : { false, true }) {
        EXPECT_EQ(pixelsOfThePatchBehind(*engine, DepthRange::Reversed, swapMaterials), 0u);
        fought += pixelsOfThePatchBehind(*engine, DepthRange::Ordinary, swapMaterials);
    }
    EXPECT_GT(fought, 0u);
    test::expectNoErrors(*engine);
}

Image patchAt(Engine& engine, double3 place, Quality const& quality) {
    Patch patch(engine, 60);
    patch.setSurface({ 0.8f, 0.5f, 0.2f, 1 }, 0, 0.5f);
    patch.addSun({ 0, 0, 1 });
    patch.view.camera.lens.verticalFovDegrees = 5; // the edges of the patch are in view
    patch.view.camera.worldFromView[3] += double4(place, 0);
    double4x4 world(1.0);
    world[3] = double4(place, 1);
    patch.scene.setTransform(patch.renderable, world);
    patch.view.quality = quality;
    return patch.render();
}

TEST_P(QualityViewTest, OnlyRelativeToTheCameraAPictureIsTheSameFarFromTheOrigin) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const double3 far(1e8, 0, 0); // floats are 8 m apart
    const Quality relative, absolute{ .cameraRelative = false };
    const Image here = patchAt(*engine, double3(0), relative);
    EXPECT_EQ(patchAt(*engine, far, relative).pixels, here.pixels);
    EXPECT_NE(patchAt(*engine, far, absolute).pixels, here.pixels);
    const Image absoluteHere = patchAt(*engine, double3(0), absolute);
    EXPECT_NEAR(test::halfPixel(absoluteHere, 8, 8).x, test::halfPixel(here, 8, 8).x, 0.01f);
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityViewTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
