// SPDX-License-Identifier: Apache-2.0
// Blending, its functions, depth and post-lighting colours, compared with the arithmetic of the materials guide, 4.2.15
// to 4.2.25; the same bits on both APIs. All colours and their products are exact in half floats.
#include "tests/filament_core/engine/materials/MaterialStage.h"

namespace filament_core {
namespace {

using test::centerPixel;
using test::MaterialStage;
using test::onBothApis;
using test::Square;

constexpr float4 kSource{ 0.5f, 0.25f, 0.125f, 0.5f }, kTarget{ 0.25f, 0.5f, 0.75f, 1 };

std::string inVertexColor(std::string_view properties) {
    return fmt::format(R"(material {{ name : stage, shadingModel : unlit, requires : [ color ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = getColor();
}} }})",
                       properties);
}

float4 blended(std::string_view properties) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        stage.view.clearColor = kTarget;
        stage.add(stage.material(inVertexColor(properties)), { { .color = kSource } });
    }));
}

TEST(Blending, EveryModeIsItsFormula) {
    const float4 s = kSource, t = kTarget;
    EXPECT_EQ(blended("blending : opaque"), float4(s.x, s.y, s.z, 1));
    EXPECT_EQ(blended("blending : transparent"), s + t * (1 - s.w));
    EXPECT_EQ(blended("blending : fade"), s + t * (1 - s.w));
    EXPECT_EQ(blended("blending : add"), s + t);
    EXPECT_EQ(blended("blending : multiply"), s * t);
    EXPECT_EQ(blended("blending : screen"), s + t * (1.0f - s));
    EXPECT_EQ(blended("blending : masked, maskThreshold : 0.5"), float4(s.x, s.y, s.z, 1)) << "equal is not below";
    EXPECT_EQ(blended("blending : masked, maskThreshold : 0.75"), t);
}

TEST(Blending, CustomTakesAnyFactorForColorAndAlpha) {
    struct Factor {
        const char* name;
        float4 value;
    };
    const float4 s = kSource, t = kTarget, one(1);
    const Factor factors[] = { { "zero", float4(0) },
                               { "one", one },
                               { "srcColor", s },
                               { "oneMinusSrcColor", one - s },
                               { "dstColor", t },
                               { "oneMinusDstColor", one - t },
                               { "srcAlpha", float4(s.w) },
                               { "oneMinusSrcAlpha", float4(1 - s.w) },
                               { "dstAlpha", float4(t.w) },
                               { "oneMinusDstAlpha", float4(1 - t.w) },
                               { "srcAlphaSaturate", float4(float3(std::min(s.w, 1 - t.w)), 1) } };
    const size_t count = std::size(factors);
    for (size_t i = 0; i < count; ++i) { // every factor in every place, without trying all combinations
        Factor const &srcRgb = factors[i], &srcA = factors[(i + 3) % count];
        Factor const &dstRgb = factors[(i + 5) % count], &dstA = factors[(i + 8) % count];
        const float4 source(float3(srcRgb.value), srcA.value.w), target(float3(dstRgb.value), dstA.value.w);
        const std::string properties =
                fmt::format("blending : custom, blendFunction : {{ srcRGB : {}, srcA : {}, dstRGB : {}, dstA : {} }}",
                            srcRgb.name, srcA.name, dstRgb.name, dstA.name);
        EXPECT_EQ(blended(properties), s * source + t * target) << properties;
    }
}

// ------------------------------------------------------------------------------------------ depth

/// A square at z = 1, and one behind it; properties are given for each.
float4 frontThenBack(std::string_view front, std::string_view back) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        stage.view.clearColor = kTarget;
        double4x4 nearer(1.0);
        nearer[3].z = 1;
        // Blended materials are drawn after opaque ones, and the farther one of two blended ones first.
        stage.add(stage.material(inVertexColor(front)), { { .color = float4(1, 0, 0, 1) } }, nearer);
        stage.add(stage.material(inVertexColor(back)), { { .color = float4(0, 1, 0, 1) } });
    }));
}

TEST(Depth, WritingAndTestingAreWhatTheMaterialSays) {
    const float4 red(1, 0, 0, 1), green(0, 1, 0, 1);
    EXPECT_EQ(frontThenBack("", ""), red);
    EXPECT_EQ(frontThenBack("depthWrite : false", "blending : transparent"), green) << "nothing hides what comes later";
    EXPECT_EQ(frontThenBack("", "blending : transparent"), red);
    EXPECT_EQ(frontThenBack("", "blending : transparent, depthCulling : false"), green) << "always on top";
    EXPECT_EQ(frontThenBack("colorWrite : false", "blending : transparent"), kTarget) << "depth without a colour";
    EXPECT_EQ(frontThenBack("culling : frontAndBack", "blending : transparent"), green) << "neither colour nor depth";
    EXPECT_EQ(frontThenBack("culling : front", "blending : transparent"), green);
}

TEST(Depth, BlendedMaterialsWriteNoneUnlessTheySaySo) {
    const auto nearBeforeFar = [](std::string_view properties) {
        return centerPixel(onBothApis([&](MaterialStage& stage) {
            stage.add(stage.material(inVertexColor(properties)),
                      { { 1, float4(0.5f, 0, 0, 0.5f) }, { 0, float4(0, 0.5f, 0, 0.5f) } });
        }));
    };
    EXPECT_EQ(nearBeforeFar("blending : transparent"), float4(0.25f, 0.5f, 0, 1));
    EXPECT_EQ(nearBeforeFar("blending : transparent, depthWrite : true"), float4(0.5f, 0, 0, 1));
}

// ------------------------------------------------------------------------------------------ post-lighting colour

float4 postLit(std::string_view properties, std::string_view shading) {
    const std::string text =
            fmt::format(R"(material {{ shadingModel : {}, requires : [ color ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = {};
    material.emissive = vec4(0.25, 0.5, 0.75, 0.0);
    material.postLightingColor = getColor();
}} }})",
                        shading, properties, shading == "unlit" ? "vec4(0.0, 0.0, 0.0, 1.0)" : "vec4(1.0)");
    return centerPixel(onBothApis([&](MaterialStage& stage) { // lit, but there is no light
        stage.add(stage.material(text), { { .color = kSource } });
    }));
}

TEST(PostLighting, EveryModeIsItsFormulaForLitAndUnlitMaterials) {
    const float4 s = kSource, t(0.25f, 0.5f, 0.75f, 1); // what lighting left: the emission
    for (const std::string_view shading : { "unlit", "lit" }) {
        const auto opaque = [](float4 color) { return float4(float3(color), 1); }; // the surface stays opaque
        EXPECT_EQ(postLit("", shading), opaque(s + t * (1 - s.w))) << "the default: transparent";
        EXPECT_EQ(postLit("postLightingBlending : transparent", shading), opaque(s + t * (1 - s.w)));
        EXPECT_EQ(postLit("postLightingBlending : opaque", shading), opaque(s));
        EXPECT_EQ(postLit("postLightingBlending : add", shading), opaque(s + t));
        EXPECT_EQ(postLit("postLightingBlending : multiply", shading), opaque(s * t));
        EXPECT_EQ(postLit("postLightingBlending : screen", shading), opaque(s + t * (1.0f - s))) << shading;
    }
}

} // namespace
} // namespace filament_core
