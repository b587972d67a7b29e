// SPDX-License-Identifier: Apache-2.0
// Parameters and constants of every type arrive in the shaders of both APIs, and mismatches are refused with a message.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace filament_core {
namespace {

using testing::HasSubstr;

/// Red is the number of the first wrong value; green is 1 if there is none.
constexpr const char* kEveryType = R"(material {
    name : everyType, shadingModel : unlit,
    parameters : [
        { type : bool, name : b1 }, { type : bool2, name : b2 }, { type : bool3, name : b3 }, { type : bool4, name : b4 },
        { type : float, name : f1 }, { type : float2, name : f2 }, { type : float3, name : f3 }, { type : float4, name : f4 },
        { type : int, name : i1 }, { type : int2, name : i2 }, { type : int3, name : i3 }, { type : int4, name : i4 },
        { type : uint, name : u1 }, { type : uint2, name : u2 }, { type : uint3, name : u3 }, { type : uint4, name : u4 },
        { type : float3x3, name : m3 }, { type : float4x4, name : m4 },
        { type : "float[5]", name : weights, precision : medium }, { type : "float3[3]", name : colors },
        { type : "bool2[2]", name : flags }, { type : "int4[2]", name : ints }, { type : "mat3[2]", name : frames },
        { type : sampler2dArray, name : layers }, { type : samplerCubemap, name : cube }, { type : sampler2d, name : flat_ }
    ]
}
fragment {
    int wrong = 0;
    void expect(int number, bool isRight) { if (!isRight && wrong == 0) wrong = number; }
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        expect(1, materialParams.b1);
        expect(2, all(equal(materialParams.b2, bvec2(false, true))));
        expect(3, all(equal(materialParams.b3, bvec3(true, false, true))));
        expect(4, all(equal(materialParams.b4, bvec4(false, true, false, true))));
        expect(5, materialParams.f1 == 1.5);
        expect(6, materialParams.f2 == vec2(2.0, 3.0));
        expect(7, materialParams.f3 == vec3(4.0, 5.0, 6.0));
        expect(8, materialParams.f4 == vec4(7.0, 8.0, 9.0, 10.0));
        expect(9, materialParams.i1 == -1);
        expect(10, materialParams.i2 == ivec2(-2, 3));
        expect(11, materialParams.i3 == ivec3(4, -5, 6));
        expect(12, materialParams.i4 == ivec4(-2147483647, 8, -9, 10));
        expect(13, materialParams.u1 == 4294967295u);
        expect(14, materialParams.u2 == uvec2(2u, 3u));
        expect(15, materialParams.u3 == uvec3(4u, 5u, 6u));
        expect(16, materialParams.u4 == uvec4(7u, 8u, 9u, 10u));
        expect(17, materialParams.m3[0] == vec3(1.0, 2.0, 3.0) && materialParams.m3[2] == vec3(7.0, 8.0, 9.0));
        expect(18, materialParams.m4[1] == vec4(5.0, 6.0, 7.0, 8.0) && materialParams.m4[3].w == 16.0);
        for (int i = 0; i < 5; ++i) expect(19, materialParams.weights[i] == float(i) * 0.5);
        expect(20, materialParams.colors[0] == vec3(0.0) && materialParams.colors[1] == vec3(1.0, 2.0, 3.0) &&
                materialParams.colors[2] == vec3(4.0, 5.0, 6.0));
        expect(21, all(equal(materialParams.flags[0], bvec2(false))) && all(equal(materialParams.flags[1], bvec2(true, false))));
        expect(22, materialParams.ints[1] == ivec4(-1, -2, -3, -4));
        expect(23, materialParams.frames[0][1] == vec3(0.0, 1.0, 0.0) && materialParams.frames[1][2] == vec3(0.0, 0.0, 2.0));
        expect(24, texture(materialParams_layers, vec3(0.5, 0.5, 1.0)).g == 1.0);
        expect(25, texture(materialParams_cube, vec3(0.0, 0.0, 1.0)) == vec4(1.0));
        expect(26, texture(materialParams_flat_, vec2(0.5)) == vec4(1.0));
        material.baseColor = vec4(float(wrong), wrong == 0 ? 1.0 : 0.0, 0.0, 1.0);
    }
}
)";

class MaterialParameters : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mEngine = test::makeEngine(GetParam());
        ASSERT_TRUE(mEngine);
    }
    void TearDown() override {
        if (mEngine) test::expectNoErrors(*mEngine);
    }

    template <class T>
    void set(MaterialInstance instance, const char* name, T const& value) {
        const Result<void> done = mEngine->set(instance, name, value);
        EXPECT_TRUE(done) << done.error().message;
    }
    /// The message with which setting it is refused.
    template <class... Values>
    std::string refusal(MaterialInstance instance, const char* name, Values const&... values) {
        const Result<void> done = mEngine->set(instance, name, values...);
        return done ? "accepted" : done.error().message;
    }

    std::optional<Engine> mEngine;
};

TEST_P(MaterialParameters, OfEveryTypeArriveInTheShader) {
    const Owned<Material> material = test::loadMaterial(*mEngine, kEveryType);
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    set(instance, "b1", true), set(instance, "b2", bool2(false, true)), set(instance, "b3", bool3(true, false, true));
    set(instance, "b4", bool4(false, true, false, true));
    set(instance, "f1", 1.5f), set(instance, "f2", float2(2, 3)), set(instance, "f3", float3(4, 5, 6));
    set(instance, "f4", float4(7, 8, 9, 10));
    set(instance, "i1", -1), set(instance, "i2", int2(-2, 3)), set(instance, "i3", int3(4, -5, 6));
    set(instance, "i4", int4(-2147483647, 8, -9, 10));
    set(instance, "u1", 4294967295u), set(instance, "u2", uint2(2, 3)), set(instance, "u3", uint3(4, 5, 6));
    set(instance, "u4", uint4(7, 8, 9, 10));
    set(instance, "m3", float3x3(1, 2, 3, 4, 5, 6, 7, 8, 9));
    set(instance, "m4", float4x4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16));
    set(instance, "weights", std::array{ 0.0f, 0.5f, 1.0f, 1.5f, 2.0f });
    const std::array colors{ float3(1, 2, 3), float3(4, 5, 6) };
    EXPECT_TRUE(mEngine->set(instance, "colors", colors, 1)); // element 0 stays zero
    EXPECT_TRUE(mEngine->set(instance, "flags", std::array{ bool2(true, false) }, 1));
    EXPECT_TRUE(mEngine->set(instance, "ints", std::vector{ int4(-1, -2, -3, -4) }, 1));
    set(instance, "frames", std::array{ float3x3(1), float3x3(2) });

    constexpr std::array<uint8_t, 8> kLayers{ 255, 0, 0, 255, 0, 255, 0, 255 };
    const Owned<Texture> layers = mEngine->own(mEngine->create(TextureDesc{ .kind = TextureKind::Texture2DArray,
                                                                            .layers = 2,
                                                                            .pixels = std::as_bytes(std::span(kLayers)),
                                                                            .name = "layers" }));
    EXPECT_TRUE(mEngine->set(instance, "layers", layers, kUnfilteredSampler));
    EXPECT_EQ(test::shownBy(*mEngine, instance), float4(0, 1, 0, 1)) << "red: the first value that is wrong";
}

TEST_P(MaterialParameters, AreSetByTheIdThatTheirNameHasInTheMaterial) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material {
    name : colors, shadingModel : unlit,
    parameters : [ { type : sampler2d, name : map }, { type : float, name : red }, { type : "float[2]", name : others } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec4 texel = texture(materialParams_map, vec2(0.5));
        material.baseColor = texel * vec4(materialParams.red, materialParams.others[0], materialParams.others[1], 1.0);
    }
}
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    const ParameterId red = *mEngine->findParameter(material, "red");
    EXPECT_TRUE(mEngine->set(instance, red, 0.25));
    EXPECT_TRUE(mEngine->set(instance, *mEngine->findParameter(material, "others"), std::array{ 0.5f, 1.0f }));
    constexpr std::array<uint8_t, 4> kCyan{ 0, 255, 255, 255 };
    const Owned<Texture> cyan = mEngine->own(mEngine->create(TextureDesc{ .pixels = std::as_bytes(std::span(kCyan)) }));
    EXPECT_EQ(test::shownBy(*mEngine, instance), float4(0.25f, 0.5f, 1, 1));
    EXPECT_TRUE(mEngine->set(instance, *mEngine->findParameter(material, "map"), cyan));
    EXPECT_EQ(test::shownBy(*mEngine, instance), float4(0, 0.5f, 1, 1));
    const Result<void> refused = mEngine->set(instance, red, ParameterValue(float2(1)));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("'red' of material 'colors' is float, but was given float2"));
    EXPECT_THAT(mEngine->findParameter(material, "rad").error().message, HasSubstr("'rad'; did you mean 'red'"));
}

TEST_P(MaterialParameters, OfVolumesAreFilteredAlongAllThreeAxesAndHaveLevels) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material {
    name : volumes, shadingModel : unlit,
    parameters : [ { type : sampler3d, name : volume }, { type : float3, name : at }, { type : float, name : level } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = textureLod(materialParams_volume, materialParams.at, materialParams.level);
    }
}
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    // Level 0: 2 x 1 x 4 texels of (column, 0, slice / 4); level 1: 1 x 1 x 2 of (0, 1, slice); level 2: one.
    std::vector<float4> texels;
    for (int slice = 0; slice < 4; ++slice) {
        for (int column = 0; column < 2; ++column) texels.emplace_back(column, 0, static_cast<float>(slice) / 4, 1);
    }
    for (int slice = 0; slice < 2; ++slice) texels.emplace_back(0, 1, slice, 1);
    texels.emplace_back(1, 1, 0, 1);
    const Owned<Texture> volume = mEngine->own(mEngine->create(TextureDesc{ .kind = TextureKind::Texture3D,
                                                                            .format = Format::RGBA32F,
                                                                            .width = 2,
                                                                            .layers = 4,
                                                                            .levels = 3,
                                                                            .pixels = std::as_bytes(std::span(texels)),
                                                                            .name = "volume" }));
    const Sampler linear{ .magFilter = Filter::Linear, .minFilter = Filter::Linear, .mipFilter = MipFilter::Nearest };
    set(instance, "level", 0.0f);
    EXPECT_TRUE(mEngine->set(instance, "volume", volume, linear));
    const auto shown = [&](float3 at, float level) {
        set(instance, "at", at), set(instance, "level", level);
        return test::shownBy(*mEngine, instance);
    };
    EXPECT_EQ(shown({ 0.25f, 0.5f, 0.125f }, 0), float4(0, 0, 0, 1));
    EXPECT_EQ(shown({ 0.5f, 0.5f, 0.625f }, 0), float4(0.5f, 0, 0.5f, 1)) << "between two columns of slice 2";
    EXPECT_EQ(shown({ 0.75f, 0.5f, 0.75f }, 0), float4(1, 0, 0.625f, 1)) << "between slices 2 and 3";
    EXPECT_EQ(shown({ 0.5f, 0.5f, 0.75f }, 1), float4(0, 1, 1, 1));
    EXPECT_EQ(shown({ 0.5f, 0.5f, 0.5f }, 2), float4(1, 1, 0, 1));
    constexpr float4 kNew(0, 0, 1, 1);
    mEngine->update(volume, { .pixels = std::as_bytes(std::span(&kNew, 1)), .level = 1, .firstLayer = 1 });
    EXPECT_EQ(shown({ 0.5f, 0.5f, 0.75f }, 1), float4(0, 0, 1, 1)) << "one slice of level 1 has other texels";
    const Owned<Texture> flat = mEngine->own(mEngine->create(TextureDesc{ .name = "flat" }));
    EXPECT_THAT(refusal(instance, "volume", Texture(flat), linear),
                testing::HasSubstr("'volume' of material 'volumes' is sampler3d, but texture 'flat' is a 2D texture"));
}

TEST_P(MaterialParameters, SamplersOfEveryKindAreOpaqueWhiteUntilTheyAreSet) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material {
    shadingModel : unlit, featureLevel : 2,
    parameters : [ { type : sampler2d, name : a }, { type : sampler2dArray, name : b }, { type : samplerCubemap, name : c },
                   { type : samplerCubemapArray, name : d }, { type : sampler3d, name : e } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec4 all = texture(materialParams_a, vec2(0.5)) + texture(materialParams_b, vec3(0.5, 0.5, 0.0));
        all += texture(materialParams_e, vec3(0.5));
        all += texture(materialParams_c, vec3(1.0, 0.0, 0.0)) + texture(materialParams_d, vec4(1.0, 0.0, 0.0, 0.0));
        material.baseColor = vec4(all.rgb, 1.0);
    }
}
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    EXPECT_EQ(test::shownBy(*mEngine, instance), float4(5, 5, 5, 1));
}

TEST_P(MaterialParameters, OfLevelTwoHaveArraysOfCubesWhoseFourthCoordinateChoosesTheCube) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material {
    name : cubes, shadingModel : unlit, featureLevel : 2, parameters : [ { type : samplerCubemapArray, name : cubes } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec3 right = texture(materialParams_cubes, vec4(1.0, 0.0, 0.0, 1.0)).rgb;
        material.baseColor = vec4(right.r, texture(materialParams_cubes, vec4(0.0, 0.0, -1.0, 0.0)).g, right.b, 1.0);
    }
}
)");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    std::array<uint8_t, 12 * 4> texels{};
    texels[6 * 4] = 255;     // red: +x of the second cube
    texels[5 * 4 + 1] = 255; // green: -z of the first
    const Owned<Texture> cubes = mEngine->own(mEngine->create(TextureDesc{ .kind = TextureKind::CubeArray,
                                                                           .layers = 12,
                                                                           .pixels = std::as_bytes(std::span(texels)),
                                                                           .name = "cubes" }));
    EXPECT_TRUE(mEngine->set(instance, "cubes", cubes, kUnfilteredSampler));
    EXPECT_EQ(test::shownBy(*mEngine, instance), float4(1, 1, 0, 1));
    const Owned<Texture> flat = mEngine->own(mEngine->create(TextureDesc{ .name = "flat" }));
    EXPECT_EQ(refusal(instance, "cubes", flat.get()),
              "parameter 'cubes' of material 'cubes' is samplerCubemapArray, but texture 'flat' is a 2D texture");
}

TEST_P(MaterialParameters, OfLevelThreeHaveSixteenSamplersEvenIfTheyAreLit) {
    std::string declared, sum;
    for (int i = 0; i < 16; ++i) {
        declared += fmt::format("{{ type : sampler2d, name : t{} }},", i);
        sum += fmt::format(" + texture(materialParams_t{}, vec2(0.5))", i);
    }
    const Owned<Material> material = test::loadMaterial(
            *mEngine, "material { featureLevel : 3, parameters : [" + declared +
                              "] }\nfragment { void material(inout MaterialInputs material) {\n    "
                              "prepareMaterial(material); material.baseColor = vec4(0.0, 0.0, 0.0, 1.0);\n    "
                              "material.emissive = vec4((vec4(0.0)" +
                              sum + ").rgb, 0.0); } }\n");
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    EXPECT_EQ(test::shownBy(*mEngine, instance).x, 16);
}

TEST_P(MaterialParameters, SayWhatTheyAreWhenTheyAreGivenSomethingElse) {
    const Owned<Material> material = test::loadMaterial(*mEngine, kEveryType);
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    EXPECT_EQ(refusal(instance, "f3", float2(1)),
              "parameter 'f3' of material 'everyType' is float3, but was given float2");
    EXPECT_EQ(refusal(instance, "i1", 1.0f), "parameter 'i1' of material 'everyType' is int, but was given float");
    EXPECT_EQ(refusal(instance, "f3", std::array{ float3(1) }),
              "parameter 'f3' of material 'everyType' is float3, but was given an array of float3");
    EXPECT_EQ(refusal(instance, "weights", 1.0f),
              "parameter 'weights' of material 'everyType' is float[5], but was given float");
    EXPECT_EQ(refusal(instance, "weights", std::array{ 1, 2 }),
              "parameter 'weights' of material 'everyType' is float[5], but was given an array of int");
    EXPECT_EQ(refusal(instance, "weights", std::array<float, 6>{}),
              "parameter 'weights' of material 'everyType' is float[5]: 6 values from element 0 on are too many");
    EXPECT_EQ(refusal(instance, "weights", std::array{ 1.0f, 2.0f }, 4u),
              "parameter 'weights' of material 'everyType' is float[5]: 2 values from element 4 on are too many");
    EXPECT_EQ(refusal(instance, "weights", std::array<float, 0>{}, 6u),
              "parameter 'weights' of material 'everyType' is float[5]: 0 values from element 6 on are too many");
    EXPECT_EQ(refusal(instance, "cube", float4(1)),
              "parameter 'cube' of material 'everyType' is samplerCubemap: give it a texture, not float4");
    EXPECT_THAT(refusal(instance, "wieghts", 1.0f), HasSubstr("did you mean 'weights'?"));
    const Owned<Texture> flat = mEngine->own(mEngine->create(TextureDesc{ .name = "flat" }));
    EXPECT_EQ(refusal(instance, "cube", flat.get()),
              "parameter 'cube' of material 'everyType' is samplerCubemap, but texture 'flat' is a 2D texture");
    EXPECT_EQ(refusal(instance, "f1", flat.get()), "parameter 'f1' of material 'everyType' is float, not a sampler");
}

constexpr const char* kConstants = R"(material {
    name : switches, shadingModel : unlit,
    constants : [ { name : red, type : bool, default : true }, { name : steps, type : int, default : -3 },
                  { name : scale, type : float, default : 0.25 } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = vec4(materialConstants_red ? 1.0 : 0.0, float(materialConstants_steps), materialConstants_scale, 1.0);
    }
}
)";

TEST_P(MaterialParameters, ConstantsOfEveryTypeAreFixedWhenTheMaterialIsLoaded) {
    const std::vector<MaterialConstant> given{ { "red", false }, { "steps", 7 }, { "scale", 0.5f } };
    const Owned<Material> plain = test::loadMaterial(*mEngine, kConstants);
    const Owned<Material> other = test::loadMaterial(*mEngine, kConstants, given);
    const Owned<MaterialInstance> a = mEngine->own(mEngine->createInstance(plain));
    const Owned<MaterialInstance> b = mEngine->own(mEngine->createInstance(other));
    EXPECT_EQ(test::shownBy(*mEngine, a), float4(1, -3, 0.25f, 1));
    EXPECT_EQ(test::shownBy(*mEngine, b), float4(0, 7, 0.5f, 1));
    const std::span<const std::byte> bytes = test::compiledPackage(kConstants);
    const auto wrong = mEngine->create(MaterialDesc{ .package = bytes, .constants = { { "steps", 1.0f } } });
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "constant 'steps' of material 'switches' is int, but was given float");
}

TEST_P(MaterialParameters, AMaterialDescribesWhatItsFileDeclares) {
    const Owned<Material> material = test::loadMaterial(*mEngine, R"(material {
    name : leaf, shadingModel : lit, blending : masked, maskThreshold : 0.25, doubleSided : true, featureLevel : 2,
    requires : [ uv0 ], variantFilter : [ dynamicLighting, fog ],
    parameters : [ { type : "float4[3]", name : tints, precision : low }, { type : sampler2d, name : map, format : float, precision : high } ],
    constants : [ { name : count, type : int, default : 2 } ]
}
fragment {
    void material(inout MaterialInputs material) {
        material.normal = vec3(0.0, 0.6, 0.8);
        prepareMaterial(material);
        material.baseColor = texture(materialParams_map, getUV0()) * materialParams.tints[materialConstants_count];
    }
}
)",
                                                        { { "count", 1 } });
    MaterialDescription const& leaf = mEngine->describe(material);
    EXPECT_EQ(leaf.name, "leaf");
    EXPECT_EQ(leaf.shading, ShadingModel::Lit);
    EXPECT_EQ(leaf.blending, Blending::Masked);
    EXPECT_EQ(leaf.maskThreshold, 0.25f);
    EXPECT_EQ(leaf.featureLevel, 2u);
    EXPECT_TRUE(leaf.doubleSided);
    EXPECT_TRUE(leaf.requiredAttributes & 1u << static_cast<uint32_t>(Attribute::Uv0));
    const std::vector<ParameterDescription> parameters{ { "tints", ParameterType::Float4, 3, Precision::Low },
                                                        { "map", ParameterType::Sampler2D, 0, Precision::High,
                                                          SamplerFormat::Float } };
    EXPECT_EQ(leaf.parameters, parameters);
    EXPECT_EQ(leaf.findParameter("map"), &leaf.parameters[1]);
    EXPECT_EQ(leaf.findParameter("Map"), nullptr);
    const std::vector<ConstantDescription> constants{ { "count", 2, 1 } };
    EXPECT_EQ(leaf.constants, constants);
    EXPECT_EQ(leaf.filtered, VariantSet::DynamicLighting | VariantSet::Fog);
    EXPECT_THAT(leaf.variants, testing::Contains(VariantSet::DirectionalLighting));
    EXPECT_THAT(leaf.variants, testing::Not(testing::Contains(VariantSet::DynamicLighting)));
    EXPECT_THAT(leaf.terms, testing::Contains("normal"));
    EXPECT_EQ(toString(leaf.filtered), "dynamicLighting, fog");
    EXPECT_STREQ(toString(leaf.parameters[1].type), "sampler2d");
}

INSTANTIATE_TEST_SUITE_P(BothApis, MaterialParameters, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
