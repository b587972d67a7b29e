// SPDX-License-Identifier: Apache-2.0
// Materials that compile and say something odd; and that our own say nothing odd.
#include "shaders/compiler/IgnoredNames.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "toolkit/paths/Paths.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace filament_core::shader {
namespace {

using Lines = std::vector<std::string>;

Lines warningsOf(std::string const& text) {
    Lines warnings;
    CompileOptions options;
    options.filteredVariants = kAllVariantBits; // they are about the text
    options.warnings = &warnings;
    const Result<MaterialPackage> package = compileMaterial(text, "a.mat", options);
    EXPECT_TRUE(package) << package.error().message;
    return warnings;
}

std::string fragment(std::string const& code) {
    return "\nfragment {\nvoid material(inout MaterialInputs material) {\n" + code + "\n} }";
}

TEST(Warnings, NameAParameterThatNothingReads) {
    EXPECT_EQ(warningsOf("material { parameters : [\n{ name : a, type : float },\n{ name : b, type : sampler2d },\n"
                         "{ name : c, type : float } ] }" +
                         fragment("prepareMaterial(material); material.roughness = materialParams.c;")),
              (Lines{ "a.mat:2: no code reads the parameter 'a'; leave it out",
                      "a.mat:3: no code reads the parameter 'b'; leave it out" }));
}

TEST(Warnings, NameAMaterialThatIsNeverPrepared) {
    for (const char* model : { "lit", "unlit" }) {
        EXPECT_EQ(warningsOf(std::string("material { shadingModel : ") + model + " }" +
                             fragment("material.baseColor.r = 0.5;")),
                  Lines{ "a.mat:3: material() does not call prepareMaterial(material), so normals and reflections are "
                         "known only after it; call it behind what sets material.normal" });
    }
}

// The engine prepares it, with the normal that material() sets.
// Without code, the members keep their initial values.
TEST(Warnings, AreNotGivenForAMaterialWithoutCode) {
    const std::string head = "material { shadingModel : lit, blending : masked }\n";
    const auto whole = compileMaterial(head + fragment("prepareMaterial(material);"), "a.mat", {});
    ASSERT_TRUE(whole);
    for (const char* rest : { "", "fragment {\n}", "fragment {\n// later\n/* much\nlater */ }", "vertex {\n}" }) {
        EXPECT_EQ(warningsOf(head + rest), Lines{}) << rest;
        const auto package = compileMaterial(head + rest, "a.mat", {});
        ASSERT_TRUE(package) << rest << package.error().message;
        EXPECT_EQ(package->variants, whole->variants) << rest;
    }
}

TEST(Warnings, LeaveAnUnpreparedMaterialLikeOneThatIsPreparedLast) {
    const std::string set = "material.normal = vec3(0.6, 0.0, 0.8); material.roughness = 0.3; ";
    CompileOptions options;
    const auto unprepared = compileMaterial("material {}" + fragment(set), "a.mat", options);
    const auto prepared =
            compileMaterial("material {}" + fragment(set + "prepareMaterial(material);"), "a.mat", options);
    ASSERT_TRUE(unprepared && prepared);
    EXPECT_EQ(unprepared->terms, prepared->terms);
    EXPECT_EQ(unprepared->variants, prepared->variants);
}

TEST(Warnings, NameTheLineOfAConstantThatIsNoNumber) {
    EXPECT_EQ(warningsOf("material {}" + fragment("prepareMaterial(material);\nmaterial.roughness = 0.0 / 0.0;")),
              Lines{ "a.mat:5: this is not a number: zero divided by zero, or a root or logarithm of a negative "
                     "number" });
}

TEST(Warnings, NameReflectionsOfWhatMirrorsNothing) {
    for (const char* model : { "unlit", "cloth", "subsurface" }) {
        const std::string text = std::string("material { shadingModel : ") + model + ",\nreflections : screenspace }" +
                                 fragment("prepareMaterial(material);");
        EXPECT_EQ(warningsOf(text), Lines{ "a.mat:2: this shadingModel mirrors nothing: reflections has no effect" });
        EXPECT_EQ(compileMaterial(text, "a.mat", { .filteredVariants = kAllVariantBits })->reflections,
                  Reflections::Default);
    }
}

TEST(Warnings, NameAnAttributeThatIsRequiredTwice) {
    EXPECT_EQ(warningsOf("material {\nrequires : [ uv0,\nuv0 ] }" +
                         fragment("prepareMaterial(material); material.baseColor.rg = getUV0();")),
              Lines{ "a.mat:3: 'uv0' is required twice" });
}

TEST(Warnings, NamePropertiesThatTheEngineDoesWithout) {
    const std::string text = "material {\nlinearFog : true,\nshadowFarAttenuation : true,\ncoloredPenumbra : true,\n"
                             "legacyMorphing : true,\ndefines : [ WET ],\napiLevel : 2,\nframebufferFetch : true,\n"
                             "stereoscopicType : multiview,\nstereoscopicEyeCount : 2,\n"
                             "constants : [ {\nname : wet, type : bool, mutable : true } ],\n"
                             "parameters : [ {\nname : tint, type : float, stages : [ fragment ] } ] }" +
                             fragment("prepareMaterial(material); material.roughness = materialParams.tint;");
    EXPECT_EQ(
            warningsOf(text),
            (Lines{ "a.mat:2: the property 'linearFog' has no effect: fog is that of the view for all materials",
                    "a.mat:3: the property 'shadowFarAttenuation' has no effect: shadows of the sun do not fade with "
                    "the distance from the camera",
                    "a.mat:4: the property 'coloredPenumbra' has no effect: the edge of a shadow has the colour of "
                    "its light",
                    "a.mat:5: the property 'legacyMorphing' has no effect: morph targets are those of the renderable, "
                    "any number of them",
                    "a.mat:6: the property 'defines' has no effect: macros are given with `matc -D NAME=VALUE`, or by "
                    "`#define` in a block",
                    "a.mat:7: the property 'apiLevel' has no effect: there is one level of functions",
                    "a.mat:8: the property 'framebufferFetch' has no effect: a parameter with `currentPixel : true` "
                    "reads the pixel that is written",
                    "a.mat:9: the property 'stereoscopicType' has no effect: a view has one eye",
                    "a.mat:10: the property 'stereoscopicEyeCount' has no effect: a view has one eye",
                    "a.mat:12: the field 'mutable' of a constant has no effect: constants are set when the material is "
                    "loaded; load it once for each value",
                    "a.mat:14: the field 'stages' of a parameter has no effect: both blocks can read every "
                    "parameter" }));
}

TEST(Warnings, AreNotGivenForWhatTheEngineDoesAnyway) {
    size_t count = 0;
    for (IgnoredName const& each : ignoredNames()) {
        if (each.asItIs.empty() || each.of != "property") continue;
        const std::string text = fmt::format("material {{ {} : {} }}", each.name, each.asItIs);
        EXPECT_EQ(warningsOf(text), Lines{}) << text;
        ++count;
    }
    EXPECT_GE(count, 8u);
}

TEST(Warnings, AreNotGivenForOurOwnSamples) {
    size_t count = 0;
    for (auto const& entry : std::filesystem::directory_iterator(tools::sourceDir() / "samples/materials")) {
        if (entry.path().extension() != ".mat") continue;
        std::ifstream file(entry.path());
        const std::string text{ std::istreambuf_iterator<char>(file), {} };
        Lines warnings;
        CompileOptions options;
        options.essl = options.spirv = false;
        options.filteredVariants = kAllVariantBits;
        options.warnings = &warnings;
        const auto package = compileMaterial(text, entry.path().filename().string(), options);
        EXPECT_TRUE(package) << package.error().message;
        EXPECT_EQ(warnings, Lines{});
        ++count;
    }
    EXPECT_GE(count, 60u);
}

} // namespace
} // namespace filament_core::shader
