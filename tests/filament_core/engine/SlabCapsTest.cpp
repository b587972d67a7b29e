// SPDX-License-Identifier: Apache-2.0
// Caps of slabs, where rays enter and leave what is kept inside of a solid, on both APIs: their areas beside closed
// forms, what they hide and what is cut off hides, their light and shadows beside those of a plate, and their price.
#include "tests/filament_core/engine/SectionStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

#include <numbers>

namespace filament_core {
namespace {

constexpr const char* kCutFlat = R"(material { name : flat, shadingModel : unlit, sectionPlanes : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = isSectionCap() ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
} })";
/// Samples of a pixel are covered by alpha, as glTF's materials cover them.
constexpr const char* kMaskedFlat =
        R"(material { name : masked, shadingModel : unlit, sectionPlanes : true, blending : masked, alphaToCoverage : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(isSectionCap() ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), 1.0);
} })";
constexpr const char* kWholeFlat = R"(material { name : whole_flat, shadingModel : unlit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.0, 0.0, 1.0);
} })";

struct SlabCapsTest : testing::TestWithParam<Backend> {
    SectionStage stage{ GetParam() };
    Owned<Material> flat = test::loadMaterial(stage.engine, kCutFlat),
                    whole = test::loadMaterial(stage.engine, kWholeFlat);
    Owned<MaterialInstance> cut = stage.engine.own(stage.engine.createInstance(flat)),
                            uncut = stage.engine.own(stage.engine.createInstance(whole));

    void slab(double3 normal, double back, double front) {
        stage.view.section.planes[0] = sectionPlane(normal * front, -normal);
        stage.view.section.planes[4] = sectionPlane(normal * back, normal);
    }
    /// Sees `meters` of height along -`from`.
    void lookFrom(double3 from, float meters, uint2 size) {
        const double3 up = from.y != 0 ? double3(0, 0, 1) : double3(0, 1, 0);
        stage.view.camera = Camera::lookAt(from, double3(0), {}, {}, up);
        stage.view.camera.lens = { .orthographicHeight = meters };
        stage.view.size = size;
        stage.view.clearColor = float4(0, 0, 0, 1);
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, SlabCapsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// Square metres that are red (caps) and green (other surfaces).
double2 shownAreas(Image const& image, double meters) {
    double2 sum(0);
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            const float4 pixel = test::halfPixel(image, x, y);
            sum += double2(pixel.x, pixel.y);
        }
    return sum * (meters / image.height) * (meters / image.height);
}

TEST_P(SlabCapsTest, HaveTheAreaOfABallsCut) {
    constexpr double kHalf = 0.3, kMeters = 2.4;
    const SolidMesh ball(stage.engine, *makeUvSphere({ .radius = 1, .slices = 192, .stacks = 96 }));
    Scene scene(stage.engine);
    const Owned<Material> masked = test::loadMaterial(stage.engine, kMaskedFlat);
    const Owned<MaterialInstance> covered = stage.engine.own(stage.engine.createInstance(masked));
    ball.add(scene, covered, double4x4(1));
    slab({ 0, 0, 1 }, -kHalf, kHalf);
    const double disc = std::numbers::pi * (1 - kHalf * kHalf), ring = std::numbers::pi - disc;
    const double strip = 2 * (kHalf * std::sqrt(1 - kHalf * kHalf) + std::asin(kHalf));
    // Seen from the side of a plane, at 60 degrees: the cap, and the zone between the planes beside it.
    const double tilted = disc / 2;
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        stage.view.samples = samples;
        for (const double side : { -5.0, 5.0 }) {
            lookFrom({ 0, 0, side }, static_cast<float>(kMeters), uint2(128));
            const double2 along = shownAreas(test::renderLinear(stage.engine, scene, stage.view), kMeters);
            EXPECT_NEAR(along.x, disc, 0.01) << "along the planes' normal";
            EXPECT_NEAR(along.y, ring, 0.01);
            lookFrom({ 0, side, 0 }, static_cast<float>(kMeters), uint2(128));
            const double2 across = shownAreas(test::renderLinear(stage.engine, scene, stage.view), kMeters);
            EXPECT_EQ(across.x, 0) << "along the planes no ray crosses one";
            EXPECT_NEAR(across.y, strip, 0.01);
            lookFrom({ side * std::sqrt(0.75), 0, side / 2 }, static_cast<float>(kMeters), uint2(128));
            const double2 slanted = shownAreas(test::renderLinear(stage.engine, scene, stage.view), kMeters);
            EXPECT_NEAR(slanted.x, tilted, 0.01) << "half of them enter at 60 degrees";
        }
    }
}

TEST_P(SlabCapsTest, HideWhatLiesBehindAndNothingElseDoes) {
    Scene scene(stage.engine);
    const auto box = [&](MaterialInstance material, double3 at, double3 half) {
        stage.box.add(scene, material, glm::scale(glm::translate(double4x4(1), at), half));
    };
    box(cut, { -0.75, 0, 0 }, double3(0.5));             // in the slab, 1 m x 1 m
    box(cut, { 0, 0, -4 }, { 1.5, 1, 0.5 });             // all of it behind the slab
    box(cut, { 0.75, 0, 3 }, double3(0.5));              // before it
    box(uncut, { 0, 0, -8 }, { 2.5, 2.5, 0.5 });         // behind all
    box(uncut, { -0.75, 0.25, -2 }, { 0.5, 0.25, 0.2 }); // behind the upper half of the first
    slab({ 0, 0, 1 }, -0.2, 0.2);
    lookFrom({ 0, 0, 9 }, 4, uint2(64));
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        stage.view.samples = samples;
        const Image image = test::renderLinear(stage.engine, scene, stage.view);
        size_t wrong = 0;
        for (uint32_t y = 0; y < 64; ++y)
            for (uint32_t x = 0; x < 64; ++x) {
                const bool isCap = x >= 12 && x < 28 && y >= 24 && y < 40;
                wrong += float3(test::halfPixel(image, x, y)) != (isCap ? float3(1, 0, 0) : float3(0, 0, 1));
            }
        EXPECT_EQ(wrong, 0u) << int{ samples };
    }
    stage.view.section.caps = false;
    const Image open = test::renderLinear(stage.engine, scene, stage.view);
    EXPECT_EQ(float3(test::halfPixel(open, 20, 32)), float3(0, 0, 1)) << "without caps the slab of a box is a frame";
}

TEST_P(SlabCapsTest, ShowTheColourOfTheSolidThatTheRayIsIn) {
    Scene scene(stage.engine);
    const auto text = [](const char* color) { return sectioned("", std::string("vec3(") + color + ")"); };
    const Owned<Material> first = test::loadMaterial(stage.engine, text("0.25, 0.0, 0.0")),
                          second = test::loadMaterial(stage.engine, text("0.75, 0.0, 0.0"));
    const Owned<MaterialInstance> one = stage.engine.own(stage.engine.createInstance(first)),
                                  two = stage.engine.own(stage.engine.createInstance(second));
    // Drawn in either order, the one behind, of which the planes leave nothing, must not be seen.
    stage.box.add(scene, two, glm::translate(double4x4(1), double3(0, 0, -3)));
    stage.box.add(scene, one, double4x4(1));
    stage.box.add(scene, two, glm::translate(double4x4(1), double3(0, 0, -6)));
    slab({ 0, 0, 1 }, -0.5, 0.5);
    lookFrom({ 0, 0, 9 }, 4, uint2(32));
    const auto images = renderAovs(stage.engine, scene, stage.view, std::array{ Aov::BaseColor, Aov::Depth });
    ASSERT_TRUE(images);
    for (uint32_t y = 9; y < 23; ++y)
        for (uint32_t x = 9; x < 23; ++x) {
            EXPECT_EQ(aovNumberAt((*images)[0], { x, y }).x, 0.25f);
            EXPECT_NEAR(aovNumberAt((*images)[1], { x, y }).x, 8.5, 1e-4);
        }
}

/// What caps are made of.
constexpr const char* kCutPlaster = R"(material { name : plaster, shadingModel : lit, sectionPlanes : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.8);
} })";

TEST_P(SlabCapsTest, HaveTheLightAndTheShadowOfAPlate) {
    const Owned<Material> plaster = test::loadMaterial(stage.engine, kCutPlaster),
                          chalk = test::loadMaterial(stage.engine, test::kChalk);
    const Owned<MaterialInstance> white = stage.engine.own(stage.engine.createInstance(plaster)),
                                  floor = stage.engine.own(stage.engine.createInstance(chalk));
    const SolidMesh plate(stage.engine, *makeBox({ .size = { 2, 0.51f, 2 } }));
    const WhiteEnvironment sky(stage.engine);
    View view = stage.view;
    view.size = { 80, 64 };
    const auto draw = [&](bool isCut) {
        Scene scene(stage.engine);
        sky.light(scene, view.camera);
        stage.box.add(scene, floor, glm::scale(glm::translate(double4x4(1), double3(0, -1.7, 0)), { 6, 0.2, 6 }));
        if (isCut)
            stage.box.add(scene, white, double4x4(1));
        else
            plate.add(scene, white, glm::translate(double4x4(1), double3(0, 0.055, 0)));
        scene.add(SunLight{ .directionWorld = { -0.7f, -1, 0.4f } });
        View shown = view;
        if (isCut) {
            shown.section.planes[2] = sectionPlane({ 0, 0.31, 0 }, { 0, -1, 0 });
            shown.section.planes[3] = sectionPlane({ 0, -0.2, 0 }, { 0, 1, 0 });
        }
        return test::renderLinear(stage.engine, scene, shown);
    };
    const auto expectAlike = [&](const char* what, size_t most) {
        const Image slab = draw(true), twin = draw(false);
        size_t different = 0;
        for (uint32_t y = 0; y < slab.height; ++y)
            for (uint32_t x = 0; x < slab.width; ++x) {
                const float4 a = test::halfPixel(slab, x, y), b = test::halfPixel(twin, x, y);
                different += glm::length(a - b) > 0.01f * (1 + glm::length(b));
            }
        EXPECT_LE(different, most) << what;
    };
    for (const ShadowFilter filter : { ShadowFilter::Off, ShadowFilter::Hard, ShadowFilter::Pcf3 }) {
        view.quality.shadows = filter;
        expectAlike(toString(filter), 40);
    }
    view.effects.ambientOcclusion.enabled = true;
    expectAlike("occlusion", 60);
    view.effects.ambientOcclusion.enabled = false;
    view.quality.depthRange = DepthRange::Ordinary;
    expectAlike("ordinary depth", 40);
    view.samples = 4;
    expectAlike("several samples", 90);
}

TEST_P(SlabCapsTest, CostNothingWithOnePlane) {
    Scene scene(stage.engine);
    stage.box.add(scene, stage.instance, double4x4(1));
    scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.6f } });
    Renderer renderer(stage.engine);
    const auto graph = [&] {
        (void)test::renderLinear(stage.engine, renderer, scene, stage.view);
        return renderer.graphviz();
    };
    const std::string without = graph();
    stage.view.section.planes[0] = sectionPlane({ 0, 0.3, 0 }, { 0, -1, 0 });
    const std::string one = graph();
    EXPECT_EQ(one, without);
    stage.view.section.planes[1] = sectionPlane({ 0, -0.3, 0 }, { 0, 1, 0 });
    EXPECT_NE(graph(), one) << "a slab has depth with a stencil";
    stage.view.section.cut = SectionCut::Corner;
    EXPECT_EQ(graph(), one);
    stage.view.section = { .planes = stage.view.section.planes, .caps = false };
    EXPECT_EQ(graph(), one);
}

} // namespace
} // namespace filament_core
