// SPDX-License-Identifier: Apache-2.0
// Any number of suns: light adds up, whichever of them is the brightest.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

namespace filament_core {
namespace {

constexpr const char* kSunPaint = R"(material { name : paint, shadingModel : lit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.5);
    material.roughness = 0.8;
} })";

const SunLight kSuns[] = {
    { .directionWorld = { 0.3f, 0, -1 }, .illuminance = Lux{ 20'000 }, .color = { 1, 0.5f, 0 } },
    { .directionWorld = { 0, -0.5f, -1 }, .illuminance = Lux{ 50'000 } },
    { .directionWorld = { -0.7f, 0.2f, -1 }, .illuminance = Lux{ 30'000 }, .color = { 0, 0, 1 } }
};

TEST(Suns, SeveralGiveTheSumOfWhatEachGivesOnBothApis) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        const Owned<Material> material = test::loadMaterial(*engine, kSunPaint);
        const Owned<MaterialInstance> paint = engine->own(engine->createInstance(material));
        const test::SquareMesh square(*engine);
        const auto shownUnder = [&](std::span<const SunLight> suns) {
            Scene scene(*engine);
            square.add(scene, paint);
            for (SunLight const& sun : suns) scene.add(sun);
            return test::halfPixel(test::renderLinear(*engine, scene, test::SquareMesh::view()), 8, 8);
        };
        float4 sum(0);
        for (SunLight const& sun : kSuns) sum += shownUnder({ &sun, 1 });
        const float4 together = shownUnder(kSuns);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(together[c], sum[c], 2e-3f * sum[c]) << toString(backend);
        EXPECT_GT(together.x, 1.2f * shownUnder({ &kSuns[1], 1 }).x);
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
