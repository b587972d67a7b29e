// SPDX-License-Identifier: Apache-2.0
// The functions of the materials guide, 4.5.3 to 4.5.5, by value: matrices, frame constants and material globals, in
// both stages and on both APIs. A material compares what a function returns with a parameter, and draws the difference.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <functional>

namespace filament_core {
namespace {

using test::centerPixel;
using test::MaterialStage;
using test::onBothApis;
using test::Square;

enum class Stage { Vertex, Fragment };

/// Code that sets `same`: |call - expected| <= tolerance in all components.
std::string comparison(std::string_view type, std::string_view call, double tolerance) {
    const std::string found = fmt::format("{0} found = {1}; {0} wanted = materialParams.expected;\n", type, call);
    const std::string same = fmt::format("bool same = all(lessThanEqual(off, vec4({:.9f})));", tolerance);
    if (type == "float4x4") {
        return found +
               "vec4 off = vec4(0.0); for (int i = 0; i < 4; ++i) off = max(off, abs(found[i] - wanted[i]));\n" + same;
    }
    const std::string_view members = type == "float" ? "x" : type == "float3" ? "xyz" : "xyzw";
    return found + fmt::format("vec4 off = vec4(0.0); off.{} = abs(found - wanted);\n", members) + same;
}

/// Green where the function returns what is expected, else red.
std::string comparing(Stage stage, std::string_view type, std::string_view call, double tolerance) {
    constexpr std::string_view kDefinition =
            "material {{ shadingModel : unlit, {} parameters : [ {{ type : {}, name : expected }} ] }}\n";
    constexpr std::string_view kColor = "same ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(1.0, 0.0, 0.0, 1.0)";
    const std::string code = comparison(type, call, tolerance);
    if (stage == Stage::Fragment) {
        return fmt::format(kDefinition, "", type) +
               fmt::format(
                       "fragment {{ void material(inout MaterialInputs material) {{\nprepareMaterial(material);\n{}\n"
                       "material.baseColor = {};\n}} }}",
                       code, kColor);
    }
    return fmt::format(kDefinition, "variables : [ result ],", type) +
           fmt::format("vertex {{ void materialVertex(inout MaterialVertexInputs material) {{\n{}\n"
                       "material.result = {};\n}} }}\n",
                       code, kColor) +
           "fragment { void material(inout MaterialInputs material) {\nprepareMaterial(material);\n"
           "material.baseColor = variable_result;\n} }";
}

constexpr float4 kSame{ 0, 1, 0, 1 }, kOther{ 1, 0, 0, 1 };

void arrange(View& view) {
    view.size = { 16, 8 };
    view.camera = Camera::lookAt({ 3, 2, 5 }, { 0.25, 0, 0 }, { .verticalFovDegrees = 40, .nearMeters = 0.05f },
                                 { .aperture = 4, .shutterSeconds = 1.0f / 60, .iso = 200 });
    view.timeSeconds = 86'400.25; // a float has steps of 1/128 s there
    view.materialGlobals[1] = { 1, 2, 3, 4 };
    view.materialGlobals[2] = { -1, 0.5f, 1e6f, -1e-6f };
}

using Expected = std::function<ParameterValue(View const&)>;

struct Function {
    const char* name;
    const char* type;
    const char* call;
    Expected expected;
    double tolerance = 0;
};

float4x4 viewFromWorld(View const& view) {
    return float4x4(double4x4(glm::transpose(double3x3(view.camera.worldFromView))));
}
float4x4 clipFromView(View const& view) {
    return view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y));
}
float4x4 clipFromWorld(View const& view) { return clipFromView(view) * viewFromWorld(view); }
float4x4 inverseOf(float4x4 const& matrix) { return float4x4(glm::inverse(double4x4(matrix))); }
float4x4 translation(float3 by) {
    float4x4 matrix(1);
    matrix[3] = float4(by, 1);
    return matrix;
}
float3 cameraOf(View const& view) { return float3(view.camera.position()); }

// "World" is relative to the camera, as the guide allows.
const Function kFunctions[] = {
    { "ViewFromWorld", "float4x4", "getViewFromWorldMatrix()", viewFromWorld },
    { "WorldFromView", "float4x4", "getWorldFromViewMatrix()",
      [](View const& view) { return glm::transpose(viewFromWorld(view)); } },
    { "ClipFromView", "float4x4", "getClipFromViewMatrix()", clipFromView },
    { "ViewFromClip", "float4x4", "getViewFromClipMatrix()",
      [](View const& view) { return inverseOf(clipFromView(view)); }, 1e-5 },
    { "ClipFromWorld", "float4x4", "getClipFromWorldMatrix()", clipFromWorld },
    { "WorldFromClip", "float4x4", "getWorldFromClipMatrix()",
      [](View const& view) { return inverseOf(clipFromWorld(view)); }, 1e-5 },
    { "UserWorldFromWorld", "float4x4", "getUserWorldFromWorldMatrix()",
      [](View const& view) { return translation(cameraOf(view)); } },
    { "Resolution", "float4", "getResolution()",
      [](View const& view) { return float4(float2(view.size), 1.0f / float2(view.size)); } },
    { "WorldCameraPosition", "float3", "getWorldCameraPosition()", [](View const&) { return float3(0); } },
    { "WorldOffset", "float3", "getWorldOffset()", cameraOf },
    { "Time", "float", "getTime()",
      [](View const& view) { return static_cast<float>(view.timeSeconds - std::floor(view.timeSeconds)); } },
    { "UserTime", "float4", "getUserTime()",
      [](View const& view) {
          const auto rounded = static_cast<float>(view.timeSeconds);
          return float4(rounded, static_cast<float>(view.timeSeconds - rounded), 0, 0);
      } },
    { "UserTimeMod", "float", "getUserTimeMod(7.0)",
      [](View const& view) { return static_cast<float>(std::fmod(view.timeSeconds, 7.0)); }, 1e-6 },
    { "Exposure", "float", "getExposure()", [](View const& view) { return view.camera.exposure.factor(); } },
    { "Ev100", "float", "getEV100()", [](View const& view) { return view.camera.exposure.ev100(); } },
    { "MaterialGlobal0", "float4", "getMaterialGlobal0()", [](View const& view) { return view.materialGlobals[0]; } },
    { "MaterialGlobal1", "float4", "getMaterialGlobal1()", [](View const& view) { return view.materialGlobals[1]; } },
    { "MaterialGlobal2", "float4", "getMaterialGlobal2()", [](View const& view) { return view.materialGlobals[2]; } },
    { "MaterialGlobal3", "float4", "getMaterialGlobal3()", [](View const& view) { return view.materialGlobals[3]; } },
};

class FrameConstants : public testing::TestWithParam<std::tuple<Function, Stage>> {};

/// What a surface shows that compares a function's value in the view of arrange() with that in `other`.
template <class Change>
float4 compared(Function const& function, Stage stage, Change&& change) {
    return centerPixel(onBothApis([&](MaterialStage& rig) {
        arrange(rig.view);
        View other = rig.view;
        change(other);
        const MaterialInstance instance =
                rig.material(comparing(stage, function.type, function.call, function.tolerance));
        const Result<void> done = rig.engine.set(instance, "expected", function.expected(other));
        EXPECT_TRUE(done) << (done ? "" : done.error().message);
        rig.add(instance, std::vector<Square>{ {} });
    }));
}

TEST_P(FrameConstants, HaveTheValuesOfTheView) {
    auto const& [function, stage] = GetParam();
    EXPECT_EQ(compared(function, stage, [](View&) {}), kSame);
}

TEST_P(FrameConstants, DoNotHaveThoseOfAnotherView) {
    auto const& [function, stage] = GetParam();
    if (std::string_view(function.name) == "WorldCameraPosition") return; // the origin of every view
    EXPECT_EQ(compared(function, stage,
                       [](View& other) {
                           other.size = { 8, 8 };
                           other.camera = Camera::lookAt({ 2, -1, 4 }, { 0.25, 0, 0 }, { .nearMeters = 0.1f });
                           other.timeSeconds += 1.5;
                           for (float4& global : other.materialGlobals) global += 1.0f;
                       }),
              kOther);
}

INSTANTIATE_TEST_SUITE_P(All, FrameConstants,
                         testing::Combine(testing::ValuesIn(kFunctions),
                                          testing::Values(Stage::Vertex, Stage::Fragment)),
                         [](auto const& each) {
                             return std::string(std::get<0>(each.param).name) +
                                    (std::get<1>(each.param) == Stage::Vertex ? "InVertexStage" : "InFragmentStage");
                         });

TEST(MaterialGlobals, AreOpaqueBlackByDefault) {
    for (const float4 global : View{}.materialGlobals) EXPECT_EQ(global, float4(0, 0, 0, 1));
}

} // namespace
} // namespace filament_core
