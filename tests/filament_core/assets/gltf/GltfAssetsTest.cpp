// SPDX-License-Identifier: Apache-2.0
// Real files: every model of the asset folder, and known facts about some of them.
#include "base/Hash.h"
#include "filament_core/assets/geometry/Tangents.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/gltf/GltfFuzzBody.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace filament_core::assets::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

fs::path modelFolder() { return tools::assetDir() / "models"; }

#define REQUIRE_ASSETS()                                                                                               \
    if (tools::assetDir().empty()) GTEST_SKIP() << "needs FILAMENT_ASSET_DIR, the folder of sample models"

std::vector<fs::path> allModels() {
    std::vector<fs::path> paths;
    for (fs::directory_entry const& folder : fs::directory_iterator(modelFolder())) {
        if (!folder.is_directory()) continue;
        for (fs::directory_entry const& file : fs::directory_iterator(folder)) {
            const fs::path extension = file.path().extension();
            if (extension == ".gltf" || extension == ".glb") paths.push_back(file.path());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

ModelData loadModel(const char* name, int workers = -1) {
    jobs::JobSystem jobs({ .workers = workers });
    Result<ModelData> model = loadGltf(modelFolder() / name, jobs);
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    return std::move(*model);
}

struct Bounds {
    double3 low{ 1e300 }, high{ -1e300 };
};

Bounds worldBounds(ModelData const& model) {
    Bounds bounds;
    for (NodeData const& node : model.nodes) {
        if (node.mesh == kNone) continue;
        for (PrimitiveData const& primitive : model.meshes[node.mesh].primitives) {
            for (int corner = 0; corner < 8; ++corner) {
                const float3 p(corner & 1 ? primitive.boundsMax.x : primitive.boundsMin.x,
                               corner & 2 ? primitive.boundsMax.y : primitive.boundsMin.y,
                               corner & 4 ? primitive.boundsMax.z : primitive.boundsMin.z);
                const double3 world(node.worldFromNode * double4(double3(p), 1.0));
                bounds.low = glm::min(bounds.low, world);
                bounds.high = glm::max(bounds.high, world);
            }
        }
    }
    return bounds;
}

TEST(GltfAssets, EveryModelLoadsAndKeepsThePromisesOfModelData) {
    REQUIRE_ASSETS();
    const std::vector<fs::path> paths = allModels();
    EXPECT_GE(paths.size(), 34u);
    jobs::JobSystem jobs;
    for (fs::path const& path : paths) {
        SCOPED_TRACE(path.filename().string());
        const Result<ModelData> model = loadGltf(path, jobs, { .maxTextureSize = 256 }); // small images: less to check
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_EQ(brokenPromise(*model), nullptr);
        const Bounds bounds = worldBounds(*model);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LT(bounds.high[axis] - bounds.low[axis], 1000);
        }
        EXPECT_GT(glm::length(bounds.high - bounds.low), 0.001);
    }
}

/// Three ways of storing the unit box give the same numbers.
TEST(GltfAssets, InterleavedDracoAndMeshoptBoxesAreTheSameBox) {
    REQUIRE_ASSETS();
    for (const char* name :
         { "BoxInterleaved/BoxInterleaved.gltf", "Box-Draco/Box.gltf", "BoxMeshopt/BoxMeshopt.glb" }) {
        SCOPED_TRACE(name);
        const ModelData model = loadModel(name);
        ASSERT_EQ(model.meshes.size(), 1u);
        PrimitiveData const& primitive = model.meshes[0].primitives[0];
        EXPECT_EQ(primitive.vertexCount, 24u);
        EXPECT_EQ(primitive.indexCount, 36u);
        const Bounds bounds = worldBounds(model);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(bounds.low[axis], -0.5, 1e-3); // the compressed ones are quantised
            EXPECT_NEAR(bounds.high[axis], 0.5, 1e-3);
        }
        const std::vector<float3> corners = cornersOf(primitive);
        for (size_t i = 0; i < corners.size(); i += 3) { // every triangle faces outwards, like its vertices' normals
            const float3 outside = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
            float3 n, t, b;
            shader::lib::tangentFrame(vertexValue(primitive, shader::kAttributeTangents, indicesOf(primitive)[i]), n, t,
                                      b);
            EXPECT_GT(glm::dot(glm::normalize(outside), n), 0.99f);
        }
    }
}

TEST(GltfAssets, FlightHelmetHasItsFifteenTexturesOnceEach) {
    REQUIRE_ASSETS();
    const ModelData model = loadModel("FlightHelmet/FlightHelmet.gltf");
    EXPECT_EQ(model.images.size(), 15u);
    EXPECT_EQ(std::count_if(model.images.begin(), model.images.end(),
                            [](Image const& image) { return image.format == backend::Format::RGBA8Srgb; }),
              5);
    EXPECT_EQ(model.meshes.size(), 6u);
    EXPECT_THAT(model.warnings, ElementsAre());
}

TEST(GltfAssets, TheSheenChairHasTwoFabricsAsVariants) {
    REQUIRE_ASSETS();
    const ModelData model = loadModel("SheenChair/SheenChair.gltf");
    EXPECT_THAT(model.warnings, ElementsAre());
    EXPECT_THAT(model.variants, ElementsAre("Mango Velvet", "Peacock Velvet"));
    EXPECT_EQ(std::ranges::count_if(model.materials, [](MaterialData const& m) { return m.sheen.isUsed(); }), 2);
}

// 71 of its channels have keys that share a time with the one before: cuts of its exporter.
TEST(GltfAssets, LittlestTokyoMovesInAllOfItsChannels) {
    REQUIRE_ASSETS();
    jobs::JobSystem jobs;
    const Result<ModelData> model =
            loadGltf(modelFolder() / "LittlestTokyo/LittlestTokyo.glb", jobs, { .deformation = GltfDeformation::Kept });
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->animations.size(), 1u);
    EXPECT_EQ(model->animations[0].channels.size(), 96u);
    EXPECT_THAT(model->warnings,
                testing::Contains(testing::HasSubstr(
                        "LittlestTokyo.glb: animations[0] 'Take 001': the times of channels 2, 4, 6")));
}

TEST(GltfAssets, ModelsThatTestExtensionsLoadWithoutWarnings) {
    REQUIRE_ASSETS();
    for (const char* name :
         { "ClearCoatTest/ClearCoatTest.glb", "TransmissionTest/TransmissionTest.glb",
           "AttenuationTest/AttenuationTest.glb", "DispersionTest/DispersionTest.glb", "SpecularTest/SpecularTest.glb",
           "AnisotropyStrengthTest/AnisotropyStrengthTest.glb", "AnisotropyRotationTest/AnisotropyRotationTest.glb",
           "SpecularGlossiness13/Material_SpecularGlossiness_13.gltf" }) {
        EXPECT_THAT(loadModel(name).warnings, ElementsAre()) << name;
    }
}

TEST(GltfAssets, LampAndSpotLightsArrive) {
    REQUIRE_ASSETS();
    EXPECT_EQ(loadModel("LightsPunctualLamp/LightsPunctualLamp.gltf").lights.size(), 5u);
    const ModelData spot = loadModel("ShadowsSpot/shadows-spot.gltf");
    ASSERT_EQ(spot.lights.size(), 1u);
    EXPECT_EQ(spot.lights[0].type, LightType::Spot);
}

TEST(GltfAssets, InstancesArePlaced) {
    REQUIRE_ASSETS();
    EXPECT_EQ(loadModel("SimpleInstancing/SimpleInstancing.glb").nodes.size(), 1u + 125u);
}

// The bind pose of RiggedFigure is its rest pose up to rounding, so skinning must keep it within the bounds that the
// file states for the bind pose.
TEST(GltfAssets, SkinnedModelsStandWhereTheirBindPoseStands) {
    REQUIRE_ASSETS();
    const Bounds figure = worldBounds(loadModel("RiggedFigure/RiggedFigure.glb"));
    EXPECT_NEAR(figure.low.y, 0, 0.02); // stands on the ground
    EXPECT_NEAR(figure.high.y, 1.5, 0.1);
    const Bounds fox = worldBounds(loadModel("Fox/Fox.glb"));
    EXPECT_NEAR(fox.low.y, 0, 1);
    EXPECT_NEAR(fox.high.y, 79, 1);
}

uint64_t hashOf(ModelData const& model) {
    uint64_t hash = 0;
    for (Image const& image : model.images) hash = hashBytes(image.data, hash);
    for (MeshData const& mesh : model.meshes) {
        for (PrimitiveData const& p : mesh.primitives) hash = hashBytes(p.vertices, hashBytes(p.indices, hash));
    }
    for (std::string const& line : model.warnings) hash = hashString(line, hash);
    return hash;
}

TEST(GltfAssets, TheResultDoesNotDependOnTheNumberOfWorkers) {
    REQUIRE_ASSETS();
    for (const char* name : { "SheenChair/SheenChair.gltf", "MorphStressTest/MorphStressTest.glb" }) {
        const uint64_t alone = hashOf(loadModel(name, 0));
        EXPECT_EQ(hashOf(loadModel(name, 1)), alone) << name;
        EXPECT_EQ(hashOf(loadModel(name, 3)), alone) << name;
    }
}

/// Compares generated tangents with those of the authoring tool: mean angle in degrees, and how many corners agree in
/// handedness.
struct Agreement {
    double meanDegrees = 0, sameHandedness = 0;
};

Agreement compareTangents(PrimitiveData const& primitive) {
    std::vector<float3> positions, normals, tangents;
    std::vector<float2> uvs;
    std::vector<float> signs;
    for (uint32_t i = 0; i < primitive.vertexCount; ++i) {
        const float4 q = vertexValue(primitive, shader::kAttributeTangents, i);
        float3 n, t, b;
        shader::lib::tangentFrame(q, n, t, b);
        positions.push_back(positionOf(primitive, i));
        normals.push_back(glm::normalize(n));
        tangents.push_back(glm::normalize(t));
        signs.push_back(q.w < 0 ? -1.0f : 1.0f);
        uvs.emplace_back(vertexValue(primitive, shader::kAttributeUv0, i));
    }
    const std::vector<uint32_t> indices = indicesOf(primitive);
    const TangentOutput output = generateTangents({ positions, normals, uvs, indices });
    Agreement agreement;
    for (size_t c = 0; c < indices.size(); ++c) {
        const float4 generated = output.tangents[output.indices[c]];
        const double cosine = glm::dot(double3(float3(generated)), double3(tangents[indices[c]]));
        agreement.meanDegrees += std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29578;
        agreement.sameHandedness += generated.w == signs[indices[c]];
    }
    agreement.meanDegrees /= static_cast<double>(indices.size());
    agreement.sameHandedness /= static_cast<double>(indices.size());
    return agreement;
}

// The bounds are measured values, rounded up. The 16 bits of the frames cause 0.003 degrees between equal tangents, so
// the tools behind the first two files follow MikkTSpace exactly; the one behind the helmet averages differently.
TEST(GltfAssets, GeneratedTangentsAgreeWithThoseOfTheFiles) {
    REQUIRE_ASSETS();
    for (const auto& [name, degrees] : { std::pair{ "AlphaBlendModeTest/AlphaBlendModeTest.glb", 0.005 },
                                         { "AnisotropyRotationTest/AnisotropyRotationTest.glb", 0.1 },
                                         { "FlightHelmet/FlightHelmet.gltf", 1.5 } }) {
        const ModelData model = loadModel(name);
        for (MeshData const& mesh : model.meshes) {
            for (PrimitiveData const& primitive : mesh.primitives) {
                const Agreement agreement = compareTangents(primitive);
                EXPECT_LT(agreement.meanDegrees, degrees) << name << " " << mesh.name;
                EXPECT_GT(agreement.sameHandedness, 0.999) << name << " " << mesh.name;
            }
        }
    }
}

} // namespace
} // namespace filament_core::assets::test
