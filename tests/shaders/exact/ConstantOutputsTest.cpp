// SPDX-License-Identifier: Apache-2.0
// Vertex outputs that are constant, as a whole or in a component, on both devices: OpenGL ES linkers know the constant,
// Vulkan interpolates it.
#include "tests/shaders/exact/PictureFixture.h"

namespace filament_core::shader {
namespace {

using test::MaterialScene;

struct Output {
    const char* name;
    const char* vertex;   ///< statements of materialVertex()
    const char* fragment; ///< the colour
    const char* head = "variables : [ b ]";
};

class ConstantOutputs : public test::PictureFixture, public ::testing::WithParamInterface<Output> {};

TEST_P(ConstantOutputs, AreInterpolatedAlikeOnBothApis) {
    MaterialScene scene;
    scene.source = std::string("material { name : constant, shadingModel : unlit, constants : [ { name : c, type : "
                               "float, default : 0.3 } ], ") +
                   GetParam().head + " }\nvertex { void materialVertex(inout MaterialVertexInputs material) { " +
                   GetParam().vertex +
                   " } }\nfragment { void material(inout MaterialInputs material) { prepareMaterial(material); "
                   "material.baseColor = " +
                   GetParam().fragment + "; } }";
    EXPECT_FALSE(draw(scene).empty());
}

INSTANTIATE_TEST_SUITE_P(
        Of, ConstantOutputs,
        ::testing::Values(Output{ "OneComponent", "material.b = vec4(getPosition().xyz, 1.0);",
                                  "vec4(vec3(variable_b.w == 1.0 ? 0.3 : 0.9), 1.0)" },
                          Output{ "Whole", "material.b = vec4(0.1);",
                                  "vec4(variable_b.xyz * 3.7 + variable_b.w, 1.0)" },
                          Output{ "Zero", "material.b = vec4(0.0);", "vec4(variable_b.xyz + 0.5, 1.0)" },
                          Output{ "Specialised", "material.b = vec4(materialConstants_c * 0.7);",
                                  "vec4(fract(variable_b.xyz * 371.3), 1.0)" },
                          Output{ "OfALoop", "material.b = vec4(0.0); for (int i = 0; i < 5; ++i) material.b += 0.1;",
                                  "vec4(fract(variable_b.xyz * 371.3), 1.0)" },
                          Output{ "OfALocalArray",
                                  "float l[3]; l[0] = 0.1; l[1] = 0.2; l[2] = 0.7; float s = 0.0; "
                                  "for (int i = 0; i < 3; ++i) s += l[i]; material.b = vec4(s);",
                                  "vec4(fract(variable_b.xyz * 371.3), 1.0)" },
                          Output{ "Chosen", "material.b = getPosition().x > 0.0 ? vec4(0.3) : vec4(0.7);",
                                  "vec4(fract(variable_b.xyz * 371.3), 1.0)" },
                          Output{ "Twice", "material.b = vec4(material.uv0, 0.1, 0.1); material.d = material.b;",
                                  "vec4(fract((variable_b.xyz + variable_d.yzw) * 371.3), 1.0)",
                                  "requires : [ uv0 ], variables : [ b, d ]" },
                          Output{ "Uv", "material.uv0 = vec2(0.3, 0.7);", "vec4(fract(getUV0() * 371.3), 0.0, 1.0)",
                                  "requires : [ uv0 ]" },
                          Output{ "Color", "material.color = vec4(0.3, material.color.g, 0.7, 1.0);",
                                  "vec4(fract(getColor().rgb * 371.3), 1.0)", "requires : [ color ]" },
                          Output{ "Normal", "material.worldNormal = vec3(0.6, 0.0, 0.8);",
                                  "vec4(fract(getWorldTangentFrame()[2] * 371.3), 1.0)", "requires : [ tangents ]" }),
        [](auto const& each) { return std::string(each.param.name); });

} // namespace
} // namespace filament_core::shader
