// SPDX-License-Identifier: Apache-2.0
// Statements without effect cost nothing: a property at its default or a member at its neutral value gives the same
// bytes as a material that does not mention it, for every shading model.
#include "base/Hash.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/StateProperties.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace filament_core::shader {
namespace {

struct Default {
    std::string_view property, value; ///< empty value: the property has none
};

/// In the order of the guide (4.2), then our own.
constexpr Default kDefaults[] = {
    { "name", "" }, // is what it is called
    { "domain", "surface" },
    { "featureLevel", "1" },
    { "shadingModel", "lit" },
    { "flipUV", "true" },
    { "quality", "default" },
    { "instanced", "false" },
    { "vertexDomainDeviceJittered", "false" },
    { "vertexDomain", "object" },
    { "interpolation", "smooth" },
    { "fullScreenTriangle", "false" },
    { "wideLines", "false" },
    { "sectionPlanes", "false" },
    { "sizedPoints", "false" },
    { "halfPrecision", "false" },
    { "blending", "opaque" },
    { "blendFunction", "" }, // only with blending : custom, and then it must be there
    { "postLightingBlending", "transparent" },
    { "transparency", "default" },
    { "maskThreshold", "0.4" },
    { "refractionMode", "none" },
    { "refractionType", "solid" },
    { "culling", "back" },
    { "colorWrite", "true" },
    { "depthWrite", "true" },
    { "depthCulling", "true" },
    { "doubleSided", "" }, // mentioning it lets instances switch it
    { "alphaToCoverage", "false" },
    { "reflections", "default" },
    { "shadowMultiplier", "false" },
    { "transparentShadow", "false" },
    { "clearCoatIorChange", "true" },
    { "multiBounceAmbientOcclusion", "true" },
    { "specularAmbientOcclusion", "simple" },
    { "specularAntiAliasing", "false" },
    { "specularAntiAliasingVariance", "0.15" },
    { "specularAntiAliasingThreshold", "0.2" },
    { "useDefaultDepthVariant", "false" },
    { "customSurfaceShading", "false" },
    { "clothDistribution", "" }, // only with shadingModel : cloth
};

/// The lists of the guide, empty or with default contents.
constexpr Default kLists[] = { { "parameters", "[]" }, { "constants", "[]" },          { "variantFilter", "[]" },
                               { "requires", "[]" },   { "requires", "[ position ]" }, { "variables", "[]" },
                               { "outputs", "[]" } };

std::string materialOf(std::string_view properties, std::string_view code) {
    return fmt::format("material {{\n{}\n}}\nfragment {{ void material(inout MaterialInputs m) {{ {} }} }}", properties,
                       code);
}

/// The hash of the whole package; 0, and a failure, if the text does not compile. Variants with more lights and with
/// shadows are left out: they take most of the time and use the same terms.
uint64_t hashOf(std::string const& text) {
    const Result<MaterialPackage> package =
            compileMaterial(text, "a.mat", { .filteredVariants = kVariantPunctual | kVariantShadowReceiver });
    EXPECT_TRUE(package) << text << (package ? "" : package.error().message);
    return package ? hashBytes(writePackage(*package)) : 0;
}

// Everything that the terms could affect: each of them is unset here.
constexpr const char* kPlainCode = "prepareMaterial(m); m.baseColor.rgb = vec3(0.2, 0.4, 0.6);";

TEST(Neutral, DefaultsThatAreStatedChangeNoByte) {
    const uint64_t unset = hashOf(materialOf("", kPlainCode));
    for (StateProperty const& property : stateProperties()) {
        const auto known = std::ranges::find(kDefaults, property.name, &Default::property);
        ASSERT_NE(known, std::end(kDefaults)) << property.name << " has no default in this test";
        if (known->value.empty()) continue;
        const std::string stated = fmt::format("{} : {}", known->property, known->value);
        EXPECT_EQ(hashOf(materialOf(stated, kPlainCode)), unset) << stated;
    }
    for (Default const& list : kLists) {
        const std::string stated = fmt::format("{} : {}", list.property, list.value);
        EXPECT_EQ(hashOf(materialOf(stated, kPlainCode)), unset) << stated;
    }
}

// The test above would also pass if the bytes never changed.
TEST(Neutral, OtherValuesThanTheDefaultsChangeTheBytes) {
    const uint64_t unset = hashOf(materialOf("", kPlainCode));
    for (const char* other : { "culling : none", "blending : fade", "doubleSided : true", "maskThreshold : 0.5",
                               "specularAntiAliasing : true", "featureLevel : 2", "vertexDomain : world" })
        EXPECT_NE(hashOf(materialOf(other, kPlainCode)), unset) << other;
}

constexpr const char* kModels[] = {
    "shadingModel : lit",
    "shadingModel : subsurface",
    "shadingModel : cloth",
    "shadingModel : specularGlossiness",
    "shadingModel : unlit",
    "refractionMode : cubemap",
    "refractionMode : cubemap, refractionType : thin",
    "shadingModel : specularGlossiness, refractionMode : cubemap",
};

MaterialDefinition definitionOf(std::string_view properties) {
    const std::string text = materialOf(properties, "");
    Result<MaterialText> parsed = parseMaterialText(text, "a.mat", {});
    EXPECT_TRUE(parsed);
    Result<MaterialDefinition> definition = defineMaterial(std::move(*parsed), "a.mat");
    EXPECT_TRUE(definition);
    return std::move(*definition);
}

std::string setTo(MaterialMember const& member, std::array<float, 4> value) {
    for (float& component : value) component = std::isnan(component) ? 0.0f : component;
    return fmt::format("m.{} = {};", member.name, floatLiteral(std::span(value).first(member.components)));
}

TEST(Neutral, MembersAtTheirNeutralValueChangeNoByteOfAnyShadingModel) {
    size_t compared = 0;
    for (const char* model : kModels) {
        const uint64_t unset = hashOf(materialOf(model, "prepareMaterial(m);"));
        const MaterialDefinition definition = definitionOf(model);
        for (MaterialMember const& member : materialMembers()) {
            if (!member.isMemberOf(definition) || member.absent == Absent::Untouched) continue;
            // a member that is always read is neutral at its initial value
            const std::string set = setTo(member, member.absent == Absent::Neutral ? member.neutral : member.initial);
            EXPECT_EQ(hashOf(materialOf(model, set + " prepareMaterial(m);")), unset) << model << ' ' << set;
            ++compared;
        }
    }
    EXPECT_GE(compared, 100u);
}

} // namespace
} // namespace filament_core::shader
