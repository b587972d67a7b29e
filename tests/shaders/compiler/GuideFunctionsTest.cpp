// SPDX-License-Identifier: Apache-2.0
// Every public function of the materials guide, 4.5, in a material that calls nothing else; and spellings of the guide.
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/interface/SamplerBudget.h"

#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

struct Call {
    const char* name;
    const char* expression; ///< a value of any type that can be assigned to `type`
    const char* type;
    const char* head = "";
};

std::string materialOf(Call const& call, bool inVertex, const char* shading) {
    const std::string use = std::string(call.type) + " value = " + call.expression + "; ";
    std::string text = std::string("material { shadingModel : ") + shading +
                       ", variables : [ v ], variantFilter : [ dynamicLighting, directionalLighting, skinning ] " +
                       call.head + " }\n";
    if (inVertex) {
        text += "vertex { void materialVertex(inout MaterialVertexInputs material) { " + use +
                "material.v = vec4(value == value ? 1.0 : 0.5); } }\n";
    }
    return text + "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); " +
           (inVertex ? "material.baseColor = variable_v;" : use + "if (value == value) material.baseColor.r = 0.5;") +
           " } }";
}

class GuideFunctions : public ::testing::TestWithParam<Call> {};
class GuideVertexFunctions : public ::testing::TestWithParam<Call> {};

void expectCompiles(Call const& call, bool inVertex) {
    for (const char* shading : { "unlit", "lit" }) {
        const std::string text = materialOf(call, inVertex, shading);
        const Result<MaterialPackage> package = compileMaterial(text, "a.mat");
        EXPECT_TRUE(package) << (package ? "" : package.error().message) << "\n" << text;
    }
}

TEST_P(GuideFunctions, CompileAlone) { expectCompiles(GetParam(), false); }
TEST_P(GuideVertexFunctions, CompileAlone) { expectCompiles(GetParam(), true); }

std::string nameOf(::testing::TestParamInfo<Call> const& each) { return each.param.name; }

// Tables 4.5.1 to 4.5.4 of the guide.
const Call kBothStages[] = {
    { "Pi", "PI + HALF_PI", "float" },
    { "Saturate", "saturate(2.0)", "float" },
    { "Pow5", "pow5(2.0)", "float" },
    { "Sq", "sq(2.0)", "float" },
    { "Max3", "max3(float3(1.0, 2.0, 3.0))", "float" },
    { "MulMat4x4Float3", "mulMat4x4Float3(float4x4(1.0), float3(1.0))", "float4" },
    { "MulMat3x3Float3", "mulMat3x3Float3(float4x4(1.0), float3(1.0))", "float3" },
    { "ClipFromWorld", "getClipFromWorldMatrix()", "float4x4" },
    { "WorldFromClip", "getWorldFromClipMatrix()", "float4x4" },
    { "ClipFromView", "getClipFromViewMatrix()", "float4x4" },
    { "ViewFromWorld", "getViewFromWorldMatrix()", "float4x4" },
    { "WorldFromView", "getWorldFromViewMatrix()", "float4x4" },
    { "ViewFromClip", "getViewFromClipMatrix()", "float4x4" },
    { "UserWorldFromWorld", "getUserWorldFromWorldMatrix()", "float4x4" },
    { "Resolution", "getResolution()", "float4" },
    { "CameraPosition", "getWorldCameraPosition()", "float3" },
    { "WorldOffset", "getWorldOffset()", "float3" },
    { "Time", "getTime()", "float" },
    { "UserTime", "getUserTime()", "float4" },
    { "UserTimeMod", "getUserTimeMod(3.0)", "float" },
    { "Exposure", "getExposure()", "float" },
    { "Ev100", "getEV100()", "float" },
    // Later than the guide, or in none.
    { "EyeIndex", "getEyeIndex()", "int" },
    { "EyeFromView", "getEyeFromViewMatrix() * getEyeFromViewMatrix(0)", "float4x4" },
    { "ClipFromWorldOfEye", "getClipFromWorldMatrix(0)", "float4x4" },
    { "IsPerspective", "isPerspectiveProjection()", "bool" },
    { "RenderTargetUv", "uvToRenderTargetUV(float2(0.5))", "float2" },
    { "Heatmap", "heatmap(0.5)", "float3" },
    { "Min3", "min3(float3(1.0, 2.0, 3.0))", "float" },
    { "Largest", "vmax(float2(1.0)) + vmax(float3(1.0)) + vmax(float4(1.0))", "float" },
    { "Smallest", "vmin(float2(1.0)) + vmin(float3(1.0)) + vmin(float4(1.0))", "float" },
    { "Cofactor", "cofactor(float3x3(1.0))", "float3x3" },
};
INSTANTIATE_TEST_SUITE_P(Both, GuideFunctions, ::testing::ValuesIn(kBothStages), nameOf);
INSTANTIATE_TEST_SUITE_P(Both, GuideVertexFunctions, ::testing::ValuesIn(kBothStages), nameOf);

// Table 4.5.6.
INSTANTIATE_TEST_SUITE_P(Vertex, GuideVertexFunctions,
                         ::testing::Values(Call{ "Position", "getPosition()", "float4" },
                                           Call{ "Custom0", "getCustom0()", "float4", ", requires : [ custom0 ]" },
                                           Call{ "Custom7", "getCustom7()", "float4", ", requires : [ custom7 ]" },
                                           Call{ "WorldFromModel", "getWorldFromModelMatrix()", "float4x4" },
                                           Call{ "NormalMatrix", "getWorldFromModelNormalMatrix()", "float3x3" },
                                           Call{ "UserPosition", "getUserWorldPosition()", "float3" },
                                           Call{ "VertexId", "gl_VertexID + gl_InstanceID", "int" },
                                           Call{ "InstanceId", "gl_InstanceID", "int", ", instanced : true" },
                                           Call{ "VertexIndex", "getVertexIndex()", "int" }),
                         nameOf);

// Table 4.5.7.
INSTANTIATE_TEST_SUITE_P(
        Fragment, GuideFunctions,
        ::testing::Values(Call{ "TangentFrame", "getWorldTangentFrame()", "float3x3", ", requires : [ tangents ]" },
                          Call{ "Position", "getWorldPosition()", "float3" },
                          Call{ "UserPosition", "getUserWorldPosition()", "float3" },
                          Call{ "View", "getWorldViewVector()", "float3", ", requires : [ tangents ]" },
                          Call{ "Normal", "getWorldNormalVector()", "float3", ", requires : [ tangents ]" },
                          Call{ "Geometric", "getWorldGeometricNormalVector()", "float3", ", requires : [ tangents ]" },
                          Call{ "Reflected", "getWorldReflectedVector()", "float3", ", requires : [ tangents ]" },
                          Call{ "Viewport", "getNormalizedViewportCoord()", "float3" },
                          Call{ "NdotV", "getNdotV()", "float", ", requires : [ tangents ]" },
                          Call{ "Color", "getColor()", "float4", ", requires : [ color ]" },
                          Call{ "Uv0", "getUV0()", "float2", ", requires : [ uv0 ]" },
                          Call{ "Uv1", "getUV1()", "float2", ", requires : [ uv1 ]" },
                          Call{ "Custom0", "getCustom0()", "float4", ", requires : [ custom0 ]" },
                          Call{ "Custom7", "getCustom0() + getCustom7()", "float4",
                                ", requires : [ custom7, custom0 ]" },
                          Call{ "MaskThreshold", "getMaskThreshold()", "float", ", blending : masked" },
                          Call{ "InverseTonemap", "inverseTonemap(float3(0.5))", "float3" },
                          Call{ "InverseTonemapSrgb", "inverseTonemapSRGB(float3(0.5))", "float3" },
                          Call{ "Luminance", "luminance(float3(0.5))", "float" },
                          Call{ "YcbcrToRgb", "ycbcrToRgb(0.5, float2(0.5))", "float3" }),
        nameOf);

std::string withParameters(std::string const& head, std::string const& entries) {
    return "material { " + head + ", parameters : [ " + entries +
           " ] }\nfragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }";
}

std::string samplers(size_t count) {
    std::string entries;
    for (size_t i = 0; i < count; ++i) entries += "{ name : s" + std::to_string(i) + ", type : sampler2d },";
    return entries;
}

std::string messageOf(std::string const& text) {
    const Result<MaterialPackage> package = compileMaterial(text, "a.mat");
    return package ? "compiles" : package.error().message;
}

// Table 14 of the guide.
TEST(GuideSamplers, CountAnExternalTextureTwice) {
    const std::string external = "{ name : camera, type : samplerExternal }";
    const uint32_t others = samplersOfMaterial(PassKind::Lit) - 2;
    EXPECT_EQ(messageOf(withParameters("shadingModel : lit", samplers(others) + external)), "compiles");
    EXPECT_NE(messageOf(withParameters("shadingModel : lit", samplers(others + 1) + external)).find("one too many"),
              std::string::npos);
    const Result<MaterialPackage> package = compileMaterial(withParameters("shadingModel : unlit", external), "a.mat");
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->findParameter("camera")->type, ParameterType::Sampler2D);
}

// Chapter 7 of the guide; SamplerBudget.h has its numbers.
TEST(GuideSamplers, AreOneMoreForUnlitMaterialsWithoutFog) {
    const uint32_t most = samplersOfMaterial(PassKind::Unlit, false);
    const std::string noFog = "shadingModel : unlit, variantFilter : [ fog ]";
    EXPECT_EQ(messageOf(withParameters(noFog, samplers(most))), "compiles");
    EXPECT_NE(messageOf(withParameters(noFog, samplers(most + 1))), "compiles");
    EXPECT_NE(messageOf(withParameters("shadingModel : unlit", samplers(most))), "compiles");
}

TEST(GuideParameters, MayBeMoreThan256) {
    std::string entries;
    for (int i = 0; i < 1000; ++i) entries += "{ name : p" + std::to_string(i) + ", type : float },";
    const Result<MaterialPackage> package = compileMaterial(withParameters("shadingModel : unlit", entries), "a.mat");
    ASSERT_TRUE(package) << package.error().message;
    const Result<MaterialPackage> again = readPackage(writePackage(*package));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->parameters, package->parameters);
}

TEST(GuideCustoms, ReachTheFragmentStageBesideVariables) {
    const auto text = [](const char* variables, int customs) {
        std::string required, sum = "float4(0.0)";
        for (int i = 0; i < customs; ++i) {
            required += "custom" + std::to_string(i) + ",";
            sum += " + getCustom" + std::to_string(i) + "()";
        }
        return std::string("material { shadingModel : lit, variantFilter : [ skinning ], variables : [ ") + variables +
               " ], requires : [ " + required +
               " ] }\nfragment { void material(inout MaterialInputs material) { prepareMaterial(material); "
               "material.baseColor = " +
               sum + "; } }";
    };
    EXPECT_EQ(messageOf(text("", 8)), "compiles");
    EXPECT_EQ(messageOf(text("a, b, c", 7)), "compiles");
    EXPECT_EQ(messageOf(text("a, b, c, d", 7)), "a.mat:2: this block reads 7 custom attributes, and beside 4 variables "
                                                "there is place for 6; pack them into "
                                                "variables in a vertex block");
    EXPECT_NE(messageOf("material {}\nfragment { void material(inout MaterialInputs m) { prepareMaterial(m); "
                        "m.baseColor = getCustom0(); } }")
                      .find("add requires : [ custom0 ]"),
              std::string::npos);
}

TEST(GuideSpellings, CompileAsTheyAreWritten) {
    const std::string code = " }\nfragment { void material(inout MaterialInputs material) { prepareMaterial(material); "
                             "material.baseColor.r = materialParams.x[1]; } }";
    const std::string array = "material { parameters : [ { name : x, type : \"float [2]\" } ]" + code;
    const Result<MaterialPackage> spaced = compileMaterial(array, "a.mat");
    ASSERT_TRUE(spaced) << spaced.error().message;
    EXPECT_EQ(spaced->findParameter("x")->arraySize, 2u);
    EXPECT_EQ(spaced->findParameter("x")->type, ParameterType::Float);
    const Result<MaterialPackage> marked = compileMaterial("\xEF\xBB\xBF" + array, "a.mat");
    EXPECT_TRUE(marked) << "a byte-order mark: " << marked.error().message;
    const Result<MaterialPackage> lowest =
            compileMaterial("material { featureLevel : 0, parameters : [ { name : x, type : float[2] } ]" + code, "a");
    ASSERT_TRUE(lowest) << lowest.error().message;
    EXPECT_EQ(lowest->featureLevel, 1u) << "every device has level 1";
}

} // namespace
} // namespace filament_core::shader
