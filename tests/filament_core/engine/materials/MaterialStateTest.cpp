// SPDX-License-Identifier: Apache-2.0
// A material's blending, passes, faces, interpolation and functions as images whose colours follow from simple
// arithmetic; the same bits on both APIs.
#include "base/Log.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <cmath>

namespace filament_core {
namespace {

using test::centerPixel;
using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;
using test::Square;

/// Unlit, in the colour of the vertices.
std::string vertexColored(std::string_view properties, std::string_view code = "") {
    return fmt::format(R"(material {{ name : stage, shadingModel : unlit, requires : [ color, uv0 ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = getColor();
    {}
}} }})",
                       properties, code);
}

float4 over(float4 above, float4 below) { return above + below * (1 - above.w); }

// All of them, and their products, are exact in half floats.
constexpr float4 kHalfRed{ 0.5f, 0, 0, 0.5f }, kQuarterGreen{ 0, 0.25f, 0, 0.25f }, kHalfBlue{ 0, 0, 0.5f, 0.5f };
constexpr float4 kOpaqueBlack{ 0, 0, 0, 1 };

float4 drawn(std::string_view properties, std::vector<Square> const& squares, float4 background = kOpaqueBlack) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        stage.view.clearColor = background;
        stage.add(stage.material(vertexColored(properties)), squares);
    }));
}

// ------------------------------------------------------------------------------------------ two passes

const std::vector<Square> kNearBeforeFar{ { 1, kHalfRed }, { 0, kQuarterGreen } };

TEST(TwoPasses, OneSideShowsWhatIsNearestAlone) {
    EXPECT_EQ(drawn("blending : transparent, culling : none", kNearBeforeFar),
              over(kQuarterGreen, over(kHalfRed, kOpaqueBlack)));
    EXPECT_EQ(drawn("blending : transparent, culling : none, transparency : twoPassesOneSide", kNearBeforeFar),
              over(kHalfRed, kOpaqueBlack));
}

TEST(TwoPasses, OneSideWorksWithFourSamples) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        stage.view.samples = 4;
        stage.add(stage.material(vertexColored("blending : transparent, transparency : twoPassesOneSide")),
                  kNearBeforeFar);
    });
    EXPECT_EQ(centerPixel(picture), over(kHalfRed, kOpaqueBlack));
}

TEST(TwoPasses, TwoSidesShowBackFacesBehindFrontFacesWhateverTheOrderOfTheTriangles) {
    const std::vector<Square> frontBeforeBack{ { 1, kHalfRed, true }, { 0, kQuarterGreen, false } };
    EXPECT_EQ(drawn("blending : transparent, culling : none", frontBeforeBack),
              over(kQuarterGreen, over(kHalfRed, kOpaqueBlack)));
    EXPECT_EQ(drawn("blending : transparent, transparency : twoPassesTwoSides", frontBeforeBack),
              over(kHalfRed, over(kQuarterGreen, kOpaqueBlack)));
}

TEST(TwoPasses, EachObjectIsFinishedBeforeTheNextOneInFrontOfIt) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        const MaterialInstance glass =
                stage.material(vertexColored("blending : transparent, transparency : twoPassesTwoSides"));
        double4x4 nearer(1.0);
        nearer[3].z = 2;
        stage.add(glass, { { 0.5f, kHalfRed, true }, { 0, kQuarterGreen, false } }, nearer);
        stage.add(glass, { { 0.5f, kHalfBlue, true }, { 0, kQuarterGreen, false } });
    });
    const float4 farther = over(kHalfBlue, over(kQuarterGreen, kOpaqueBlack));
    EXPECT_EQ(centerPixel(picture), over(kHalfRed, over(kQuarterGreen, farther)));
}

TEST(TwoPasses, AMirroredObjectShowsTheSame) {
    double4x4 mirrored(1.0);
    mirrored[0][0] = -1;
    const Image picture = onBothApis([&](MaterialStage& stage) {
        const MaterialInstance glass =
                stage.material(vertexColored("blending : transparent, transparency : twoPassesTwoSides"));
        stage.add(glass, { { 1, kHalfRed, true }, { 0, kQuarterGreen, false } }, mirrored);
    });
    EXPECT_EQ(centerPixel(picture), over(kHalfRed, over(kQuarterGreen, kOpaqueBlack)));
}

// ------------------------------------------------------------------------------------------ double-sided

/// Only emissive: shows the normal as a colour.
constexpr std::string_view kShowsNormal = R"(
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(getWorldNormalVector() * 0.5 + 0.5, 1.0);
} })";

float4 normalSeen(std::string_view properties, bool facesCamera, std::optional<bool> doubleSided = {}) {
    const std::string text = fmt::format("material {{ shadingModel : unlit, requires : [ tangents ], {} }} {}",
                                         properties, kShowsNormal);
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(text);
        if (doubleSided) {
            const Result<void> done = stage.engine.setDoubleSided(instance, *doubleSided);
            EXPECT_TRUE(done) << (done ? "" : done.error().message);
        }
        stage.add(instance, { { 0, float4(1), facesCamera } });
    }));
}

constexpr float4 kTowardsCamera{ 0.5f, 0.5f, 1, 1 }, kAwayFromCamera{ 0.5f, 0.5f, 0, 1 };

TEST(DoubleSided, TurnsTheNormalsOfBackFacesAroundAndCanBeSwitchedAtRunTime) {
    EXPECT_EQ(normalSeen("doubleSided : true", false), kAwayFromCamera)
            << "the normal of +z, seen from behind, turned around";
    EXPECT_EQ(normalSeen("doubleSided : true", true), kTowardsCamera);
    EXPECT_EQ(normalSeen("doubleSided : true", false, false), kOpaqueBlack) << "back faces are culled";
    EXPECT_EQ(normalSeen("doubleSided : false", false), kOpaqueBlack);
    EXPECT_EQ(normalSeen("doubleSided : false", false, true), kAwayFromCamera);
    EXPECT_EQ(normalSeen("doubleSided : false, culling : none", false), kTowardsCamera)
            << "drawn, but not turned around";
    EXPECT_EQ(normalSeen("doubleSided : true, culling : none", false, false), kTowardsCamera);
    EXPECT_EQ(normalSeen("doubleSided : true, culling : none", false), kAwayFromCamera);
}

TEST(DoubleSided, AMaterialThatDoesNotMentionItSaysHowToAllowIt) {
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    MaterialStage stage(*engine);
    const Result<void> done = engine->setDoubleSided(stage.material(vertexColored("")), true);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, testing::HasSubstr("set doubleSided : true or doubleSided : false"));
}

// ------------------------------------------------------------------------------------------ destroyed materials

TEST(DestroyedMaterial, LeavesItsPlaceToOneThatDrawsItself) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    for (const float4 color : { kHalfRed, kQuarterGreen, kHalfBlue }) {
        MaterialStage stage(*engine); // takes its material along
        stage.add(
                stage.material(vertexColored("", fmt::format("material.baseColor = vec4({:.2f}, {:.2f}, {:.2f}, 1.0);",
                                                             color.x, color.y, color.z))),
                { { 0, float4(1) } });
        EXPECT_EQ(centerPixel(test::renderLinear(*engine, stage.scene, stage.view)), float4(float3(color), 1));
    }
    test::expectNoErrors(*engine);
}

// ------------------------------------------------------------------------------------------ flat

TEST(FlatInterpolation, ATriangleHasTheAttributesAndTheVariablesOfItsLastVertex) {
    const std::string text = R"(material { shadingModel : unlit, requires : [ color, uv0 ], interpolation : flat,
    variables : [ position ], flipUV : false }
vertex { void materialVertex(inout MaterialVertexInputs material) { material.position = getPosition(); } }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(getColor().r, getColor().g + getUV0().y, variable_position.x + getUV0().x, 1.0);
} })";
    const Image picture = onBothApis([&](MaterialStage& stage) {
        // Each triangle ends at its own vertex; the far ends are out of view, so clipping cuts there.
        const std::vector<test::StageVertex> vertices{
            { .position = { -64, -64, 0 }, .color = { 1, 0, 0, 1 } },
            { .position = { 64, -64, 0 }, .color = { 0, 1, 0, 1 } },
            { .position = { 64, 64, 0 }, .color = { 0.25f, 0.5f, 0, 1 }, .uv = { 1, 0.25f } },
            { .position = { -64, 64, 0 }, .color = { 0.75f, 0.125f, 0, 1 }, .uv = { 2, 0.5f } },
        };
        stage.add(stage.material(text), vertices, { 0, 1, 2, 0, 2, 3 }, double4x4(1.0));
    });
    EXPECT_EQ(halfPixel(picture, 6, 5), float4(0.25f, 0.75f, 65, 1)) << "below the diagonal";
    EXPECT_EQ(halfPixel(picture, 1, 2), float4(0.75f, 0.625f, -62, 1)) << "above it";
}

TEST(FlatInterpolation, LitTrianglesHaveOneNormalEach) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(R"(material { interpolation : flat }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } })");
        std::vector<test::StageVertex> vertices;
        for (const float2 at : { float2(-8, -8), float2(8, -8), float2(8, 8), float2(-8, 8) }) {
            const float half = 0.3f * at.x / 8;
            vertices.push_back({ .position = { at, 0 }, .tangents = { 0, std::sin(half), 0, std::cos(half) } });
        }
        stage.add(instance, vertices, { 0, 1, 2, 0, 2, 3 }, double4x4(1.0));
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 100'000 } });
        // Nearly parallel rays: the view does not change either.
        stage.view.camera = Camera::lookAt({ 0, 0, 400 }, { 0, 0, 0 }, { .verticalFovDegrees = 1 });
    });
    const float4 below = halfPixel(picture, 6, 6), above = halfPixel(picture, 1, 1);
    EXPECT_NEAR(halfPixel(picture, 4, 6).x, below.x, 1e-3f);
    EXPECT_NEAR(halfPixel(picture, 1, 4).x, above.x, 1e-3f);
    EXPECT_GT(below.x, 0.01f);
}

// ------------------------------------------------------------------------------------------ what code can set and call

std::string unlitText(std::string_view properties, std::string_view code, std::string_view vertex = "") {
    const std::string block =
            vertex.empty()
                    ? ""
                    : fmt::format("vertex {{ void materialVertex(inout MaterialVertexInputs material) {{ {} }} }}\n",
                                  vertex);
    return fmt::format("material {{ shadingModel : unlit, culling : none{} }}\n{}fragment {{ void material(inout "
                       "MaterialInputs material) {{ prepareMaterial(material);\n{}\n}} }}",
                       properties, block, code);
}

Image drawnText(std::string const& text) {
    return onBothApis([&](MaterialStage& stage) { stage.add(stage.material(text), { {} }); });
}

void expectNearly(float4 found, float4 wanted, float tolerance, char const* what) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(found[i], wanted[i], tolerance) << what << ": component " << i;
}

TEST(AuthorFunctions, PlaceVerticesInClipSpace) {
    const char* const place = "vec4 p = getPosition(); material.clipSpacePosition = vec4(p.x / 16.0 - 0.5, p.y / 8.0, "
                              "0.5, 1.0);"; // the left half of the picture
    for (const char* domain : { "", ", vertexDomain : world", ", vertexDomain : device" }) {
        const Image picture = drawnText(unlitText(domain, "material.baseColor = vec4(0.25, 0.5, 1.0, 1.0);", place));
        for (uint32_t x = 0; x < 8; ++x)
            EXPECT_EQ(halfPixel(picture, x, 3), x < 4 ? float4(0.25f, 0.5f, 1, 1) : float4(0, 0, 0, 1)) << domain << x;
    }
}

TEST(AuthorFunctions, PlaceInClipSpaceBeginsAsThatOfTheMesh) {
    const std::string color = "material.baseColor = vec4(gl_FragCoord.z, 0.5, 1.0, 1.0);";
    const Image plain = drawnText(unlitText("", color));
    EXPECT_EQ(drawnText(unlitText("", color, "material.clipSpacePosition *= 1.0;")).pixels, plain.pixels);
}

TEST(AuthorFunctions, MixWhatPostLightingMakesOfTheColor) {
    const auto mixed = [](float4 above, std::string_view blending, float factor) {
        return centerPixel(drawnText(unlitText(fmt::format(", postLightingBlending : {}", blending),
                                               fmt::format("material.baseColor = vec4(0.25, 0.5, 0.75, 1.0);\n"
                                                           "material.postLightingColor = vec4({}, {}, {}, {});\n"
                                                           "material.postLightingMixFactor = {};",
                                                           above.x, above.y, above.z, above.w, factor))));
    };
    EXPECT_EQ(mixed({ 1, 0, 0, 1 }, "opaque", 0.25f), float4(0.4375f, 0.375f, 0.5625f, 1));
    EXPECT_EQ(mixed({ 1, 0, 0, 1 }, "opaque", 0), float4(0.25f, 0.5f, 0.75f, 1));
    EXPECT_EQ(mixed({ 1, 0, 0, 1 }, "opaque", 1), float4(1, 0, 0, 1));
    EXPECT_EQ(mixed({ 0.5f, 0, 0.25f, 0.5f }, "transparent", 0.5f), float4(0.4375f, 0.375f, 0.6875f, 1));
    EXPECT_EQ(mixed({ 0.5f, 0.5f, 0, 1 }, "multiply", 0.5f), float4(0.1875f, 0.375f, 0.375f, 1));
}

TEST(AuthorFunctions, CarryFiveVariablesBesideEverythingElse) {
    const Image picture = drawnText(
            unlitText(", instanced : true, requires : [ color, uv0, custom0, custom5 ], variables : [ a, b, c, d, e ]",
                      "material.baseColor = vec4(variable_a.x + variable_b.y, variable_c.z + variable_d.w,\n"
                      "variable_e.x * getColor().x + float(getInstanceIndex()), getCustom0().w);",
                      "material.a = vec4(0.25); material.b = vec4(0.5); material.c = vec4(0.0625);\n"
                      "material.d = vec4(0.125); material.e = vec4(0.375);"));
    EXPECT_EQ(centerPixel(picture), float4(0.75f, 0.1875f, 0.375f, 1));
}

TEST(AuthorFunctions, ShowHeatInFalseColors) {
    for (const float value : { 0.0f, 1.0f / 7, 0.25f, 0.5f, 6.0f / 7, 1.0f }) {
        const Image picture = drawnText(
                unlitText("", fmt::format("material.baseColor = vec4(heatmap({:.9f}) * 0.125 + 0.5, 1.0);", value)));
        const float3 off = (float3(value) - float3(6, 3.8f, 1) / 7.0f) * 2.1f;
        expectNearly(centerPixel(picture), float4((1.0f - off * off) * 0.125f + 0.5f, 1), 1e-3f, "heat");
    }
}

TEST(AuthorFunctions, DecodeTangentFrames) {
    const std::string decode = "vec3 n, t; toTangentFrame(vec4(0.0, 0.29552021, 0.0, 0.95533649), n, t); ";
    const float sine = std::sin(0.6f), cosine = std::cos(0.6f);
    const Image fragment = drawnText(unlitText("", decode + "material.baseColor = vec4(n.xz, -t.z, 1.0);"));
    expectNearly(centerPixel(fragment), { sine, cosine, sine, 1 }, 1e-3f, "fragment");
    const Image vertex = drawnText(unlitText(", variables : [ frame ]", "material.baseColor = variable_frame;",
                                             decode + "material.frame = vec4(n.xz, t.x, 1.0);"));
    expectNearly(centerPixel(vertex), { sine, cosine, cosine, 1 }, 1e-3f, "vertex");
}

TEST(AuthorFunctions, KnowTheViewBesideItsGuardBand) {
    constexpr uint32_t kBandSide = 32;
    const auto picture = [](bool hasBand) {
        return onBothApis([&](MaterialStage& stage) {
            stage.view.size = { kBandSide, kBandSide };
            stage.view.effects.ambientOcclusion.enabled = true; // looks beside a pixel
            stage.view.effects.guardBand = { .enabled = hasBand, .width = 0.25f };
            stage.add(stage.material("material { }"), { { .z = -1 } });
            stage.add(stage.material(unlitText("", "material.baseColor = vec4(getNormalizedViewportCoord().xy, "
                                                   "getNormalizedPhysicalViewportCoord().x, 1.0);")),
                      { {} });
        });
    };
    const Image with = picture(true), without = picture(false);
    for (uint32_t at = 0; at < kBandSide; ++at) {
        const float place = (static_cast<float>(at) + 0.5f) / kBandSide;
        EXPECT_EQ(halfPixel(without, at, at), float4(place, place, place, 1));
        const float4 found = halfPixel(with, at, at);
        expectNearly(found, float4(place, place, (place * kBandSide + 8) / (kBandSide + 16), 1), 1e-3f, "in the band");
    }
}

/// A texture whose red channel grows by 32 / 255 a texel along u.
Texture heightRamp(MaterialStage& stage) {
    std::vector<std::byte> texels;
    for (int i = 0; i < 64; ++i) texels.insert(texels.end(), 4, static_cast<std::byte>(i % 8 * 32));
    return stage.own(stage.engine.create(
            TextureDesc{ .format = Format::RGBA8, .width = 8, .height = 8, .pixels = texels, .name = "heights" }));
}

/// Nothing shines on it: its light is its normal.
TEST(AuthorFunctions, TiltTheNormalByTheSlopeOfHeights) {
    const char* const text = R"(material { requires : [ uv0 ], culling : none,
    parameters : [ { type : sampler2d, name : heights }, { type : float, name : metres } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    applyBump(materialParams_heights, getUV0(), materialParams.metres);
    material.baseColor.rgb = vec3(0.0);
    material.emissive = vec4(getWorldNormalVector() * 0.5 + 0.5, 0.0);
} })";
    for (const float metres : { 0.0f, 16.0f, -8.0f }) {
        const Image picture = onBothApis([&](MaterialStage& stage) {
            const MaterialInstance instance = stage.material(text, test::kNoLights);
            const Sampler linear{ .magFilter = Filter::Linear, .minFilter = Filter::Linear };
            EXPECT_TRUE(stage.engine.set(instance, "heights", heightRamp(stage), linear));
            EXPECT_TRUE(stage.engine.set(instance, "metres", metres));
            stage.add(instance, { {} });
        });
        const float slope = metres * (32.0f * 8 / 255) / 16; // the square is 16 metres wide
        const float3 normal = glm::normalize(float3(-slope, 0, 1));
        expectNearly(centerPixel(picture), float4(normal * 0.5f + 0.5f, 1), 2e-3f, "normal");
    }
}

// ------------------------------------------------------------------------------------------ whole numbers

template <class T>
float4 numberSeen(std::string_view format, Format textureFormat, std::array<T, 4> const& texels) {
    const std::string text = fmt::format(R"(material {{ shadingModel : unlit, requires : [ uv0 ],
    parameters : [ {{ type : sampler2d, name : ids, format : {} }} ] }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = vec4(texture(materialParams_ids, getUV0())) / 8.0;
    material.baseColor.a = 1.0;
}} }})",
                                         format);
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(text);
        const Texture ids = stage.own(stage.engine.create(TextureDesc{
                .format = textureFormat, .width = 2, .height = 1, .pixels = std::as_bytes(std::span(texels)) }));
        const Sampler linear{ .magFilter = Filter::Linear,
                              .minFilter = Filter::Linear,
                              .mipFilter = MipFilter::Linear,
                              .wrapU = WrapMode::ClampToEdge,
                              .wrapV = WrapMode::ClampToEdge };
        const Result<void> done = stage.engine.set(instance, "ids", ids, linear);
        EXPECT_TRUE(done) << (done ? "" : done.error().message);
        stage.view.quality.textureFilter = TextureFilter::Anisotropic;
        stage.add(instance, { {} });
    }));
}

TEST(IntegerSamplers, GiveWholeNumbersWithoutFiltering) {
    EXPECT_EQ(numberSeen<int32_t>("int", Format::RG32I, { -8, 4, 16, -2 }), float4(2, -0.25f, 0, 1));
    EXPECT_EQ((numberSeen<uint32_t>("uint", Format::RG32UI, { 8, 4, 16, 2 })), float4(2, 0.25f, 0, 1));
}

TEST(IntegerSamplers, ShowOneWhereNothingIsSetAndRefuseTexturesOfAnotherKind) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(R"(material { shadingModel : unlit, parameters : [
    { type : sampler2d, name : a, format : int }, { type : sampler2dArray, name : b, format : uint },
    { type : samplerCubemap, name : c }, { type : sampler2dArray, name : d } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(float(texture(materialParams_a, vec2(0.5)).g),
        float(texture(materialParams_b, vec3(0.5, 0.5, 0.0)).g), texture(materialParams_c, vec3(1.0)).g,
        texture(materialParams_d, vec3(0.5, 0.5, 0.0)).g);
} })");
        const Texture white = stage.own(stage.engine.create(TextureDesc{ .name = "floats" }));
        const auto message = [&](std::string_view parameter) {
            const Result<void> done = stage.engine.set(instance, parameter, white);
            return done ? std::string() : done.error().message;
        };
        EXPECT_THAT(message("a"), testing::HasSubstr("is a sampler of format int, and texture 'floats' has the format "
                                                     "RGBA8, which is read with format : float"));
        EXPECT_THAT(message("c"), testing::HasSubstr("is samplerCubemap, but texture 'floats' is a 2D texture"));
        EXPECT_THAT(message("d"), testing::HasSubstr("is sampler2dArray, but texture"));
        stage.add(instance, { {} });
    });
    EXPECT_EQ(centerPixel(picture), float4(1));
}

// ------------------------------------------------------------------------------------------ instances

TEST(InstanceIndex, IsTheOneThatTheRenderableWasGivenInBothStagesAndSurvivesMoving) {
    const std::string text = R"(material { shadingModel : unlit, instanced : true, variables : [ index ] }
vertex { void materialVertex(inout MaterialVertexInputs material) {
    material.index = vec4(float(getInstanceIndex()));
} }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(float(getInstanceIndex()) / 4096.0, variable_index.x / 4096.0, 0.0, 1.0);
} })";
    const Image picture = onBothApis([&](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(text);
        const Square half{ .halfSide = 0.5f };
        double4x4 left(1.0), right(1.0);
        left[3].x = -1, right[3].x = 1;
        right[0][0] = -1; // mirrored
        Renderable moved = stage.add(instance, { half }, double4x4(1.0), 4096 * 3);
        stage.scene.setTransform(moved, left);
        stage.add(instance, { half }, right, 1024);
    });
    EXPECT_EQ(halfPixel(picture, 1, 4), float4(3, 3, 0, 1));
    EXPECT_EQ(halfPixel(picture, 6, 4), float4(0.25f, 0.25f, 0, 1));
}

/// Four squares in a row, each in the brightness of its number, which the vertex block moves if `moves`.
std::string rowOfInstances(bool moves) {
    return fmt::format(R"(material {{ shadingModel : unlit, instanced : true }}
vertex {{ void materialVertex(inout MaterialVertexInputs material) {{
    material.worldPosition.x += {} * float(getInstanceIndex() - 8);
}} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = vec4(vec3(float(getInstanceIndex()) / 16.0), 1.0);
}} }})",
                       moves ? "0.8284" : "0.0");
}

TEST(InstanceIndex, NumbersTheInstancesOfOneRenderable) {
    const double3 kFirst(-1.4497, 0, 0); // two pixels apart
    const auto row = [&](bool moves, auto const& addRow) {
        return onBothApis([&](MaterialStage& stage) {
            const MaterialInstance instance = stage.material(rowOfInstances(moves));
            addRow(stage, stage.describe(instance, { { .halfSide = 0.3f } }, glm::translate(double4x4(1), kFirst), 8));
        });
    };
    std::array<double4x4, 4> places{};
    for (size_t i = 0; i < places.size(); ++i) places[i] = glm::translate(double4x4(1), { 0.8284 * double(i), 0, 0 });
    const Image moved = row(true, [](MaterialStage& stage, RenderableDesc const& desc) {
        const Node node = stage.scene.addInstances(desc, 4);
        EXPECT_EQ(stage.scene.renderableCount(), 4);
        EXPECT_FALSE(stage.scene.firstChild(node));
    });
    const Image placed = row(false, [&](MaterialStage& stage, RenderableDesc const& desc) {
        const Node others = stage.scene.addInstances(desc, 4, places);
        stage.scene.addInstances(desc, 0);
        stage.scene.addInstances(desc, 4, places);
        stage.scene.remove(others);
        EXPECT_EQ(stage.scene.renderableCount(), 4);
    });
    const Image single = row(false, [&](MaterialStage& stage, RenderableDesc desc) {
        const double4x4 first = desc.worldFromObject;
        for (const double4x4& place : places) {
            desc.worldFromObject = first * place;
            stage.scene.add(desc);
            ++desc.instanceIndex;
        }
    });
    EXPECT_EQ(moved.pixels, single.pixels);
    EXPECT_EQ(placed.pixels, single.pixels);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(halfPixel(single, 2 * i, 4).x, (8.0f + float(i)) / 16) << i;
}

TEST(InstanceIndex, IsThereInEveryVertexDomain) {
    for (const std::string_view domain : { "world", "view", "device" }) {
        const std::string text = fmt::format(R"(material {{ shadingModel : unlit, instanced : true, vertexDomain : {},
    culling : none, depthCulling : false }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = vec4(float(getInstanceIndex()));
}} }})",
                                             domain);
        const Image picture = onBothApis([&](MaterialStage& stage) {
            stage.add(stage.material(text), { { .z = domain == "view" ? -1.0f : 0.5f } }, double4x4(1.0), 7);
        });
        EXPECT_EQ(centerPixel(picture).x, 7.0f) << domain;
    }
}

// ------------------------------------------------------------------------------------------ attributes and numbers

TEST(CustomAttributes, AreReadInBothStagesWithTheGuidesRequires) {
    const Image picture = onBothApis([](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(R"(material {
    shadingModel : unlit, requires : [ custom0, custom5 ], variables : [ twice ] }
vertex { void materialVertex(inout MaterialVertexInputs material) { material.twice = 2.0 * getCustom0(); } }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(getCustom0().r, variable_twice.g, getCustom5().x, 1.0);
} })");
        stage.add(instance, { { .color = { 0.25f, 0.5f, 0.75f, 1 } } });
    });
    EXPECT_EQ(float2(centerPixel(picture)), float2(0.25f, 1));
    const auto ramp = [&](uint32_t x) { return halfPixel(picture, x, 4).z; };
    EXPECT_GT(ramp(5), ramp(3));
    EXPECT_NEAR(ramp(3) + ramp(4), 1, 2e-3) << "around the middle of the square";
}

TEST(VertexNumbers, AreTheSameInGlslAndInTheEnginesFunction) {
    const Image picture = onBothApis([](MaterialStage& stage) {
        const MaterialInstance instance = stage.material(R"(material { shadingModel : unlit, variables : [ numbers ] }
vertex { void materialVertex(inout MaterialVertexInputs material) {
    material.numbers = vec4(float(gl_VertexID), float(getVertexIndex()), float(gl_InstanceID), 1.0);
} }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = variable_numbers;
} })");
        stage.add(instance, { { .z = -1 }, { .z = 0 } }); // the second square has the vertices 4 to 7
    });
    const float4 center = halfPixel(picture, 4, 4); // on the diagonal between vertices 4 and 6, except for half a pixel
    EXPECT_NEAR(center.x, 5, 0.1);
    EXPECT_EQ(center.x, center.y);
    EXPECT_EQ(float2(center.z, center.w), float2(0, 1));
}

// ------------------------------------------------------------------------------------------ shadows and the screen

TEST(ShadowMultiplier, WithoutAShadowThePlaneIsInvisible) {
    const float4 background{ 0.25f, 0.5f, 0.75f, 1 };
    EXPECT_EQ(drawn("blending : transparent, shadowMultiplier : true", { { 0, kHalfRed } }, background), background);
    EXPECT_NE(drawn("blending : transparent", { { 0, kHalfRed } }, background), background);
}

} // namespace
} // namespace filament_core
