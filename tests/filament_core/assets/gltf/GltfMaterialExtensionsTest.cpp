// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/gltf/ModelVariants.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Texture i of the file is one texel of (10 i + 1, 10 i + 2, 10 i + 3, 10 i + 4).
void addTextures(TestFile& file, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const auto code = [&](size_t c) { return static_cast<uint8_t>(10 * i + c); };
        const std::array<uint8_t, 4> texel{ code(1), code(2), code(3), code(4) };
        const GlbImage image = *glbImageFromPixels("image", 1, 1, std::as_bytes(std::span(texel)));
        file.root["images"].push_back({ { "bufferView", file.addView(image.file) }, { "mimeType", "image/png" } });
        file.root["textures"].push_back({ { "source", i } });
    }
}

/// A triangle whose material has these extensions.
TestFile triangleWith(Json extensions) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    addTextures(file, 4);
    file.root["materials"] = { { { "extensions", std::move(extensions) } } };
    file.primitive()["material"] = 0;
    return file;
}

ModelData modelWith(const char* extensions) { return loaded(triangleWith(Json::parse(extensions))); }

MaterialData materialWith(const char* extensions) {
    const ModelData model = modelWith(extensions);
    EXPECT_THAT(model.warnings, IsEmpty());
    return model.materials.at(0);
}

std::vector<int> texel(ModelData const& model, TextureRef const& texture) {
    std::vector<int> codes;
    for (const std::byte code : model.images.at(texture.image).data) codes.push_back(static_cast<int>(code));
    return codes;
}

TEST(GltfMaterialExtensions, AnEmptyMaterialUsesNone) {
    const MaterialData material = materialWith("{}");
    EXPECT_FALSE(material.clearCoat.isUsed() || material.sheen.isUsed() || material.specular.isUsed());
    EXPECT_FALSE(material.anisotropy.isUsed() || material.iridescence.isUsed() || material.transmission.isUsed());
    EXPECT_FALSE(material.diffuseTransmission.isUsed() || material.specularGlossiness || material.unlit);
    EXPECT_EQ(material.ior, 1.5f);
}

TEST(GltfMaterialExtensions, FactorsOfAllLayersAreRead) {
    const MaterialData material = materialWith(R"({
        "KHR_materials_clearcoat": { "clearcoatFactor": 0.1, "clearcoatRoughnessFactor": 0.2,
            "clearcoatNormalTexture": { "index": 0, "scale": 0.3 } },
        "KHR_materials_sheen": { "sheenColorFactor": [ 0.1, 0.2, 0.3 ], "sheenRoughnessFactor": 0.4 },
        "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [ 1, 2, 25 ] },
        "KHR_materials_anisotropy": { "anisotropyStrength": 0.6, "anisotropyRotation": -7 },
        "KHR_materials_iridescence": { "iridescenceFactor": 0.7, "iridescenceIor": 1.8,
            "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 300 },
        "KHR_materials_ior": { "ior": 1.33 },
        "KHR_materials_transmission": { "transmissionFactor": 0.8 },
        "KHR_materials_volume": { "thicknessFactor": 2, "attenuationColor": [ 0.1, 0.5, 0.9 ],
            "attenuationDistance": 3 },
        "KHR_materials_dispersion": { "dispersion": 5 },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.9,
            "diffuseTransmissionColorFactor": [ 0.3, 0.2, 0.1 ] } })");
    EXPECT_EQ(material.clearCoat.factor, 0.1f);
    EXPECT_EQ(material.clearCoat.roughness, 0.2f);
    EXPECT_EQ(material.clearCoat.normalScale, 0.3f);
    EXPECT_EQ(material.sheen.color, float3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.sheen.roughness, 0.4f);
    EXPECT_EQ(material.specular.factor, 0.5f);
    EXPECT_EQ(material.specular.color, float3(1, 2, 25));
    EXPECT_EQ(material.anisotropy.strength, 0.6f);
    EXPECT_EQ(material.anisotropy.rotationRadians, -7.0f);
    EXPECT_EQ(material.iridescence.factor, 0.7f);
    EXPECT_EQ(material.iridescence.ior, 1.8f);
    EXPECT_EQ(material.iridescence.thicknessMinNanometers, 200.0f);
    EXPECT_EQ(material.iridescence.thicknessMaxNanometers, 300.0f);
    EXPECT_EQ(material.ior, 1.33f);
    EXPECT_EQ(material.transmission.factor, 0.8f);
    EXPECT_EQ(material.transmission.thicknessMeters, 2.0f);
    EXPECT_EQ(material.transmission.attenuationColor, float3(0.1f, 0.5f, 0.9f));
    EXPECT_EQ(material.transmission.attenuationDistanceMeters, 3.0f);
    EXPECT_EQ(material.transmission.dispersion, 5.0f);
    EXPECT_EQ(material.diffuseTransmission.factor, 0.9f);
    EXPECT_EQ(material.diffuseTransmission.color, float3(0.3f, 0.2f, 0.1f));
}

TEST(GltfMaterialExtensions, AnEmptyExtensionHasTheDefaultsOfItsSpecification) {
    const MaterialData material = materialWith(R"({ "KHR_materials_iridescence": {}, "KHR_materials_ior": {},
        "KHR_materials_transmission": {}, "KHR_materials_volume": {}, "KHR_materials_clearcoat": {},
        "KHR_materials_specular": {}, "KHR_materials_sheen": {}, "KHR_materials_diffuse_transmission": {} })");
    EXPECT_EQ(material.iridescence.ior, 1.3f);
    EXPECT_EQ(material.iridescence.thicknessMinNanometers, 100.0f);
    EXPECT_EQ(material.iridescence.thicknessMaxNanometers, 400.0f);
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_TRUE(std::isinf(material.transmission.attenuationDistanceMeters));
    EXPECT_EQ(material.transmission.attenuationColor, float3(1.0f));
    EXPECT_EQ(material.diffuseTransmission.color, float3(1.0f));
    EXPECT_FALSE(material.clearCoat.isUsed() || material.specular.isUsed() || material.sheen.isUsed());
}

TEST(GltfMaterialExtensions, AnIndexOfZeroStandsForAnInfiniteOne) {
    EXPECT_EQ(materialWith(R"({ "KHR_materials_ior": { "ior": 0 } })").ior, kOpaqueIor);
}

TEST(GltfMaterialExtensions, ValuesOutsideTheirRangeAreClampedWithAWarning) {
    const ModelData model = modelWith(R"({ "KHR_materials_ior": { "ior": 0.5 },
        "KHR_materials_sheen": { "sheenColorFactor": [ 2, 0, 0 ] }, "KHR_materials_transmission": {},
        "KHR_materials_volume": { "attenuationDistance": 0 } })");
    EXPECT_EQ(model.materials[0].ior, 1.0f);
    EXPECT_EQ(model.materials[0].sheen.color, float3(1, 0, 0));
    EXPECT_GT(model.materials[0].transmission.attenuationDistanceMeters, 0.0f);
    EXPECT_THAT(model.warnings,
                ElementsAre(HasSubstr("materials[0].extensions.KHR_materials_sheen.sheenColorFactor: 2"),
                            HasSubstr("materials[0].extensions.KHR_materials_ior.ior: 0.5"),
                            HasSubstr("KHR_materials_volume.attenuationDistance: 0")));
}

TEST(GltfMaterialExtensions, SpecularGlossinessTakesThePlaceOfTheCore) {
    TestFile file = triangleWith(Json::parse(R"({ "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [ 0.1, 0.2, 0.3, 0.4 ], "specularFactor": [ 0.5, 0.6, 0.7 ], "glossinessFactor": 0.8,
        "diffuseTexture": { "index": 1 }, "specularGlossinessTexture": { "index": 2 } } })"));
    file.root["materials"][0]["pbrMetallicRoughness"] =
            Json::parse(R"({ "baseColorFactor": [ 1, 0, 0, 1 ], "baseColorTexture": { "index": 0 },
        "metallicRoughnessTexture": { "index": 0 } })");
    const ModelData model = loaded(file);
    MaterialData const& material = model.materials[0];
    ASSERT_TRUE(material.specularGlossiness);
    EXPECT_EQ(material.baseColorFactor, float4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.specularGlossiness->specularFactor, float3(0.5f, 0.6f, 0.7f));
    EXPECT_EQ(material.specularGlossiness->glossinessFactor, 0.8f);
    EXPECT_EQ(material.metallicRoughness.image, kNone);
    EXPECT_THAT(texel(model, material.baseColor), ElementsAre(11, 12, 13, 14));
    EXPECT_THAT(texel(model, material.specularGlossiness->map), ElementsAre(21, 22, 23, 24));
    EXPECT_EQ(model.images[material.specularGlossiness->map.image].format, backend::Format::RGBA8Srgb);
    EXPECT_EQ(model.images.size(), 2u);
}

TEST(GltfMaterialExtensions, WhatMustNotBeUsedTogetherIsLeftOutWithAWarning) {
    const ModelData unlit = modelWith(R"({ "KHR_materials_unlit": {},
        "KHR_materials_clearcoat": { "clearcoatFactor": 1 }, "KHR_materials_pbrSpecularGlossiness": {} })");
    EXPECT_TRUE(unlit.materials[0].unlit);
    EXPECT_FALSE(unlit.materials[0].specularGlossiness || unlit.materials[0].clearCoat.isUsed());
    EXPECT_THAT(unlit.warnings, ElementsAre(AllOf(HasSubstr("pbrSpecularGlossiness"), HasSubstr("KHR_materials_unlit")),
                                            AllOf(HasSubstr("clearcoat"), HasSubstr("KHR_materials_unlit"))));

    const ModelData glossy = modelWith(R"({ "KHR_materials_pbrSpecularGlossiness": {},
        "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ] } })");
    EXPECT_TRUE(glossy.materials[0].specularGlossiness);
    EXPECT_FALSE(glossy.materials[0].sheen.isUsed());
    EXPECT_THAT(glossy.warnings, ElementsAre(AllOf(HasSubstr("materials[0].extensions.KHR_materials_sheen"),
                                                   HasSubstr("pbrSpecularGlossiness"))));
}

TEST(GltfMaterialExtensions, WhatNeedsAnotherExtensionIsLeftOutWithoutIt) {
    const ModelData volume = modelWith(R"({ "KHR_materials_volume": { "thicknessFactor": 1 } })");
    EXPECT_EQ(volume.materials[0].transmission.thicknessMeters, 0.0f);
    EXPECT_THAT(volume.warnings, ElementsAre(HasSubstr("needs KHR_materials_transmission")));
    const ModelData prism = modelWith(R"({ "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_dispersion": { "dispersion": 1 } })");
    EXPECT_EQ(prism.materials[0].transmission.dispersion, 0.0f);
    EXPECT_THAT(prism.warnings, ElementsAre(HasSubstr("needs KHR_materials_volume")));
}

TEST(GltfMaterialExtensions, MapsThatTheFileSharesStayOneImage) {
    const ModelData model = modelWith(R"({ "KHR_materials_clearcoat": { "clearcoatFactor": 1,
        "clearcoatTexture": { "index": 1 }, "clearcoatRoughnessTexture": { "index": 1 } } })");
    TexturePair const& maps = model.materials[0].clearCoat.maps;
    EXPECT_TRUE(maps.hasFirst && maps.hasSecond);
    EXPECT_THAT(texel(model, maps.texture), ElementsAre(11, 12, 13, 14));
    EXPECT_EQ(model.images.size(), 1u);
}

TEST(GltfMaterialExtensions, MapsThatTheFileKeepsApartArePacked) {
    const ModelData model = modelWith(R"({
        "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatTexture": { "index": 0 },
            "clearcoatRoughnessTexture": { "index": 1 } },
        "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ], "sheenColorTexture": { "index": 0 },
            "sheenRoughnessTexture": { "index": 1 } },
        "KHR_materials_specular": { "specularColorTexture": { "index": 0 }, "specularTexture": { "index": 1 } },
        "KHR_materials_iridescence": { "iridescenceFactor": 1, "iridescenceTexture": { "index": 0 },
            "iridescenceThicknessTexture": { "index": 1 } },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1,
            "diffuseTransmissionColorTexture": { "index": 0 }, "diffuseTransmissionTexture": { "index": 1 } } })");
    EXPECT_THAT(model.warnings, IsEmpty());
    MaterialData const& material = model.materials[0];
    for (TexturePair const* numbers : { &material.clearCoat.maps, &material.iridescence.maps }) {
        EXPECT_TRUE(numbers->hasFirst && numbers->hasSecond);
        EXPECT_EQ(texel(model, numbers->texture)[0], 1);
        EXPECT_EQ(texel(model, numbers->texture)[1], 12);
        EXPECT_EQ(model.images[numbers->texture.image].format, backend::Format::RGBA8);
    }
    for (TexturePair const* color :
         { &material.sheen.maps, &material.specular.maps, &material.diffuseTransmission.maps }) {
        EXPECT_TRUE(color->hasFirst && color->hasSecond);
        EXPECT_THAT(texel(model, color->texture), ElementsAre(1, 2, 3, 14));
        EXPECT_EQ(model.images[color->texture.image].format, backend::Format::RGBA8Srgb);
    }
    EXPECT_EQ(model.images.size(), 2u) << "equal pairs are packed once";
}

TEST(GltfMaterialExtensions, TransmissionAndThicknessArePackedBesideDiffuseTransmission) {
    const ModelData model = modelWith(R"({
        "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": { "index": 0 } },
        "KHR_materials_volume": { "thicknessFactor": 1, "thicknessTexture": { "index": 1 } },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1,
            "diffuseTransmissionTexture": { "index": 1 } } })");
    MaterialData const& material = model.materials[0];
    EXPECT_TRUE(material.transmission.maps.hasFirst && material.transmission.maps.hasSecond);
    EXPECT_EQ(texel(model, material.transmission.maps.texture)[0], 1);
    EXPECT_EQ(texel(model, material.transmission.maps.texture)[1], 12);
    EXPECT_EQ(texel(model, material.diffuseTransmission.maps.texture)[3], 14);
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfMaterialExtensions, CoverageAndTransmissionCombine) {
    TestFile file = triangleWith(Json::parse(R"({ "KHR_materials_transmission": { "transmissionFactor": 1 } })"));
    file.root["materials"][0]["alphaMode"] = "BLEND";
    const ModelData model = loaded(file);
    EXPECT_EQ(model.materials[0].alphaMode, AlphaMode::Blend);
    EXPECT_EQ(model.materials[0].transmission.factor, 1);
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfMaterialExtensions, OneMapOfAPairStandsAlone) {
    const ModelData model = modelWith(R"({ "KHR_materials_clearcoat": { "clearcoatFactor": 1,
        "clearcoatRoughnessTexture": { "index": 2 } } })");
    TexturePair const& maps = model.materials[0].clearCoat.maps;
    EXPECT_FALSE(maps.hasFirst);
    EXPECT_TRUE(maps.hasSecond);
    EXPECT_THAT(texel(model, maps.texture), ElementsAre(21, 22, 23, 24));
}

TEST(GltfMaterialExtensions, MapsThatAreReadDifferentlyKeepTexturesOfTheirOwn) {
    const ModelData model = modelWith(R"({ "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ],
        "sheenColorTexture": { "index": 0 }, "sheenRoughnessTexture": { "index": 1, "texCoord": 1 } } })");
    TexturePair const& maps = model.materials[0].sheen.maps;
    EXPECT_TRUE(maps.hasFirst && maps.hasSecond && maps.isApart());
    EXPECT_THAT(texel(model, maps.texture), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(texel(model, maps.second), ElementsAre(11, 12, 13, 14));
    EXPECT_EQ(maps.second.uvSet, 1u);
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfMaterialExtensions, MapsOfWhatIsNotUsedAreNotDecoded) {
    const ModelData model = modelWith(R"({
        "KHR_materials_clearcoat": { "clearcoatTexture": { "index": 0 }, "clearcoatNormalTexture": { "index": 1 } },
        "KHR_materials_anisotropy": { "anisotropyTexture": { "index": 2 } },
        "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_volume": { "thicknessTexture": { "index": 3 } } })");
    EXPECT_THAT(model.images, IsEmpty());
}

TEST(GltfMaterialExtensions, BumpsHaveAFactorInMetresAndAMapOfData) {
    const ModelData model = modelWith(R"({ "EXT_materials_bump": { "bumpFactor": -0.25, "bumpTexture": { "index": 1,
        "texCoord": 1, "extensions": { "KHR_texture_transform": { "scale": [ 2, 3 ] } } } } })");
    BumpData const& bump = model.materials[0].bump;
    EXPECT_EQ(bump.factor, -0.25f);
    EXPECT_EQ(bump.map.uvSet, 1u);
    EXPECT_TRUE(bump.map.hasTransform);
    EXPECT_EQ(bump.map.uvTransform[1].y, 3.0f);
    ASSERT_LT(bump.map.image, model.images.size());
    EXPECT_EQ(model.images[bump.map.image].format, backend::Format::RGBA8) << "linear";
}

TEST(GltfMaterialExtensions, AVolumeScattersInAColorWithAMap) {
    const ModelData model = modelWith(R"({ "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_volume": { "thicknessFactor": 2, "attenuationColor": [ 0.1, 0.5, 0.9 ],
            "attenuationDistance": 3 },
        "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 0.75, 0.5, 0.25 ], "scatterAnisotropy": -0.5,
            "multiscatterColorTexture": { "index": 1 } } })");
    MaterialData const& material = model.materials[0];
    EXPECT_THAT(model.warnings, IsEmpty());
    EXPECT_TRUE(material.scatters());
    EXPECT_EQ(material.volumeScatter.color, float3(0.75f, 0.5f, 0.25f));
    EXPECT_EQ(material.volumeScatter.anisotropy, -0.5f);
    EXPECT_THAT(texel(model, material.volumeScatter.map), ElementsAre(11, 12, 13, 14));
    EXPECT_EQ(model.images[material.volumeScatter.map.image].format, backend::Format::RGBA8Srgb);
}

TEST(GltfMaterialExtensions, TheColorOfScatteringHasAnOlderName) {
    const MaterialData material = materialWith(R"({ "KHR_materials_volume": { "thicknessFactor": 2,
            "attenuationDistance": 3, "attenuationColor": [ 0.5, 0.5, 0.5 ],
            "thicknessTexture": { "index": 2 } },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1 },
        "KHR_materials_volume_scatter": { "multiscatterColor": [ 0.1, 0.2, 0.3 ] } })");
    EXPECT_EQ(material.volumeScatter.color, float3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.volumeScatter.anisotropy, 0.0f);
    EXPECT_TRUE(material.scatters());
    EXPECT_TRUE(material.transmission.maps.hasSecond) << "light that enters diffusely goes through the volume, too";
}

TEST(GltfMaterialExtensions, OnlyAVolumeThatDimsLightScattersIt) {
    const auto scatters = [](const char* entry, const char* volume, const char* scatter) {
        const std::string json = fmt::format(
                R"({{ "KHR_materials_{}": {{ "{}Factor": 1 }},
            "KHR_materials_volume": {}, "KHR_materials_volume_scatter": {} }})",
                entry, entry == std::string("transmission") ? entry : "diffuseTransmission", volume, scatter);
        return materialWith(json.c_str()).scatters();
    };
    const char* dim = R"({ "thicknessFactor": 1, "attenuationDistance": 1, "attenuationColor": [ 1, 0.5, 1 ] })";
    const char* red = R"({ "multiscatterColorFactor": [ 0.5, 0, 0 ] })";
    EXPECT_TRUE(scatters("transmission", dim, red));
    EXPECT_TRUE(scatters("diffuse_transmission", dim, red));
    EXPECT_FALSE(scatters("transmission", dim, "{}")) << "the colour is black";
    EXPECT_FALSE(scatters("transmission", R"({ "attenuationDistance": 1, "attenuationColor": [ 0, 0, 0 ] })", red));
    EXPECT_FALSE(scatters("transmission", R"({ "thicknessFactor": 1, "attenuationColor": [ 0, 0, 0 ] })", red));
    EXPECT_FALSE(scatters("transmission", R"({ "thicknessFactor": 1, "attenuationDistance": 1 })", red));
}

TEST(GltfMaterialExtensions, ScatteringThatCannotBeIsClampedOrLeftOutWithAWarning) {
    const ModelData model = modelWith(R"({ "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_volume": { "thicknessFactor": 1 },
        "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 2, -1, 0.5 ], "scatterAnisotropy": -1 } })");
    EXPECT_EQ(model.materials[0].volumeScatter.color, float3(1, 0, 0.5f));
    EXPECT_EQ(model.materials[0].volumeScatter.anisotropy, -kMaxScatterAnisotropy);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("KHR_materials_volume_scatter.multiscatterColorFactor: 2"),
                                            HasSubstr("KHR_materials_volume_scatter.multiscatterColorFactor: -1"),
                                            HasSubstr("KHR_materials_volume_scatter.scatterAnisotropy: -1")));
    const ModelData alone = modelWith(R"({ "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 1, 1, 1 ] } })");
    EXPECT_FALSE(alone.materials[0].volumeScatter.isUsed());
    EXPECT_THAT(alone.warnings, ElementsAre(HasSubstr("needs KHR_materials_volume")));
    const ModelData unlit = modelWith(R"({ "KHR_materials_unlit": {}, "KHR_materials_volume_scatter": {} })");
    EXPECT_THAT(unlit.warnings, ElementsAre(HasSubstr("must not be used with KHR_materials_unlit")));
    for (const char* wrong : { R"({ "multiscatterColorFactor": "red" })", R"({ "multiscatterColorFactor": [ 1, 1 ] })",
                               R"({ "scatterAnisotropy": "forwards" })", R"({ "multiscatterColorTexture": 3 })" }) {
        const TestFile file = triangleWith({ { "KHR_materials_transmission", { { "transmissionFactor", 1 } } },
                                             { "KHR_materials_volume", { { "thicknessFactor", 1 } } },
                                             { "KHR_materials_volume_scatter", Json::parse(wrong) } });
        const Result<ModelData> broken = file.load();
        ASSERT_FALSE(broken) << wrong;
        EXPECT_THAT(broken.error().message, HasSubstr("KHR_materials_volume_scatter.")) << wrong;
    }
}

TEST(GltfMaterialExtensions, TheFactorOfBumpsIsOneAndWithoutAMapThereAreNone) {
    EXPECT_EQ(materialWith(R"({ "EXT_materials_bump": { "bumpTexture": { "index": 0 } } })").bump.factor, 1.0f);
    EXPECT_EQ(materialWith(R"({ "EXT_materials_bump": { "bumpFactor": 2 } })").bump.map.image, kNone);
    EXPECT_EQ(materialWith("{}").bump.map.image, kNone);
    EXPECT_THAT(modelWith(R"({ "EXT_materials_bump": { "bumpFactor": 0, "bumpTexture": { "index": 0 } } })").images,
                IsEmpty());
}

TEST(GltfMaterialExtensions, ABumpThatIsNotOneIsRefusedOrClamped) {
    const ModelData high = modelWith(R"({ "EXT_materials_bump": { "bumpFactor": 1e9 } })");
    EXPECT_EQ(high.materials[0].bump.factor, 65504.0f);
    EXPECT_THAT(high.warnings, ElementsAre(HasSubstr("materials[0].extensions.EXT_materials_bump.bumpFactor: 1")));
    for (const char* wrong : { R"({ "bumpFactor": "deep" })", R"({ "bumpFactor": null })", R"({ "bumpTexture": 3 })",
                               R"({ "bumpTexture": { "index": -1 } })", R"({ "bumpTexture": { "index": 4 } })",
                               R"({ "bumpTexture": {} })" }) {
        const TestFile file = triangleWith({ { "EXT_materials_bump", Json::parse(wrong) } });
        const Result<ModelData> model = file.load();
        ASSERT_FALSE(model) << wrong;
        EXPECT_THAT(model.error().message, HasSubstr("EXT_materials_bump.bump")) << wrong;
    }
}

TEST(GltfMaterialExtensions, GlossyMaterialsHaveBumpsToo) {
    const MaterialData material = materialWith(R"({ "KHR_materials_pbrSpecularGlossiness": {},
        "EXT_materials_bump": { "bumpTexture": { "index": 0 } } })");
    EXPECT_TRUE(material.specularGlossiness);
    EXPECT_NE(material.bump.map.image, kNone);
}

TEST(GltfMaterialExtensions, AnisotropyGivesTangentsToWhatHasNone) {
    TestFile file = triangleWith(Json::parse(R"({ "KHR_materials_anisotropy": { "anisotropyStrength": 1 } })"));
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    // Turned by 90 degrees: u grows along y.
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 0, -1, 1, 0 }, kFloat, "VEC2", 2);
    float3 n, t, b;
    shader::lib::tangentFrame(vertexValue(onlyPrimitive(file), shader::kAttributeTangents, 0), n, t, b);
    EXPECT_NEAR(t.y, 1, 1e-3f);
}

TEST(GltfVariants, APrimitiveNamesAMaterialForEachOfThem) {
    TestFile file = TestFile::triangle();
    file.root["extensions"]["KHR_materials_variants"]["variants"] =
            Json::parse(R"([ { "name": "red" }, { "name": "green" }, { "name": "blue" } ])");
    file.root["materials"] = Json::parse(R"([ { "name": "unused" }, { "name": "A" }, { "name": "B" } ])");
    file.primitive()["material"] = 1;
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
            Json::parse(R"([ { "material": 2, "variants": [ 2, 0 ] } ])");
    const ModelData model = loaded(file);
    EXPECT_THAT(model.variants, ElementsAre("red", "green", "blue"));
    ASSERT_EQ(model.materials.size(), 2u) << "materials of variants are loaded, others are not";
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    EXPECT_EQ(model.materials[primitive.material].name, "A");
    ASSERT_EQ(primitive.variants.size(), 2u);
    EXPECT_EQ(primitive.variants[0].variant, 0u);
    EXPECT_EQ(primitive.variants[1].variant, 2u);
    EXPECT_EQ(model.materials[primitive.variants[1].material].name, "B");
}

TEST(GltfVariants, ASecondMaterialForOneIsLeftOutWithAWarning) {
    TestFile file = TestFile::triangle();
    file.root["extensions"]["KHR_materials_variants"]["variants"] = Json::parse(R"([ { "name": "red" } ])");
    file.root["materials"] = Json::parse(R"([ { "name": "A" }, { "name": "B" } ])");
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
            Json::parse(R"([ { "material": 1, "variants": [ 0 ] }, { "material": 0, "variants": [ 0 ] } ])");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.meshes[0].primitives[0].variants.size(), 1u);
    EXPECT_EQ(model.materials[model.meshes[0].primitives[0].variants[0].material].name, "B");
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("meshes[0].primitives[0]")));
}

TEST(GltfVariants, SelectingOneChangesThePrimitivesThatItNames) {
    ModelData model;
    model.name = "chair";
    model.variants = { "mango", "peacock" };
    model.meshes.resize(1);
    model.meshes[0].primitives.resize(2);
    model.meshes[0].primitives[0].material = 0;
    model.meshes[0].primitives[0].variants = { { 1, 2 } };
    model.meshes[0].primitives[1].material = 1;
    ASSERT_TRUE(selectVariant(model, ""));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0u);
    ASSERT_TRUE(selectVariant(model, "peacock"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 2u);
    EXPECT_EQ(model.meshes[0].primitives[1].material, 1u);
    EXPECT_EQ(selectVariant(model, "mangoo").error().message, "chair has no variant 'mangoo'; did you mean 'mango'?");
}

TEST(GltfVariants, OneThatTheFileDoesNotHaveIsRefused) {
    TestFile file = TestFile::triangle();
    file.root["extensions"]["KHR_materials_variants"]["variants"] = Json::parse(R"([ { "name": "red" } ])");
    file.root["materials"] = Json::parse(R"([ {} ])");
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
            Json::parse(R"([ { "material": 0, "variants": [ 1 ] } ])");
    const Result<ModelData> model = file.load();
    ASSERT_FALSE(model);
    EXPECT_THAT(model.error().message, HasSubstr("mappings[0].variants[0]: index 1 is out of range"));
}

} // namespace
} // namespace filament_core::assets::test
