// SPDX-License-Identifier: Apache-2.0
// The engine's materials on both devices: the same bits, and energy is conserved.
#include "tests/shaders/exact/PictureFixture.h"

#include <algorithm>
#include <cmath>

namespace filament_core::shader {
namespace {

using test::MaterialScene;

class MaterialBits : public test::PictureFixture {
protected:
    static MaterialScene whiteFurnace(float metallic, float roughness) {
        MaterialScene scene;
        scene.parameters = { { "baseColorFactor", { 1, 1, 1, 1 } },
                             { "metallicFactor", { metallic } },
                             { "roughnessFactor", { roughness } } };
        scene.frame.ambient = { 1.0f, 0.0f, 3.0f, 0.0f };
        scene.frame.irradianceSh[0] = { 1, 1, 1, 0 };
        scene.frame.exposure.x = 1.0f;
        return scene;
    }

    static MaterialScene everything(uint8_t variant) {
        MaterialScene scene = whiteFurnace(0.6f, 0.7f);
        scene.variant = variant;
        scene.frame.irradianceSh[1] = { 0.3f, 0.1f, 0.2f, 0 };
        scene.frame.irradianceSh[6] = { -0.1f, 0.05f, 0.1f, 0 };
        scene.frame.sunDirection = { 0.36f, 0.48f, 0.8f, 1 };
        scene.frame.sunIlluminance = { 3.0f, 2.5f, 2.0f, 0 };
        scene.lights = {
            { { 0.5f, 0.4f, -1.2f, 0.04f }, { 2, 1, 0.5f, 0 }, { 0, 0, -1, 0 }, {} },
            { { -0.6f, -0.4f, -1.0f, 0.0f }, { 0.5f, 2, 1, 1 }, { 0.3f, 0.2f, -0.93f, 4.0f }, { -3.0f, 0, 0, 0 } }
        };
        const std::vector<float> uvMatrix{ 0.7f, 0.3f, 0, 0, -0.3f, 0.7f, 0, 0, 0.1f, 0.2f, 1 };
        for (const char* map : { "baseColor", "metallicRoughness", "normal", "occlusion", "emissive" }) {
            scene.parameters[std::string(map) + "UvMatrix"] = uvMatrix;
            scene.constants[std::string(map) + "Transform"] = 1;
        }
        for (const char* map : { "BaseColor", "MetallicRoughness", "Normal", "Occlusion", "Emissive" })
            scene.constants["has" + std::string(map) + "Map"] = 1;
        scene.constants["hasVertexColor"] = scene.constants["emissiveUv"] = 1;
        scene.parameters["normalScale"] = { 0.8f };
        scene.parameters["occlusionStrength"] = { 0.9f };
        scene.parameters["emissiveFactor"] = { 0.1f, 0.2f, 0.3f };
        return scene;
    }
};

TEST_F(MaterialBits, LitMaterialsReturnTheWholeEnergyOfAWhiteFurnace) {
    for (const float metallic : { 0.0f, 1.0f }) {
        for (const float roughness : { 0.1f, 0.4f, 0.7f, 1.0f }) {
            const std::vector<float> picture = draw(whiteFurnace(metallic, roughness));
            ASSERT_FALSE(picture.empty());
            size_t covered = 0;
            for (size_t i = 0; i < picture.size(); i += 4) {
                if (picture[i + 3] == 0.0f) continue; // background
                ++covered;
                ASSERT_NEAR(picture[i], 1.0f, 0.02f)
                        << "metallic " << metallic << " roughness " << roughness << " pixel " << i / 4;
            }
            EXPECT_GT(covered, 3000u);
        }
    }
}

TEST_F(MaterialBits, EveryVariantWithEveryFeatureHasTheSameBits) {
    struct Case {
        const char* material;
        uint8_t variant;
    };
    // The drivers need half a second for each material; the blending modes share their lighting, so one variant
    // suffices.
    for (Case const& each :
         { Case{ "gltf_lit_opaque", 0 }, Case{ "gltf_lit_opaque", 1 }, Case{ "gltf_lit_opaque", 2 },
           Case{ "gltf_lit_opaque", 3 }, Case{ "gltf_lit_masked", 3 }, Case{ "gltf_lit_blended", 3 } }) {
        MaterialScene scene = everything(each.variant);
        scene.material = each.material;
        scene.parameters["_maskThreshold"] = { 0.75f };
        const std::vector<float> picture = draw(scene);
        ASSERT_FALSE(picture.empty());
        const auto [least, most] = std::ranges::minmax(picture);
        EXPECT_GT(most - least, 0.5f) << "the picture must show something";
    }
}

TEST_F(MaterialBits, WithoutTheTexturesThatTheirConstantsSwitchOffTheyLookTheSame) {
    const std::vector<std::vector<const char*>> uses = { { "ClearCoat", "Anisotropy" },
                                                         { "Sheen", "Iridescence" },
                                                         {} };
    for (std::vector<const char*> const& used : uses) {
        MaterialScene scene = everything(kVariantSun);
        scene.material = "gltf_layered_opaque";
        scene.constants["hasNormalMap"] = scene.constants["hasOcclusionMap"] = used.size() % 2;
        scene.parameters["clearCoat"] = scene.parameters["anisotropyStrength"] =
                scene.parameters["iridescence"] = { 1 };
        scene.parameters["sheenColor"] = { 0.5f, 0.4f, 0.3f };
        scene.parameters["iridescenceThickness"] = { 200, 500 };
        for (const char* layer : used)
            scene.constants[std::string("has") + layer] = scene.constants["has" + (layer + std::string("Map"))] = 1;
        if (!used.empty() && used[0] == std::string("Sheen")) {
            scene.constants.erase("hasSheenMap");
            scene.constants["hasSheenColorMap"] = 1;
        }
        const std::vector<float> whole = draw(scene);
        scene.removesUnusedTextures = true;
        ASSERT_FALSE(whole.empty());
        EXPECT_EQ(draw(scene), whole) << (used.empty() ? "no layer" : used[0]);
    }
}

TEST_F(MaterialBits, UnlitMaterialsShowTheirColorAndHaveTheSameBits) {
    MaterialScene scene;
    scene.material = "gltf_unlit_opaque";
    scene.parameters["baseColorFactor"] = { 0.25f, 0.5f, 0.75f, 0.5f };
    const std::vector<float> picture = draw(scene);
    ASSERT_FALSE(picture.empty());
    const float* const center = &picture[(test::kPictureSide / 2 * test::kPictureSide + test::kPictureSide / 2) * 4];
    EXPECT_EQ(center[0], 0.25f);
    EXPECT_EQ(center[1], 0.5f);
    EXPECT_EQ(center[2], 0.75f);
    EXPECT_EQ(center[3], 1.0f) << "opaque materials ignore alpha";
    scene.material = "gltf_unlit_blended";
    const std::vector<float> blended = draw(scene);
    ASSERT_FALSE(blended.empty());
    EXPECT_EQ(blended[(test::kPictureSide / 2 * test::kPictureSide + test::kPictureSide / 2) * 4], 0.125f)
            << "pre-multiplied";
}

TEST_F(MaterialBits, SunAndPunctualLightsAddUp) {
    MaterialScene scene = everything(0);
    const std::vector<float> ambient = draw(scene);
    scene.variant = kVariantSun;
    const std::vector<float> sun = draw(scene);
    scene.variant = kVariantPunctual;
    const std::vector<float> punctual = draw(scene);
    scene.variant = kVariantSun | kVariantPunctual;
    const std::vector<float> both = draw(scene);
    ASSERT_FALSE(both.empty());
    double added = 0;
    for (size_t i = 0; i < both.size(); ++i) {
        if (i % 4 == 3) continue;
        const float expected = sun[i] + punctual[i] - ambient[i];
        ASSERT_NEAR(both[i], expected, 1e-4f * (1.0f + std::abs(expected)));
        added += static_cast<double>(both[i]) - static_cast<double>(ambient[i]);
    }
    EXPECT_GT(added, 10.0) << "the lights must be visible";
}

} // namespace
} // namespace filament_core::shader
