// SPDX-License-Identifier: Apache-2.0
// Small models that were drawn wrong once: what their makers meant to look alike does.
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Gltf.h>

#include <memory>

namespace filament_core::fault_pictures {
namespace {

struct Shot {
    const char* file;
    double3 eye{ 0, 0, 3 }, at{ 0 };
    float fov = 45;
    SunLight sun{ .directionWorld = { -0.7f, -0.5f, -0.5f }, .illuminance = Lux{ 3 } };
    uint2 size{ 64, 64 };
};

Image draw(Shot const& shot) {
    return test::onBothApis([&](test::MaterialStage& stage) {
        Result<Model> model = loadGltf(stage.engine, assets::faultFile(shot.file));
        ASSERT_TRUE(model) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept);
        stage.scene.add(shot.sun);
        stage.view.clearColor = float4(1);
        stage.view.size = shot.size;
        stage.view.camera = Camera::lookAt(shot.eye, shot.at, { .verticalFovDegrees = shot.fov });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
    });
}

using assets::hasFaultFiles;

/// The largest difference of a colour in the square of `side` pixels around two places, as a share of the brightest.
double largestDifference(Image const& a, uint2 inA, Image const& b, uint2 inB, uint32_t side) {
    double largest = 0, brightest = 1e-6;
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const float4 one = test::halfPixel(a, inA.x + x, inA.y + y), two = test::halfPixel(b, inB.x + x, inB.y + y);
            for (int c = 0; c < 3; ++c) {
                largest = std::max(largest, double(std::abs(one[c] - two[c])));
                brightest = std::max(brightest, double(std::max(one[c], two[c])));
            }
        }
    }
    return largest / brightest;
}

TEST(FaultPictures, FiveDomesAreLitFromOneSide) {
    const Shot domes{ .file = "normal_transform_domes.glb",
                      .eye = { 2, 0, 20 },
                      .at = { 2, 0, 0 },
                      .fov = 14.25f,
                      .size = { 500, 500 } };
    SKIP_WITHOUT_FAULT_FILES();
    const Image image = draw(domes);
    // A metre is 100 pixels in the plane of the domes, give or take; their middles lie at x = 0, 1, ... 4.
    const auto corner = [](uint32_t dome) { return uint2(30 + 100 * dome, 230); };
    for (uint32_t dome = 1; dome < 5; ++dome)
        EXPECT_LT(largestDifference(image, corner(dome), image, corner(0), 40), 0.05) << "dome " << dome;
}

TEST(FaultPictures, ACoatIsTiltedByItsOwnMapWhateverTheBaseHas) {
    const Shot both{ .file = "clearcoat_normal_other_uv_both.glb" };
    const Shot alone{ .file = "clearcoat_normal_other_uv_alone.glb" };
    SKIP_WITHOUT_FAULT_FILES();
    EXPECT_LT(largestDifference(draw(both), uint2(0), draw(alone), uint2(0), 64), 0.02);
}

TEST(FaultPictures, SmallNearestMapsAreThoseOfTheReference) {
    const Shot small{ .file = "packed_size_nearest_small.glb" }, large{ .file = "packed_size_nearest_reference.glb" };
    SKIP_WITHOUT_FAULT_FILES();
    EXPECT_LT(largestDifference(draw(small), uint2(0), draw(large), uint2(0), 64), 0.002);
}

} // namespace
} // namespace filament_core::fault_pictures
