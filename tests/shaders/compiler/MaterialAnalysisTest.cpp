// SPDX-License-Identifier: Apache-2.0
// A material costs what it sets: unset and neutral members do not change any bit of the package.
#include "shaders/compiler/MaterialAnalysis.h"
#include "base/Hash.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/MaterialMembers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace filament_core::shader {
namespace {

std::optional<std::string> engineFile(std::string_view path) {
    const auto text = embeddedSource(path);
    return text ? std::optional(std::string(*text)) : std::nullopt;
}

std::string material(std::string_view code, std::string_view properties = "", std::string_view before = "") {
    return fmt::format("material {{ constants : [ {{ name : on, type : bool }}, {{ name : amount, type : float }} ],\n"
                       "parameters : [ {{ name : weight, type : float }} ],\n{} }}\nfragment {{\n{}\n"
                       "void material(inout MaterialInputs m) {{\n{}\n}} }}",
                       properties, before, code);
}

/// Whether the term is included; "?" with the reason if the text does not compile.
bool hasTerm(std::string_view term, std::string const& text) {
    Result<MaterialText> parsed = parseMaterialText(text, "a.mat", engineFile);
    EXPECT_TRUE(parsed) << (parsed ? "" : parsed.error().message);
    Result<MaterialDefinition> definition = defineMaterial(std::move(*parsed), "a.mat");
    EXPECT_TRUE(definition) << (definition ? "" : definition.error().message);
    Result<MaterialNeeds> needs = findNeeds(*definition, engineFile);
    EXPECT_TRUE(needs) << (needs ? "" : needs.error().message);
    const Result<void> found = findTerms(*definition, engineFile, *needs);
    EXPECT_TRUE(found) << (found ? "" : found.error().message);
    return needs->has(term);
}

bool sets(std::string_view term, std::string_view code, std::string_view before = "") {
    return hasTerm(term, material(code, "", before));
}

TEST(MaterialAnalysis, SeesWhatIsWrittenDirectlyAndThroughFunctions) {
    EXPECT_FALSE(sets("HAS_EMISSIVE", "prepareMaterial(m);"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive = vec4(1.0);"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive.g = materialParams.weight;"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); glow(m);",
                     "void glow(inout MaterialInputs x) { x.emissive = vec4(materialParams.weight); }"));
    EXPECT_TRUE(
            sets("HAS_EMISSIVE", "prepareMaterial(m); glow(m.emissive);", "void glow(inout vec4 e) { e.r = 2.0; }"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); SET(emissive) = vec4(1.0);", "\n#define SET(x) m.x\n"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m);\nfor (int i = 0; i < 3; ++i) m.emissive.rgb += "
                                     "materialParams.weight;"));
}

TEST(MaterialAnalysis, LeavesOutWhatEndsUpNeutralOnEveryPath) {
    EXPECT_FALSE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive = vec4(0.0);"));
    EXPECT_FALSE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive.rgb *= 2.0;"));
    EXPECT_FALSE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive = vec4(1.0); m.emissive = vec4(0.0);"));
    EXPECT_FALSE(sets("HAS_EMISSIVE", "prepareMaterial(m); if (1.0 < 0.5) m.emissive = vec4(1.0);"));
    EXPECT_FALSE(
            sets("HAS_EMISSIVE", "prepareMaterial(m);", "void unused(inout MaterialInputs x) { x.emissive.r = 1.0; }"));
    EXPECT_FALSE(sets("HAS_NORMAL", "m.normal = vec3(0.0, 0.0, 1.0); prepareMaterial(m);"));
    EXPECT_FALSE(sets("HAS_AMBIENT_OCCLUSION", "prepareMaterial(m); m.ambientOcclusion = 0.25 * 4.0;"));
}

TEST(MaterialAnalysis, KeepsWhatOneBranchWrites) {
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); if (materialParams.weight > 0.5) m.emissive = vec4(1.0);"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); if (materialConstants_on) m.emissive = vec4(1.0);"));
    EXPECT_TRUE(sets("HAS_EMISSIVE", "prepareMaterial(m); m.emissive.rgb = vec3(materialConstants_amount);"));
    EXPECT_TRUE(
            sets("HAS_EMISSIVE", "prepareMaterial(m); if (materialParams.weight > 0.5) return; m.emissive.r = 1.0;"));
    EXPECT_TRUE(
            sets("HAS_EMISSIVE", "prepareMaterial(m); if (materialParams.weight > 0.5) discard; m.emissive.r = 1.0;"));
}

TEST(MaterialAnalysis, RequiresTheNormalThatPrepareMaterialReads) {
    EXPECT_TRUE(sets("HAS_NORMAL", "m.normal.xy = vec2(0.1); prepareMaterial(m);"));
    EXPECT_TRUE(
            sets("HAS_NORMAL", "m.normal = vec3(1.0, 0.0, 0.0); prepareMaterial(m); m.normal = vec3(0.0, 0.0, 1.0);"));
    EXPECT_FALSE(sets("HAS_NORMAL", "prepareMaterial(m); m.normal = vec3(1.0, 0.0, 0.0);"));
}

TEST(MaterialAnalysis, FollowsTheBlendingOfThePostLightingColor) {
    const auto has = [](std::string_view mode, std::string_view color) {
        return hasTerm("HAS_POST_LIGHTING_COLOR",
                       material(fmt::format("prepareMaterial(m); m.postLightingColor = {};", color),
                                fmt::format("postLightingBlending : {}", mode)));
    };
    EXPECT_FALSE(has("transparent", "vec4(0.0)"));
    EXPECT_TRUE(has("multiply", "vec4(0.0)"));
    EXPECT_FALSE(has("multiply", "vec4(1.0)"));
    EXPECT_TRUE(has("opaque", "vec4(0.0)"));
    EXPECT_FALSE(
            hasTerm("HAS_POST_LIGHTING_COLOR", material("prepareMaterial(m);", "postLightingBlending : multiply")));
}

std::string valueOf(MaterialMember const& member, std::array<float, 4> value) {
    for (float& component : value) component = std::isnan(component) ? 0.0f : component;
    return floatLiteral(std::span(value).first(member.components));
}

TEST(MaterialAnalysis, GivesTheSamePackageForEveryNeutralMemberAsForNone) {
    const auto hashOf = [](std::string const& text) {
        const Result<MaterialPackage> package =
                compileMaterial(text, "a.mat", { .filteredVariants = kVariantPunctual });
        EXPECT_TRUE(package) << text << (package ? "" : package.error().message);
        return package ? hashBytes(writePackage(*package)) : 0;
    };
    const uint64_t none = hashOf(material("prepareMaterial(m);"));
    size_t neutral = 0;
    for (MaterialMember const& member : materialMembers()) {
        if (member.absent != Absent::Neutral || !member.isMemberOf(MaterialDefinition{})) continue;
        const std::string set = fmt::format("m.{} = {};", member.name, valueOf(member, member.neutral));
        EXPECT_EQ(hashOf(material(set + " prepareMaterial(m);")), none) << set;
        ++neutral;
    }
    EXPECT_GE(neutral, 8u);
}

} // namespace
} // namespace filament_core::shader
