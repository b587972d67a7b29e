// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/GltfMaterialSettings.h"

#include "shaders/package/EngineMaterials.h"
#include "shaders/package/Package.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using assets::MaterialData;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::string> constantsOf(GltfMaterialSettings const& settings) {
    std::vector<std::string> names;
    for (MaterialConstant const& constant : settings.constants) {
        if (constant.name != "hasVertexColor") names.push_back(constant.name);
    }
    return names;
}

std::vector<std::string> mapsOf(GltfMaterialSettings const& settings) {
    std::vector<std::string> stems;
    for (GltfMap const& map : settings.maps) stems.push_back(map.stem);
    return stems;
}

template <class T>
T parameter(GltfMaterialSettings const& settings, std::string_view name) {
    const auto found = std::ranges::find_if(settings.parameters, [&](auto const& at) { return at.first == name; });
    if (found == settings.parameters.end()) {
        ADD_FAILURE() << "no parameter " << name;
        return {};
    }
    return std::get<T>(found->second);
}

assets::TextureRef texture(uint32_t image) { return { .image = image }; }

TEST(GltfMaterialSettings, AMaterialWithoutExtensionsKeepsThePackageWithoutLayers) {
    MaterialData material;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_lit_opaque");
    EXPECT_THAT(constantsOf(settingsOf(material, {})), IsEmpty());
    material.alphaMode = assets::AlphaMode::Mask;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_lit_masked");
    material.unlit = true;
    material.alphaMode = assets::AlphaMode::Blend;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_unlit_blended");
}

TEST(GltfMaterialSettings, WidthsOfNormalsAreReadWhereTheLoaderFilledThem) {
    MaterialData material;
    material.normal = { .image = 0, .hasVariance = true };
    EXPECT_THAT(constantsOf(settingsOf(material, {})), UnorderedElementsAre("hasNormalMap", "normalWidth"));
    EXPECT_THAT(constantsOf(settingsOf(material, { .hasTangents = false })), IsEmpty());
    material.normal.hasVariance = false;
    EXPECT_THAT(constantsOf(settingsOf(material, {})), UnorderedElementsAre("hasNormalMap"));
    material.clearCoat = { .factor = 1, .normal = { .image = 0, .hasVariance = true } };
    EXPECT_THAT(constantsOf(settingsOf(material, {})),
                UnorderedElementsAre("hasNormalMap", "hasClearCoat", "hasClearCoatNormalMap", "clearCoatNormalWidth"));
}

TEST(GltfMaterialSettings, ExtensionsWhoseFactorsAreNeutralAreNotUsed) {
    MaterialData material;
    material.clearCoat.roughness = 0.5f;
    material.sheen.roughness = 0.5f;
    material.iridescence.ior = 2;
    material.transmission.thicknessMeters = 1;
    material.anisotropy.rotationRadians = 1;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_lit_opaque");
    EXPECT_THAT(constantsOf(settingsOf(material, {})), IsEmpty());
}

TEST(GltfMaterialSettings, EveryLayerSwitchesOnItselfAndNothingElse) {
    const auto constants = [](auto change) {
        MaterialData material;
        change(material);
        const GltfMaterialSettings settings = settingsOf(material, {});
        EXPECT_EQ(settings.package, "gltf_layered_opaque");
        return constantsOf(settings);
    };
    EXPECT_THAT(constants([](MaterialData& m) { m.clearCoat.factor = 1; }), UnorderedElementsAre("hasClearCoat"));
    EXPECT_THAT(constants([](MaterialData& m) { m.sheen.color.y = 1; }), UnorderedElementsAre("hasSheen"));
    EXPECT_THAT(constants([](MaterialData& m) { m.specular.factor = 0; }), UnorderedElementsAre("hasSpecular"));
    EXPECT_THAT(constants([](MaterialData& m) { m.ior = 1.4f; }), UnorderedElementsAre("hasIor"));
    EXPECT_THAT(constants([](MaterialData& m) { m.anisotropy.strength = 1; }), UnorderedElementsAre("hasAnisotropy"));
    EXPECT_THAT(constants([](MaterialData& m) { m.iridescence.factor = 1; }), UnorderedElementsAre("hasIridescence"));
    EXPECT_THAT(constants([](MaterialData& m) { m.diffuseTransmission.factor = 1; }),
                UnorderedElementsAre("hasDiffuseTransmission"));
}

TEST(GltfMaterialSettings, AVolumeThatScattersHasAFamilyOfItsOwnHoweverLightEntersIt) {
    MaterialData material;
    material.transmission.thicknessMeters = 2;
    material.transmission.attenuationColor = float3(0.5f);
    material.transmission.attenuationDistanceMeters = 1;
    material.volumeScatter = { .color = { 1, 0.5f, 0 }, .map = texture(1) };
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_lit_opaque") << "no light enters";
    material.diffuseTransmission.factor = 1;
    const GltfMaterialSettings wax = settingsOf(material, {});
    EXPECT_EQ(wax.package, "gltf_scattering_opaque");
    EXPECT_THAT(mapsOf(wax), UnorderedElementsAre("multiscatter"));
    EXPECT_THAT(constantsOf(wax),
                UnorderedElementsAre("hasDiffuseTransmission", "hasAbsorption", "hasMultiscatterMap"));
    material.diffuseTransmission.factor = 0;
    material.transmission.factor = 1;
    EXPECT_THAT(constantsOf(settingsOf(material, {})), UnorderedElementsAre("hasAbsorption", "hasMultiscatterMap"));
    material.alphaMode = assets::AlphaMode::Mask;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_scattering_masked");
    material.volumeScatter.color = float3(0);
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_transmissive_solid_masked");
}

TEST(GltfMaterialSettings, APairOfMapsIsOneTextureAndTwoConstants) {
    MaterialData material;
    material.clearCoat.factor = 1;
    material.clearCoat.maps = { texture(3), true, true };
    material.clearCoat.maps.texture.uvSet = 1;
    material.sheen.color = float3(1);
    material.sheen.maps = { texture(4), false, true };
    const GltfMaterialSettings settings = settingsOf(material, {});
    EXPECT_THAT(mapsOf(settings), UnorderedElementsAre("clearCoat", "sheen"));
    EXPECT_THAT(constantsOf(settings),
                UnorderedElementsAre("hasClearCoat", "hasClearCoatMap", "hasClearCoatRoughnessMap", "clearCoatUv",
                                     "hasSheen", "hasSheenRoughnessMap"));
}

TEST(GltfMaterialSettings, TransmissionIsThinWithoutAThicknessAndSolidWithOne) {
    MaterialData material;
    material.transmission.factor = 1;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_transmissive_thin_opaque");
    material.transmission.thicknessMeters = 2;
    material.alphaMode = assets::AlphaMode::Mask;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_transmissive_solid_masked");
}

TEST(GltfMaterialSettings, AVolumeIsAsThickAsTheScaleOfItsNodeMakesIt) {
    MaterialData material;
    material.transmission.factor = 1;
    material.transmission.thicknessMeters = 2;
    EXPECT_EQ(parameter<float>(settingsOf(material, {}, 3), "thickness"), 6.0f);
}

TEST(GltfMaterialSettings, WhiteLightHasTheAttenuationColourAfterTheAttenuationDistance) {
    MaterialData material;
    material.transmission.factor = 1;
    material.transmission.thicknessMeters = 1;
    material.transmission.attenuationColor = { 0.1f, 0.5f, 0.9f };
    EXPECT_THAT(constantsOf(settingsOf(material, {})), IsEmpty()) << "an infinite distance absorbs nothing";
    material.transmission.attenuationDistanceMeters = 0.25f;
    const auto absorption = parameter<float3>(settingsOf(material, {}, 3), "absorption");
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(std::exp(-absorption[c] * 0.25f), material.transmission.attenuationColor[c], 1e-6f);
}

TEST(GltfMaterialSettings, BumpsNeedAMapAndAFactor) {
    MaterialData material;
    EXPECT_EQ(settingsOf(material, {}).package, "gltf_lit_opaque");
    material.bump = { .factor = 0.5f, .map = { .image = 0 } };
    const GltfMaterialSettings settings = settingsOf(material, {});
    EXPECT_EQ(settings.package, "gltf_lit_opaque");
    EXPECT_EQ(parameter<float>(settings, "bumpFactor"), 0.5f);
    ASSERT_EQ(settings.maps.size(), 1u);
    EXPECT_EQ(settings.maps[0].stem, "bump");
    material.bump.factor = 0;
    EXPECT_TRUE(settingsOf(material, {}).maps.empty());
    material.bump.isAnimated = true;
    EXPECT_EQ(settingsOf(material, {}).maps.size(), 1u);
}

TEST(GltfMaterialSettings, TheRotationOfAnisotropyIsADirection) {
    MaterialData material;
    material.anisotropy = { .strength = 1, .rotationRadians = 1.5707964f };
    const auto direction = parameter<float2>(settingsOf(material, {}), "anisotropyRotation");
    EXPECT_NEAR(direction.x, 0, 1e-6f);
    EXPECT_NEAR(direction.y, 1, 1e-6f);
}

TEST(GltfMaterialSettings, SpecularGlossinessHasNeitherMetalNorLayers) {
    MaterialData material;
    material.specularGlossiness = { .specularFactor = { 0.1f, 0.2f, 0.3f },
                                    .glossinessFactor = 0.4f,
                                    .map = texture(2) };
    material.clearCoat.factor = 1;
    const GltfMaterialSettings settings = settingsOf(material, {});
    EXPECT_EQ(settings.package, "gltf_specular_glossiness_opaque");
    EXPECT_THAT(constantsOf(settings), UnorderedElementsAre("hasSpecularGlossinessMap"));
    EXPECT_EQ(parameter<float3>(settings, "specularFactor"), float3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(parameter<float>(settings, "glossinessFactor"), 0.4f);
}

/// A material with every feature, every map and a transform on each that its family has.
MaterialData everything() {
    assets::TextureRef map = texture(0);
    map.uvSet = 1;
    map.hasTransform = true;
    const assets::TexturePair pair{ map, true, true };
    MaterialData material;
    material.alphaMode = assets::AlphaMode::Mask;
    for (assets::TextureRef* at : { &material.baseColor, &material.metallicRoughness, &material.normal,
                                    &material.occlusion, &material.emissive })
        *at = map;
    material.ior = 1.4f;
    material.clearCoat = { .factor = 1, .maps = pair, .normal = map };
    material.sheen = { .color = float3(1), .maps = pair };
    material.specular = { .factor = 0, .maps = pair };
    material.anisotropy = { .strength = 1, .map = map };
    material.iridescence = { .factor = 1, .maps = pair };
    return material;
}

TEST(GltfMaterialSettings, AnOcclusionMapInTheTexelsOfAnotherIsNoMapOfItsOwn) {
    MaterialData material;
    material.metallicRoughness = material.occlusion = texture(3);
    EXPECT_THAT(mapsOf(settingsOf(material, {})), UnorderedElementsAre("metallicRoughness"));
    EXPECT_THAT(constantsOf(settingsOf(material, {})),
                UnorderedElementsAre("hasMetallicRoughnessMap", "occlusionInMetallicRoughness"));
    material.occlusion.uvSet = 1;
    EXPECT_THAT(mapsOf(settingsOf(material, {})), UnorderedElementsAre("metallicRoughness", "occlusion"));
}

TEST(GltfMaterialSettings, WhereADeviceSamplesFewTexturesTheLastLayersGoWithoutMaps) {
    MaterialData material = everything();
    material.occlusion = texture(1); // a map of its own
    const std::vector<std::string> all = mapsOf(settingsOf(material, {}));
    for (size_t room = 5; room <= all.size(); ++room) {
        const GltfMaterialSettings settings = settingsOf(material, {}, 1, room);
        EXPECT_EQ(mapsOf(settings), std::vector(all.begin(), all.begin() + static_cast<ptrdiff_t>(room)));
        EXPECT_EQ(settings.leftOut, std::vector(all.begin() + static_cast<ptrdiff_t>(room), all.end()));
    }
    const GltfMaterialSettings five = settingsOf(material, {}, 1, 5);
    EXPECT_THAT(mapsOf(five),
                UnorderedElementsAre("baseColor", "metallicRoughness", "normal", "occlusion", "emissive"));
    EXPECT_THAT(constantsOf(five), testing::Contains("hasClearCoat"));
    EXPECT_THAT(constantsOf(five), testing::Not(testing::Contains("hasClearCoatMap")));
}

// Otherwise the engine would take it for a defect of its own, and stop.
TEST(GltfMaterialSettings, EverySettingIsNamedByItsPackage) {
    std::vector<MaterialData> materials(6, everything());
    materials[1].diffuseTransmission = { .factor = 1, .maps = materials[1].sheen.maps };
    materials[2].transmission = { .factor = 1, .maps = materials[1].sheen.maps };
    materials[2].transmission.maps.hasSecond = false;
    materials[3].transmission = { .factor = 1,
                                  .thicknessMeters = 1,
                                  .attenuationColor = float3(0.5f),
                                  .attenuationDistanceMeters = 1,
                                  .dispersion = 1,
                                  .maps = materials[1].sheen.maps };
    materials[4].specularGlossiness = { .map = texture(0) };
    materials[5].unlit = true;
    for (MaterialData const& material : materials) {
        const GltfMaterialSettings settings = settingsOf(material, { .hasColor = true });
        SCOPED_TRACE(settings.package);
        const Result<shader::MaterialPackage> package = shader::readPackage(shader::engineMaterial(settings.package));
        ASSERT_TRUE(package);
        for (MaterialConstant const& constant : settings.constants)
            EXPECT_TRUE(std::ranges::count(package->constants, constant.name, &shader::Constant::name))
                    << constant.name;
        for (auto const& [name, value] : settings.parameters) EXPECT_TRUE(package->findParameter(name)) << name;
        for (GltfMap const& map : settings.maps) {
            EXPECT_TRUE(package->findParameter(map.stem + "Map")) << map.stem;
            EXPECT_TRUE(package->findParameter(map.stem + "UvMatrix")) << map.stem;
        }
    }
}

} // namespace
} // namespace filament_core
