// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/LoadMaterial.h"

#include "shaders/package/EngineMaterials.h"

#include <gtest/gtest.h>

namespace filament::engine {
namespace {

scene::Material load(std::vector<MaterialConstant> constants) {
    auto material = loadMaterial(
            { .package = shader::engineMaterial("gltf_layered_opaque"), .constants = std::move(constants) });
    EXPECT_TRUE(material) << (material ? "" : material.error().message);
    return material ? std::move(*material) : scene::Material{};
}

/// Of the maps of gltf_layered, with some packed in pairs.
constexpr const char* kMaps[] = { "hasBaseColorMap",       "hasMetallicRoughnessMap", "hasNormalMap",
                                  "hasOcclusionMap",       "hasEmissiveMap",          "hasClearCoatMap",
                                  "hasClearCoatNormalMap", "hasSheenColorMap",        "hasSpecularFactorMap",
                                  "hasAnisotropyMap",      "hasIridescenceMap",       "hasDiffuseTransmissionMap" };

TEST(LoadMaterial, TakesOutTheTexturesThatTheConstantsSwitchOff) {
    const scene::Material plain = load({ { "hasNormalMap", true } });
    EXPECT_TRUE(plain.package.findParameter("normalMap")->isBound);
    EXPECT_FALSE(plain.package.findParameter("clearCoatMap")->isBound);
    EXPECT_FALSE(load({}).package.findParameter("normalMap")->isBound);
}

TEST(LoadMaterial, SaysHowManyTexturesAMaterialSamplesAndHowManyThereMayBe) {
    std::vector<MaterialConstant> constants;
    for (const char* map : kMaps) constants.push_back({ map, true });
    const scene::Material all = load(constants);
    EXPECT_TRUE(checkSamplers(all, 32, "a desktop"));
    EXPECT_TRUE(checkSamplers(all, 15, "a device"));
    const Result<void> refused = checkSamplers(all, 14, "a device");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(
            refused.error().message,
            "material 'gltf_layered_opaque' samples 15 textures, 3 of them the engine's, and a device has 14 a stage; "
            "leave some out, or load it with constants that switch them off (usedIf)");
    constants.pop_back();
    EXPECT_TRUE(checkSamplers(load(constants), 14, "a device"));
}

} // namespace
} // namespace filament::engine
