// SPDX-License-Identifier: Apache-2.0
// Conditions that combine a parameter with a value that varies per fragment, written by an author or generated for a
// layer that may be absent: lavapipe of Mesa 22.3 crashed on them (backend/vulkan/Quirks.h).
#include "tests/samples/materials/SampleStage.h"

#include <gtest/gtest.h>

namespace filament_core::samples {
namespace {

// A loop, which drivers do not turn into a selection between two values.
#define SEVERAL_TIMES "for (int i = 0; i < int(getUV0().y * 9.0); ++i) material.roughness *= 0.8;"

struct Condition {
    const char* name;
    const char* statement;
};

class ConditionsOfParameterAndVarying : public testing::TestWithParam<Condition> {};

/// clear_coat.mat with another statement in place of its coat. The driver's defect only affects a parameter that is not
/// the first of its buffer.
std::vector<tools::TextEdit> editsFor(std::string const& statement) {
    return { { "shadingModel : lit,", "shadingModel : lit, requires : [ uv0, tangents ]," },
             { "{ name : strength, type : float }",
               "{ name : first, type : float4 }, { name : strength, type : float }, { name : tint, type : float3 }" },
             { "// show: strength=1", "// show: strength=1 tint=1,0.5,0.2" },
             { "material.clearCoat = materialParams.strength;", statement } };
}

TEST_P(ConditionsOfParameterAndVarying, DrawTheSameOnBothApis) {
    const Sample coat{ .name = "clear_coat" };
    const std::vector<tools::TextEdit> edits = editsFor(GetParam().statement);
    const Picture vulkan = draw(coat, edits, Backend::Vulkan);
    const Picture gles = draw(coat, edits, Backend::Gles);
    ASSERT_FALSE(vulkan.pixels.empty());
    EXPECT_EQ(differingPixels(vulkan, gles), 0u);
    const Picture without = draw(coat, editsFor(""), Backend::Gles);
    EXPECT_GT(differingPixels(gles, without), 40u) << "the picture does not depend on: " << GetParam().statement;
}

INSTANTIATE_TEST_SUITE_P(
        All, ConditionsOfParameterAndVarying,
        testing::Values(
                Condition{ "CoatParameterFirst", "material.clearCoat = materialParams.strength * getUV0().x;" },
                Condition{ "CoatVaryingFirst", "material.clearCoat = getUV0().x * materialParams.strength;" },
                Condition{ "GroovesParameterFirst", "material.anisotropy = materialParams.strength * getUV0().x;" },
                Condition{ "GroovesVaryingFirst", "material.anisotropy = getUV0().x * materialParams.strength;" },
                Condition{ "SheenParameterFirst", "material.sheenColor = materialParams.tint * getUV0().x;" },
                Condition{ "SheenVaryingFirst", "material.sheenColor = getUV0().x * materialParams.tint;" },
                Condition{ "FilmParameterFirst", "material.iridescence = materialParams.strength * getUV0().x;" },
                Condition{ "FilmVaryingFirst", "material.iridescence = getUV0().x * materialParams.strength;" },
                Condition{ "OfTheAuthorParameterFirst",
                           "if (materialParams.strength * getUV0().x > 0.5) " SEVERAL_TIMES },
                Condition{ "OfTheAuthorVaryingFirst",
                           "if (getUV0().x * materialParams.strength > 0.5) " SEVERAL_TIMES }),
        [](auto const& test) { return test.param.name; });

} // namespace
} // namespace filament_core::samples
