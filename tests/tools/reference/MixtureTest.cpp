// SPDX-License-Identifier: Apache-2.0
// glTF materials that transmit, partly metallic and under thin films, in furnaces and against closed forms.
#include "tests/tools/reference/TestScenes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Mixture.h"

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

assets::MaterialData sheetOf(float transmission, float metallic, float film) {
    assets::MaterialData material = metal(0.1f); // rougher sheets lose what their facets send to each other
    material.metallicFactor = metallic;
    material.transmission.factor = transmission;
    material.iridescence = { .factor = film, .ior = 1.6f, .thicknessMaxNanometers = 450 };
    material.doubleSided = true;
    return material;
}

TEST(Mixture, WhiteSheetsAreInvisibleInAWhiteFurnaceWhateverTheyMix) {
    for (const float transmission : { 0.25f, 1.0f }) {
        for (const float metallic : { 0.0f, 0.5f, 1.0f }) {
            for (const float film : { 0.0f, 1.0f }) {
                ReferenceScene scene{
                    .models = { { makeModel(floorPrimitive(), sheetOf(transmission, metallic, film)) } }
                };
                scene.environment = uniformSky();
                const ReferenceSettings settings{ .samplesPerPixel = 1024 };
                const Estimate estimate = estimated(scene, viewFrom({ 0, 4, 0.5 }, { 0, 0, 0 }), settings);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(estimate.mean[c], 1, 0.005 + 4 * estimate.error[c])
                            << transmission << " metallic " << metallic << " film " << film << " component " << c;
                }
            }
        }
    }
}

TEST(Mixture, APathMeetsEachPartAsOftenAsItsShareAndTheMeanIsTheWhole) {
    constexpr int kCount = 1 << 12;
    SurfaceSample whole;
    whole.metallic = 0.25;
    whole.diffuse = double3(0.8 * 0.75 * 0.4);
    whole.transmission = { .color = double3(0.8 * 0.75 * 0.6), .share = 0.75 * 0.6 };
    whole.mixture = MixtureSample{ .color = double3(0.8), .transmitted = 0.6 };
    double metals = 0, diffuse = 0, transmitted = 0;
    for (int i = 0; i < kCount; ++i) {
        SurfaceSample part = whole;
        meetPart(part, (i + 0.5) / kCount);
        EXPECT_FALSE(part.mixture);
        metals += part.metallic / kCount;
        diffuse += part.diffuse.x / kCount;
        transmitted += part.transmission.color.x / kCount;
        EXPECT_EQ(part.f0.x, part.metallic == 1 ? 0.8 : 0.04);
    }
    EXPECT_NEAR(metals, 0.25, 1e-3);
    EXPECT_NEAR(diffuse, whole.diffuse.x, 1e-3);
    EXPECT_NEAR(transmitted, whole.transmission.color.x, 1e-3);
}

// A smooth mirror under a film in a white sky reflects the film's reflectance.
TEST(Mixture, AFilmColoursAMirrorByItsReflectance) {
    assets::MaterialData material = metal(0, float3(0.5f));
    material.iridescence = { .factor = 1, .ior = 1.4f, .thicknessMaxNanometers = 400 };
    ReferenceScene scene{ .models = { { makeModel(floorPrimitive(), material) } } };
    scene.environment = uniformSky();
    const double3 eye(3, 4, 0);
    const Estimate estimate = estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f), { .samplesPerPixel = 64 });
    const double3 expected = lib::fresnelIridescent(1.0, 1.4, double3(0.5), 400.0, glm::normalize(eye).y);
    EXPECT_GT(std::abs(expected.x - expected.z), 0.05) << "coloured";
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(estimate.mean[c], expected[c], 0.01);
}

TEST(Mixture, WithoutAFilmNothingChanges) {
    SurfaceSample surface;
    surface.f0 = double3(0.3);
    coverWithFilm(surface);
    EXPECT_EQ(surface.f0, double3(0.3));
    EXPECT_EQ(surface.f90, 1);
}

} // namespace
} // namespace filament_core::reference
