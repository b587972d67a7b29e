// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/CheckAsset.h"

#include <gmock/gmock.h>

#include <functional>

namespace filament_core::tools {
namespace {

using assets::ModelData;
using Rule = PlausibilityRule;
using testing::AllOf;
using testing::HasSubstr;

struct Texel {
    int red, green, blue, alpha = 255;
};

assets::Image imageFrom(uint32_t width, std::vector<Texel> const& texels, bool isColor) {
    assets::Image image{ .width = width, .height = static_cast<uint32_t>(texels.size()) / width, .data = {} };
    image.format = isColor ? backend::Format::RGBA8Srgb : backend::Format::RGBA8;
    for (Texel const& texel : texels)
        for (const int code : { texel.red, texel.green, texel.blue, texel.alpha })
            image.data.push_back(static_cast<std::byte>(code));
    return image;
}

assets::TextureRef repeated(uint32_t image) {
    return { .image = image, .sampler = { .wrapU = WrapMode::Repeat, .wrapV = WrapMode::Repeat } };
}

/// A dielectric without maps.
ModelData modelOf(std::function<void(assets::MaterialData&)> const& change, std::vector<assets::Image> images = {}) {
    ModelData model;
    model.images = std::move(images);
    assets::MaterialData& material = model.materials.emplace_back();
    material.name = "paint";
    material.metallicFactor = 0;
    material.baseColorFactor = { 0.5f, 0.5f, 0.5f, 1 };
    change(material);
    return model;
}

uint64_t brokenBy(MaterialFindings const& findings, Rule rule) { return findings.broken[static_cast<size_t>(rule)]; }

TEST(CheckAsset, FactorsAloneAreOneTexel) {
    const std::pair<std::function<void(assets::MaterialData&)>, Rule> cases[] = {
        { [](auto&) {}, Rule::None },
        { [](auto& m) { m.metallicFactor = 0.5f; }, Rule::MixedMetallic },
        { [](auto& m) {
             m.baseColorFactor = { 0, 0, 0, 1 };
         },
          Rule::DarkAlbedo },
        { [](auto& m) {
             m.baseColorFactor = { 1, 1, 1, 1 };
         },
          Rule::BrightAlbedo },
        { [](auto& m) {
             m.metallicFactor = 1, m.baseColorFactor = { 0.1f, 0.1f, 0.1f, 1 };
         },
          Rule::DarkMetal },
        { [](auto& m) { m.ior = 1.2f; }, Rule::LowReflectance },
        { [](auto& m) { m.specular.factor = 0.1f; }, Rule::LowReflectance },
        { [](auto& m) { m.emissiveFactor = float3(1), m.emissiveStrength = 1; }, Rule::None },
        { [](auto& m) { m.emissiveFactor = float3(1), m.emissiveStrength = 4; }, Rule::BrightEmission },
    };
    for (auto const& [change, rule] : cases) {
        const MaterialFindings findings = checkMaterial(modelOf(change), 0);
        EXPECT_EQ(findings.name, "material 'paint'");
        EXPECT_TRUE(findings.isChecked);
        EXPECT_EQ(findings.texels, 1u);
        EXPECT_EQ(brokenBy(findings, rule), 1u) << toString(rule);
    }
}

TEST(CheckAsset, SharesAreOfTheTexelsOfTheLargestMap) {
    // Colours: dark, 120, bright, 200 in a row. Metallic: the left half is a dielectric, the right one a metal.
    const ModelData model = modelOf(
            [](assets::MaterialData& m) {
                m.baseColorFactor = float4(1.0f);
                m.metallicFactor = 1;
                m.baseColor = repeated(0);
                m.metallicRoughness = repeated(1);
            },
            { imageFrom(4, { { 20, 20, 20 }, { 120, 120, 120 }, { 120, 120, 120 }, { 200, 200, 200 } }, true),
              imageFrom(2, { { 0, 0, 0 }, { 0, 0, 255 } }, false) });
    const MaterialFindings findings = checkMaterial(model, 0);
    EXPECT_EQ(findings.texels, 4u);
    EXPECT_EQ(brokenBy(findings, Rule::DarkAlbedo), 1u);
    EXPECT_EQ(brokenBy(findings, Rule::DarkMetal), 1u);
    EXPECT_EQ(brokenBy(findings, Rule::None), 2u);
    AssetFindings all{ .file = "car.glb", .materials = { findings }, .warnings = {} };
    EXPECT_FALSE(all.isPlausible());
    EXPECT_THAT(textOf(all), AllOf(HasSubstr("material 'paint': 25.0 % of its texels: darkAlbedo: "),
                                   HasSubstr("material 'paint': 25.0 % of its texels: darkMetal: "),
                                   HasSubstr("car.glb: 1 materials: 1 with values")));
}

/// The transform of a map counts: only the bright half of an atlas is used.
TEST(CheckAsset, MapsAreReadWhereTheirTransformPutsThem) {
    const auto change = [](float scale, float offset) {
        return [scale, offset](assets::MaterialData& m) {
            m.baseColorFactor = float4(1.0f);
            m.baseColor = repeated(0);
            m.baseColor.hasTransform = true;
            m.baseColor.uvTransform = float3x3(scale, 0, 0, 0, 1, 0, offset, 0, 1);
        };
    };
    const auto texels = imageFrom(2, { { 20, 20, 20 }, { 120, 120, 120 } }, true);
    EXPECT_EQ(brokenBy(checkMaterial(modelOf(change(0.5f, 0.5f), { texels }), 0), Rule::DarkAlbedo), 0u);
    EXPECT_EQ(brokenBy(checkMaterial(modelOf(change(0.5f, 1), { texels }), 0), Rule::DarkAlbedo), 2u) << "repeated";
    EXPECT_EQ(brokenBy(checkMaterial(modelOf(change(1, 0), { texels }), 0), Rule::DarkAlbedo), 1u);
}

TEST(CheckAsset, WhatIsCutOutDoesNotCount) {
    const auto leaf = [](assets::AlphaMode mode) {
        return modelOf([mode](assets::MaterialData& m) { m.alphaMode = mode, m.baseColor = repeated(0); },
                       { imageFrom(2, { { 0, 0, 0, 0 }, { 255, 255, 255 } }, true) });
    };
    EXPECT_EQ(checkMaterial(leaf(assets::AlphaMode::Opaque), 0).texels, 2u);
    for (const auto mode : { assets::AlphaMode::Mask, assets::AlphaMode::Blend }) {
        const MaterialFindings findings = checkMaterial(leaf(mode), 0);
        EXPECT_EQ(findings.texels, 1u);
        EXPECT_EQ(brokenBy(findings, Rule::None), 1u);
    }
}

TEST(CheckAsset, MaterialsWithoutSuchValuesAreNamed) {
    const MaterialFindings findings = checkMaterial(modelOf([](auto& m) { m.unlit = true; }), 0);
    EXPECT_FALSE(findings.isChecked);
    const AssetFindings all{ .file = "sign.glb", .materials = { findings }, .warnings = {} };
    EXPECT_TRUE(all.isPlausible());
    EXPECT_THAT(textOf(all), AllOf(HasSubstr("material 'paint': not checked"), HasSubstr("1 not checked")));
}

TEST(CheckAsset, OnlyModelsAreChecked) {
    for (const char* file : { "", "paint.mat" }) {
        const Result<AssetFindings> findings = checkAsset(file, assets::FilesFrom::Folder);
        ASSERT_FALSE(findings);
        EXPECT_THAT(findings.error().message, HasSubstr("--check-asset"));
    }
}

} // namespace
} // namespace filament_core::tools
