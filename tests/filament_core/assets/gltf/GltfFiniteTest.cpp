// SPDX-License-Identifier: Apache-2.0
// Numbers that are not finite, in every place of a file that can hold one: what uses a broken vertex, instance or key
// is left out, with a warning, and the rest of the model is as it was.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kNotFinite{ NAN, INFINITY, -INFINITY };
constexpr size_t kBandPoints = 7;

/// Seven points of a band; `at` names the number that is replaced.
std::vector<float> band(size_t at = ~size_t{ 0 }, float value = 0) {
    std::vector<float> positions;
    for (size_t i = 0; i < kBandPoints; ++i) {
        const auto x = static_cast<float>(i);
        positions.insert(positions.end(), { 1 + x, 1 + static_cast<float>(i % 2), 2 + 0.25f * x * x });
    }
    if (at < positions.size()) positions[at] = value;
    return positions;
}

ModelData loadedWith(TestFile const& file, GltfDeformation deformation) {
    Result<ModelData> model = file.load({ .deformation = deformation });
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    return std::move(*model);
}

/// The corners of the same file whose number is whole, without the triangles, lines or points that use `vertex`.
std::vector<float3> cornersWithout(TestFile const& whole, float3 vertex, size_t corners) {
    const std::vector<float3> all = cornersOf(onlyPrimitive(whole));
    std::vector<float3> kept;
    for (size_t i = 0; i < all.size(); i += corners) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(first, first + static_cast<std::ptrdiff_t>(corners), vertex) ==
            first + static_cast<std::ptrdiff_t>(corners))
            kept.insert(kept.end(), first, first + static_cast<std::ptrdiff_t>(corners));
    }
    return kept;
}

TEST(GltfFinite, WhatUsesABrokenPositionIsNotDrawn) {
    for (int mode = 0; mode <= 6; ++mode) {
        const size_t corners = mode == 0 ? 1 : mode <= 3 ? 2 : 3;
        TestFile whole;
        whole.positions(band());
        whole.primitive()["mode"] = mode;
        for (size_t at = 0; at < 3 * kBandPoints; ++at) {
            TestFile file;
            file.positions(band(at, kNotFinite[at % 3]));
            file.primitive()["mode"] = mode;
            const ModelData model = loaded(file);
            const size_t vertex = at / 3 * 3;
            const std::vector<float> numbers = band();
            const std::vector<float3> expected =
                    cornersWithout(whole, { numbers[vertex], numbers[vertex + 1], numbers[vertex + 2] }, corners);
            if (expected.empty()) {
                EXPECT_TRUE(model.meshes[0].primitives.empty()) << mode << " " << at; // a fan without its centre
            } else {
                PrimitiveData const& primitive = model.meshes[0].primitives[0];
                EXPECT_EQ(cornersOf(primitive), expected) << mode << " " << at;
                EXPECT_GE(primitive.boundsMin.x, 1) << "the bounds do not reach to the origin";
                EXPECT_GE(primitive.restBounds.min.x, 1);
            }
            ASSERT_EQ(model.warnings.size(), loaded(whole).warnings.size() + 1) << mode << " " << at;
            EXPECT_THAT(model.warnings.back(), HasSubstr("meshes[0].primitives[0]: "));
            EXPECT_THAT(model.warnings.back(), HasSubstr("are not drawn: 1 of 7 positions"));
        }
    }
}

TEST(GltfFinite, TheWarningCountsWhatIsLeftOut) {
    TestFile file;
    file.positions(band(4, NAN));
    file.indices({ 0, 1, 2, 2, 3, 4, 4, 5, 6, 1, 5, 6 });
    EXPECT_THAT(loaded(file).warnings,
                ElementsAre(HasSubstr("2 of 4 triangles are not drawn: 1 of 7 positions are not finite")));
}

TEST(GltfFinite, PositionsThatOverflowAtRestAreNotDrawnEither) {
    TestFile file;
    file.positions(band());
    std::vector<float> deltas(3 * kBandPoints, 0.0f);
    deltas[12] = 3e38f;
    file.primitive()["targets"] = { { { "POSITION", file.add(deltas, kFloat, "VEC3", 3) } } };
    file.primitive()["mode"] = 0;
    file.root["meshes"][0]["weights"] = { 2 };
    const ModelData model = loaded(file);
    EXPECT_EQ(model.meshes[0].primitives[0].indexCount, 6u);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("1 of 7 points are not drawn")));
}

TEST(GltfFinite, BrokenNormalsBecomeThoseOfTheirTriangles) {
    for (const float value : kNotFinite) {
        TestFile file = TestFile::triangle();
        file.normals({ 0, 0, 1, value, 0, 0, 0, value, 1 });
        const ModelData model = loaded(file);
        PrimitiveData const& primitive = model.meshes[0].primitives[0];
        for (uint32_t i = 1; i < 3; ++i) {
            EXPECT_EQ(vertexValue(primitive, shader::kAttributeTangents, i),
                      vertexValue(primitive, shader::kAttributeTangents, 0));
        }
        EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("2 of 3 normals are not finite")));
    }
}

TEST(GltfFinite, BrokenTangentsAreComputed) {
    const auto withTangents = [](bool hasTangents, float value) {
        TestFile file = TestFile::triangle();
        file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
        file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 0, 1, 1, 0 }, kFloat, "VEC2", 2);
        if (hasTangents)
            file.attribute("TANGENT", std::vector<float>{ 1, 0, 0, 1, 1, 0, 0, value, 1, 0, 0, 1 }, kFloat, "VEC4", 4);
        file.root["materials"] =
                Json::parse(R"([ { "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 0.5 } } } ])");
        file.primitive()["material"] = 0;
        return loaded(file);
    };
    const ModelData without = withTangents(false, 0);
    for (const float value : kNotFinite) {
        const ModelData broken = withTangents(true, value);
        EXPECT_EQ(broken.meshes[0].primitives[0].vertices, without.meshes[0].primitives[0].vertices);
        EXPECT_THAT(broken.warnings, ElementsAre(HasSubstr("1 of 3 tangents are not finite")));
    }
}

/// A triangle that one joint at (0, 5, 0) moves.
TestFile skinnedFile(std::vector<float> const& weights, std::vector<float> const& bind) {
    TestFile file = TestFile::triangle();
    file.attribute("JOINTS_0", std::vector<uint8_t>(12, 0), kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", weights, kFloat, "VEC4", 4);
    file.root["skins"] = { { { "joints", { 1 } }, { "inverseBindMatrices", file.add(bind, kFloat, "MAT4", 16) } } };
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "skin": 0 }, { "translation": [ 0, 5, 0 ] } ])");
    file.root["scenes"][0]["nodes"] = { 0, 1 };
    return file;
}

TEST(GltfFinite, ABrokenBindMatrixLeavesVerticesInTheirPlace) {
    std::vector<float> bind{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1 };
    const std::vector<float> weights{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 };
    const TestFile whole = skinnedFile(weights, bind);
    for (size_t at = 0; at < bind.size(); ++at) {
        std::vector<float> broken = bind;
        broken[at] = kNotFinite[at % 3];
        const TestFile file = skinnedFile(weights, broken);
        for (const GltfDeformation deformation : { GltfDeformation::AtRest, GltfDeformation::Kept }) {
            const ModelData model = loadedWith(file, deformation), expected = loadedWith(whole, deformation);
            EXPECT_EQ(model.meshes[0].primitives[0].vertices, expected.meshes[0].primitives[0].vertices) << at;
            EXPECT_THAT(model.warnings,
                        ElementsAre(HasSubstr("skins[0]: 1 of 1 inverse bind matrices are not finite")));
            if (deformation == GltfDeformation::Kept) {
                EXPECT_EQ(model.skins[0].jointFromBind[0], expected.skins[0].jointFromBind[0]);
            }
        }
    }
}

TEST(GltfFinite, WeightsOfJointsThatAreBrokenCountAsZero) {
    const std::vector<float> bind{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1 };
    for (const float value : kNotFinite) {
        const TestFile file = skinnedFile({ 1, 0, 0, 0, 1, value, 0, 0, value, 0, 0, 0 }, bind);
        EXPECT_EQ(cornersOf(onlyPrimitive(file)), cornersOf(onlyPrimitive(TestFile::triangle())));
        const ModelData kept = loadedWith(file, GltfDeformation::Kept);
        PrimitiveData const& primitive = kept.meshes[0].primitives[0];
        for (uint32_t i = 0; i < 3; ++i) {
            EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights, i), float4(1, 0, 0, 0));
        }
    }
}

TEST(GltfFinite, CoordinatesAndColoursAreFinite) {
    for (const float value : kNotFinite) {
        TestFile file = TestFile::triangle();
        file.attribute("TEXCOORD_0", std::vector<float>{ 0, value, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
        file.attribute("COLOR_0", std::vector<float>{ 1, 1, value, 1, 1, 1, 1, 1, 1 }, kFloat, "VEC3", 3);
        const ModelData model = loaded(file);
        PrimitiveData const& primitive = model.meshes[0].primitives[0];
        for (uint32_t i = 0; i < primitive.vertexCount; ++i) {
            for (const uint8_t location : { shader::kAttributeUv0, shader::kAttributeColor }) {
                const float4 read = vertexValue(primitive, location, i);
                EXPECT_TRUE(std::isfinite(read.x + read.y + read.z + read.w));
            }
        }
        EXPECT_EQ(model.warnings.size(), 2u);
    }
}

TEST(GltfFinite, BrokenDisplacementsDoNotMoveTheirVertex) {
    for (const float value : kNotFinite) {
        TestFile file = TestFile::triangle();
        std::vector<float> deltas(9, 0.0f);
        deltas[4] = value;
        file.primitive()["targets"] = { { { "POSITION", file.add(deltas, kFloat, "VEC3", 3) } } };
        file.root["meshes"][0]["weights"] = { 1 };
        EXPECT_EQ(cornersOf(onlyPrimitive(file)), cornersOf(onlyPrimitive(TestFile::triangle())));
        EXPECT_EQ(loadedWith(file, GltfDeformation::Kept).meshes[0].primitives[0].morphTargets[0].positions[1],
                  float3(0.0f));
    }
}

TEST(GltfFinite, InstancesWithoutAFinitePlaceAreNotDrawn) {
    for (const char* name : { "TRANSLATION", "ROTATION", "SCALE" }) {
        const size_t width = name[0] == 'R' ? 4 : 3;
        for (size_t at = 0; at < 3 * width; ++at) {
            TestFile file = TestFile::triangle();
            std::vector<float> values(3 * width, 0.5f);
            values[at] = kNotFinite[at % 3];
            file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"][name] =
                    file.add(values, kFloat, width == 4 ? "VEC4" : "VEC3", width);
            const ModelData model = loaded(file);
            EXPECT_EQ(model.nodes.size(), 3u) << "the node and two instances";
            EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("nodes[0]: 1 of 3 instances are not drawn")));
        }
    }
}

TEST(GltfFinite, WeightsAndTransformsBeyondFloatsAreFinite) {
    TestFile file = TestFile::triangle();
    file.primitive()["targets"] = { { { "POSITION", file.add(std::vector<float>(9, 0.0f), kFloat, "VEC3", 3) } } };
    file.root["nodes"][0]["weights"] = { 1e300 };
    const ModelData model = loadedWith(file, GltfDeformation::Kept);
    EXPECT_TRUE(std::isfinite(model.nodes[0].morphWeights[0]));
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("nodes[0].weights[0]")));
}

TEST(GltfFinite, KeysWithBrokenValuesAreLeftOut) {
    for (const char* interpolation : { "STEP", "LINEAR", "CUBICSPLINE" }) {
        const size_t rows = interpolation[0] == 'C' ? 3 : 1;
        for (size_t at = 0; at < 9 * rows; ++at) {
            TestFile file = TestFile::triangle();
            std::vector<float> values(9 * rows, 2.0f);
            values[at] = kNotFinite[at % 3];
            const size_t times = file.add(std::vector<float>{ 0, 1, 2 }, kFloat, "SCALAR", 1);
            const size_t output = file.add(values, kFloat, "VEC3", 3);
            file.root["animations"] = {
                { { "samplers", { { { "input", times }, { "output", output }, { "interpolation", interpolation } } } },
                  { "channels", { { { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "scale" } } } } } } }
            };
            const ModelData model = loadedWith(file, GltfDeformation::Kept);
            AnimationSampler const& sampler = model.animations[0].samplers[0];
            EXPECT_EQ(sampler.times.size(), 2u);
            EXPECT_EQ(sampler.values, std::vector<float>(6 * rows, 2.0f));
            EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("1 with values that are not finite (left out)")));
        }
    }
}

} // namespace
} // namespace filament_core::assets::test
