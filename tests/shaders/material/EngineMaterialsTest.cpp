// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/EngineMaterials.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/interface/SamplerBudget.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"
#include "shaders/package/Package.h"
#include "shaders/package/RemoveUnusedTextures.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <string>
#include <tuple>
#include <unordered_set>

namespace filament_core::shader {
namespace {

MaterialPackage read(std::string_view name) {
    const Result<MaterialPackage> package = readPackage(engineMaterial(name));
    EXPECT_TRUE(package) << name << ": " << (package ? "" : package.error().message);
    return package ? *package : MaterialPackage{};
}

/// Modules that are valid already: variants and families share many.
class ValidModules {
public:
    std::string errorsIn(std::span<const uint32_t> spirv) {
        const auto* bytes = reinterpret_cast<const char*>(spirv.data());
        if (!mModules.emplace(bytes, spirv.size_bytes()).second) return {};
        return test::validationErrors(spirv);
    }

private:
    std::unordered_set<std::string> mModules;
};

TEST(EngineMaterials, HaveEveryVariantValidInBothLanguages) {
    ValidModules modules;
    ASSERT_GE(engineMaterialNames().size(), 9u);
    for (const std::string_view name : engineMaterialNames()) {
        const MaterialPackage package = read(name);
        // A program knows a built-in material by the name that it creates it by.
        if (!name.starts_with("built_in_")) {
            EXPECT_EQ(package.name, name);
        }
        const size_t precisions = name.starts_with("gltf_lit_") ? 2 : 1;
        const size_t lit = 7 * precisions; // sun, punctual lights, shadows of either
        const bool merges = std::ranges::any_of(package.parameters, &Parameter::currentPixel);
        const size_t unlit = merges || package.shadowMultiplier ? 2 : 1; // merged into the pass before it, or not;
                                                                         // shadowed, or not
        const size_t color = package.shading == ShadingModel::Unlit ? unlit : lit;
        const bool isSurface = package.domain == MaterialDomain::Surface;
        const bool isDeformable = isSurface && package.vertexDomain == VertexDomain::Object &&
                                  (package.filteredVariants & kVariantSkinning) == 0;
        const bool stopsLight = package.blending == Blending::Opaque || package.blending == Blending::Masked;
        const size_t depth = isSurface && stopsLight && (package.depthWrite || isDeformable) ? 1 : 0;
        const bool hasVertexBlock = name == "motion" || name == "level_fade" || name == "built_in_wireframe" ||
                                    name == "built_in_points" || name == "light_shape_image";
        const size_t motion = hasVertexBlock ? 1 : 0;
        const bool isOfGeometry = (package.requiredAttributes >> kAttributePosition & 1) != 0;
        const size_t debug = isSurface && isOfGeometry ? 1 : 0;
        EXPECT_EQ(package.variants.size(), (color + depth + motion + debug) * (isDeformable ? 2 : 1)) << name;
        for (Variant const& variant : package.variants) {
            EXPECT_EQ(modules.errorsIn(variant.vertex->spirv), "") << name << " " << int{ variant.key };
            EXPECT_EQ(modules.errorsIn(variant.fragment->spirv), "") << name << " " << int{ variant.key };
            EXPECT_TRUE(variant.vertex->essl.starts_with("#version 310 es")) << name;
            EXPECT_TRUE(variant.fragment->essl.starts_with("#version 310 es")) << name;
        }
        EXPECT_EQ(package.layout[kGroupView], viewGroupLayout()) << name;
        EXPECT_EQ(package.layout[kGroupPass], passGroupLayout(passKind(package))) << name;
    }
}

test::DerivativeUse derivativesOf(std::string_view main) {
    const std::string glsl = "#version 450\nlayout(location = 0) in vec2 v; layout(location = 0) out vec2 o;\n"
                             "void cut() { if (v.x < 0.5) discard; }\n" +
                             std::string(main);
    const auto spirv = spirvFromGlsl(glsl, backend::ShaderStage::Fragment, "test");
    EXPECT_TRUE(spirv);
    return spirv ? test::derivativeUse(*spirv) : test::DerivativeUse{};
}

TEST(EngineMaterials, AreSearchedForDerivativesInTheOrderOfCalls) {
    const test::DerivativeUse before = derivativesOf("void main() { o = dFdx(v); cut(); }");
    EXPECT_EQ(std::tuple(before.hasDiscard, before.beforeDiscard, before.afterDiscard), std::tuple(true, 1u, 0u));
    const test::DerivativeUse after = derivativesOf("void main() { cut(); o = dFdx(v) + fwidth(v); }");
    EXPECT_EQ(std::tuple(after.hasDiscard, after.beforeDiscard, after.afterDiscard), std::tuple(true, 0u, 2u));
    EXPECT_FALSE(derivativesOf("void main() { o = dFdy(v); }").hasDiscard);
}

/// Drivers may stop at a discard; neighbours then have undefined derivatives. On Mesa no image shows it.
TEST(EngineMaterials, TakeDerivativesBeforeTheyDiscard) {
    size_t discarding = 0, differentiating = 0;
    for (const std::string_view name : engineMaterialNames()) {
        for (Variant const& variant : read(name).variants) {
            const test::DerivativeUse use = test::derivativeUse(variant.fragment->spirv);
            EXPECT_EQ(use.afterDiscard, 0u) << name << " " << int{ variant.key };
            discarding += use.hasDiscard;
            differentiating += use.hasDiscard && use.beforeDiscard > 0;
        }
    }
    EXPECT_GT(discarding, 50u);
    EXPECT_GT(differentiating, 50u);
}

/// As Filament's do; glTF has no property for it.
TEST(EngineMaterials, OfGltfReflectThePictureIfTheyAreLit) {
    size_t count = 0;
    for (const std::string_view name : engineMaterialNames()) {
        if (!name.starts_with("gltf_")) continue;
        const bool isLit = name.find("_unlit_") == std::string_view::npos;
        EXPECT_EQ(read(name).reflections == Reflections::ScreenSpace, isLit) << name;
        count += isLit;
    }
    EXPECT_GE(count, 12u);
}

/// The textures that the engine gives a material of this kind if every effect is on.
uint32_t engineShare(MaterialPackage const& package) { return samplersOfEngine(passKind(package)); }

uint32_t ownSamplers(MaterialPackage const& package, uint16_t key) {
    return samplerCount(programLayout(package, key)[kGroupMaterial]);
}

// The textures that no constant can switch off, and all textures of materials below level 3, fit into any device.
TEST(EngineMaterials, FitEveryDeviceInEveryVariantWithEveryEffectOn) {
    for (const std::string_view name : engineMaterialNames()) {
        const MaterialPackage package = read(name);
        const auto alwaysRead = std::ranges::count_if(package.parameters, [](Parameter const& parameter) {
            return isTexture(parameter.type) && parameter.usedIf.empty();
        });
        for (Variant const& variant : package.variants) {
            EXPECT_LE(alwaysRead + engineShare(package), kSamplersOfEveryDevice) << name << " " << variant.key;
            if (package.featureLevel == 3) continue; // covered by the next test
            EXPECT_LE(ownSamplers(package, variant.key) + engineShare(package), kSamplersOfEveryDevice)
                    << name << " " << variant.key;
            EXPECT_EQ(samplerCount(programLayout(package, variant.key)[kGroupDeformation]), 0u)
                    << "of the vertex stage";
        }
    }
}

/// Each texture that can be switched off is on or off according to the bits of `used`.
std::vector<backend::ConstantValue> constantsFor(MaterialPackage const& package, uint32_t used) {
    std::vector<backend::ConstantValue> constants;
    uint32_t bit = 0;
    for (Parameter const& parameter : package.parameters) {
        if (parameter.usedIf.empty()) continue;
        constants.push_back({ .id = parameter.usedIf.back(), .bits = used >> bit++ & 1 });
    }
    return constants;
}

/// Sets of `count` textures: every run of neighbours around the end, and 2000 at random. All sets would be millions.
std::vector<uint32_t> setsOfTextures(uint32_t count) {
    const uint32_t all = (1u << count) - 1;
    std::vector<uint32_t> sets{ 0, all };
    for (uint32_t length = 1; length < count; ++length) {
        const uint32_t run = (1u << length) - 1;
        for (uint32_t first = 0; first < count; ++first) sets.push_back((run << first | run >> (count - first)) & all);
    }
    std::mt19937 random(count);
    for (int i = 0; i < 2000; ++i) sets.push_back(static_cast<uint32_t>(random()) & all);
    return sets;
}

TEST(EngineMaterials, OfLevelThreeFitEveryDeviceWithAnyOfTheirTexturesThatTheBudgetLeaves) {
    uint32_t materials = 0;
    for (const std::string_view name : engineMaterialNames()) {
        MaterialPackage whole = read(name);
        if (whole.featureLevel < 3) continue;
        whole.variants.clear(); // their layouts follow from the package's
        const uint32_t all = samplerCount(whole.layout[kGroupMaterial]);
        const uint32_t engines = samplerCount(whole.layout[kGroupPass]);
        const uint32_t most = samplersOfMaterial(passKind(whole));
        EXPECT_GT(all, most) << name << " does not need level 3";
        ASSERT_LT(all, 32u);
        for (const uint32_t used : setsOfTextures(all)) {
            MaterialPackage package = whole;
            removeUnusedTextures(package, constantsFor(whole, used));
            const uint32_t left = samplerCount(package.layout[kGroupMaterial]);
            ASSERT_EQ(left, std::max(1, std::popcount(used))) << name << " " << used;
            ASSERT_EQ(left + engines <= kSamplersOfEveryDevice, left <= most) << name << " " << used;
        }
        ++materials;
    }
    EXPECT_GT(materials, 0u);
}

TEST(EngineMaterials, AreAnEmptySpanForAnUnknownName) { EXPECT_TRUE(engineMaterial("gltf_lit").empty()); }

void expectTheSameInterface(std::string const& family, std::initializer_list<const char*> others) {
    const MaterialPackage opaque = read(family + "_opaque");
    for (const char* suffix : others) {
        const std::string other = family + suffix;
        const MaterialPackage package = read(other);
        EXPECT_EQ(package.constants, opaque.constants) << other;
        for (Parameter const& parameter : opaque.parameters) {
            const Parameter* found = package.findParameter(parameter.name);
            ASSERT_NE(found, nullptr) << other << " lacks " << parameter.name;
            EXPECT_EQ(*found, parameter);
        }
    }
}

TEST(EngineMaterials, OfferTheLoaderTheSameInterfaceInAllMaterialsOfAGltfFamily) {
    for (const char* family : { "gltf_lit", "gltf_layered", "gltf_specular_glossiness", "gltf_transmissive_thin",
                                "gltf_transmissive_solid", "gltf_scattering" })
        expectTheSameInterface(family, { "_masked", "_blended" });
    // Those with section planes take the settings of those without; a masked one draws opaque materials, and the
    // layered ones what has no layers.
    for (const char* suffix : { "_masked", "_blended" }) {
        for (const char* family :
             { "layered", "unlit", "specular_glossiness", "transmissive_thin", "transmissive_solid", "scattering" }) {
            const MaterialPackage plain = read(std::string("gltf_") + family + suffix);
            const MaterialPackage cut = read(std::string("gltf_section_") + family + suffix);
            EXPECT_EQ(cut.parameters, plain.parameters) << family;
            EXPECT_EQ(cut.constants, plain.constants) << family;
            EXPECT_TRUE(cut.sectionPlanes && !plain.sectionPlanes) << family;
        }
    }
    for (Constant const& constant : read("gltf_lit_opaque").constants)
        EXPECT_NE(read("gltf_section_layered_masked").findConstant(constant.name), nullptr) << constant.name;
    EXPECT_NE(read("gltf_lit_masked").findParameter("_maskThreshold"), nullptr);
    EXPECT_EQ(read("gltf_lit_blended").blending, Blending::Fade) << "alpha is coverage, of the reflection too";
    EXPECT_FALSE(read("gltf_lit_blended").depthWrite);
}

TEST(EngineMaterials, SkyAndPostProcessNeedNoGeometry) {
    for (const char* name : { "skybox", "tonemap" }) EXPECT_EQ(read(name).requiredAttributes, 0u) << name;
    const MaterialPackage toneMap = read("tonemap");
    using enum backend::BindingType;
    EXPECT_EQ(programLayout(toneMap, 0)[kGroupMaterial].bindings[0].type, SampledTexture);
    EXPECT_EQ(programLayout(toneMap, kVariantMerged)[kGroupMaterial].bindings[0].type, InputAttachment);
}

} // namespace
} // namespace filament_core::shader
