// SPDX-License-Identifier: Apache-2.0
// What later versions of the language have.
#include "shaders/compiler/MaterialCompiler.h"

#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

std::string surfaceOfLater(std::string const& head, std::string const& code = "", std::string const& vertex = "") {
    return "material {\n" + head + " }\n" + vertex +
           "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n" + code + "\n} }";
}

TEST(LaterLanguage, LeavesTheVertexBlockOutOfDepthIfTheMaterialAsksForIt) {
    const std::string head = "variables : [ wave ]";
    const std::string block = "vertex { void materialVertex(inout MaterialVertexInputs m) { m.wave = "
                              "vec4(getUserTime().x); } }\n";
    const auto with = compileMaterial(surfaceOfLater(head + ", useDefaultDepthVariant : true", "", block), "a.mat");
    const auto all = compileMaterial(surfaceOfLater(head, "", block), "a.mat");
    const auto none = compileMaterial(surfaceOfLater(head), "a.mat");
    ASSERT_TRUE(with && all && none) << with.error().message;
    EXPECT_TRUE(all->depthReadsParameters);
    EXPECT_FALSE(with->depthReadsParameters);
    for (Variant const& variant : with->variants) {
        MaterialPackage const& same = (variant.key & kVariantDepth) != 0 ? *none : *all;
        ASSERT_NE(same.findVariant(variant.key), nullptr) << variant.key;
        EXPECT_EQ(*same.findVariant(variant.key), variant) << variant.key;
    }
}

} // namespace
} // namespace filament_core::shader
