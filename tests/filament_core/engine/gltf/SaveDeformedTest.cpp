// SPDX-License-Identifier: Apache-2.0
// Meshes of the program in saved scenes, with skins and morph targets: the pixels are the same.
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/SaveGltf.h>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace filament_core {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Exposure kSkinExposure{ .aperture = 1, .shutterSeconds = 1.2f, .iso = 100 }; // of factor 1

double4x4 shiftedBy(double3 by) {
    double4x4 matrix(1.0);
    matrix[3] = double4(by, 1);
    return matrix;
}

/// A scene of the program, drawn before and after it was a file.
class SaveDeformed : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        folder = test::folderOfThisTest();
        scene.emplace(*engine);
        lit = engine->own(*createBuiltInMaterial(*engine, "lit"));
        paint = engine->own(engine->createInstance(lit, "paint"));
        ASSERT_TRUE(engine->set(paint, "baseColor", float3(0.8f, 0.3f, 0.1f)));
        ASSERT_TRUE(engine->set(paint, "roughness", 0.25f));
        scene->add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 3 } });
        view.camera = Camera::lookAt({ 0.3, 0.9, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 }, kSkinExposure);
        view.size = { 96, 72 };
    }
    void TearDown() override {
        scene.reset();
        buffers.clear();
        indices.clear();
        targets.clear();
        paint.reset();
        lit.reset();
        if (engine) test::expectNoErrors(*engine);
    }

    /// With joints by height: vertices at the foot follow the first one.
    RenderableDesc bending(Mesh const& mesh, VertexFormat weights, uint8_t bones) {
        VertexBufferDesc desc = mesh.vertexBuffer();
        std::vector<std::byte> bytes;
        const auto put = [&](void const* from, size_t size) {
            auto const* const first = static_cast<std::byte const*>(from);
            bytes.insert(bytes.end(), first, first + size);
        };
        for (MeshVertex const& vertex : mesh.vertices) {
            const float share = glm::clamp(vertex.position.y + 0.5f, 0.0f, 1.0f);
            const uint8_t joints[4] = { 0, static_cast<uint8_t>(bones - 1), 0, 0 };
            const auto second = static_cast<uint8_t>(std::lround(share * 255));
            const uint8_t integers[4] = { static_cast<uint8_t>(255 - second), second, 0, 0 };
            const float4 floats(1 - share, share, 0, 0);
            put(joints, sizeof joints);
            weights == VertexFormat::Float4 ? put(&floats, sizeof floats) : put(integers, sizeof integers);
        }
        desc.streams.push_back({ static_cast<uint32_t>(bytes.size() / mesh.vertices.size()),
                                 { { Attribute::Joints, VertexFormat::UByte4, 0 }, { Attribute::Weights, weights, 4 } },
                                 bytes });
        return add(mesh, desc);
    }
    RenderableDesc add(Mesh const& mesh, VertexBufferDesc const& desc) {
        buffers.push_back(engine->own(engine->create(desc)));
        indices.push_back(engine->own(engine->create(mesh.indexBuffer())));
        return { .vertices = buffers.back(), .indices = indices.back(), .material = paint };
    }

    /// The number of pixels that differ.
    size_t difference(std::vector<std::string>* warnings = nullptr) {
        const Image before = test::renderLinear(*engine, *scene, view);
        EXPECT_GT(test::extremesOf(before).most, 0.3f);
        const auto saved = saveGltf(*scene, folder / "scene.glb");
        EXPECT_TRUE(saved) << saved.error().message;
        if (!saved) return ~size_t{ 0 };
        if (warnings)
            *warnings = saved->warnings;
        else
            EXPECT_THAT(saved->warnings, IsEmpty());
        const auto model = loadGltf(*engine, folder / "scene.glb");
        EXPECT_TRUE(model) << model.error().message;
        if (!model) return ~size_t{ 0 };
        EXPECT_THAT(model->warnings(), IsEmpty());
        Scene again(*engine);
        again.add(*model);
        return test::differingPixels(before, test::renderLinear(*engine, again, view));
    }

    std::optional<Engine> engine;
    std::optional<Scene> scene;
    fs::path folder;
    View view;
    Owned<Material> lit;
    Owned<MaterialInstance> paint;
    std::vector<Owned<VertexBuffer>> buffers;
    std::vector<Owned<IndexBuffer>> indices;
    std::vector<Owned<MorphTargets>> targets;
};
INSTANTIATE_TEST_SUITE_P(Apis, SaveDeformed, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return toString(test.param); });

TEST_P(SaveDeformed, MeshesKeepTheFramesOfTheirVertices) {
    const Mesh ball = *makeUvSphere(), ring = *makeTorus();
    const auto place = [&](RenderableDesc desc, double x) {
        desc.worldFromObject = shiftedBy({ x, 0, 0 });
        scene->add(desc);
    };
    place(add(ball, ball.vertexBuffer()), -0.8);
    // Packed ones keep their format.
    VertexBufferDesc packed = ring.vertexBuffer();
    std::vector<std::byte> bytes(packed.data.begin(), packed.data.end());
    for (AttributeDesc& attribute : packed.attributes) {
        if (attribute.attribute != Attribute::Tangents) continue;
        attribute.format = VertexFormat::Short4N;
        for (size_t i = 0; i < ring.vertices.size(); ++i) {
            const auto frame = packTangents(ring.vertices[i].tangents);
            std::memcpy(&bytes[i * packed.stride + attribute.offset], frame.data(), sizeof frame);
        }
    }
    packed.data = bytes;
    place(add(ring, packed), 0.8);
    EXPECT_EQ(difference(), 0u);
}

TEST_P(SaveDeformed, SkinsOfNodesDrawTheSamePixels) {
    const Node foot = scene->add(NodeDesc{ .parentFromNode = shiftedBy({ 0, -0.5, 0 }), .name = "foot" });
    double4x4 bent = glm::rotate(double4x4(1.0), 0.5, double3(0, 0, 1));
    bent[3] = { 0.1, 1, 0, 1 };
    const Node head = scene->add(NodeDesc{ .parent = foot, .parentFromNode = bent, .name = "head" });
    const std::array joints{ foot, head };
    const std::array jointFromBind{ float4x4(shiftedBy({ 0, 0.5, 0 })), float4x4(shiftedBy({ 0, -0.5, 0 })) };
    Mesh bar = *makeCylinder({ .radius = 0.3f, .height = 1, .stacks = 8 });
    const Skin skin = scene->add(SkinDesc{ .joints = joints, .jointFromBind = jointFromBind });
    for (const VertexFormat format : { VertexFormat::Float4, VertexFormat::UByte4N }) {
        RenderableDesc desc = bending(bar, format, 2);
        desc.skin = skin;
        scene->add(desc);
        for (MeshVertex& vertex : bar.vertices) vertex.position.x -= 0.9f; // the next one beside it
    }
    view.quality.shadows = ShadowFilter::Off; // maps fit the boxes of bones, which the loader makes tight
    EXPECT_EQ(difference(), 0u);
    const auto model = loadGltf(*engine, folder / "scene.glb");
    Scene again(*engine);
    again.add(*model);
    EXPECT_EQ(again.worldFromNode(again.findNode("head")), scene->worldFromNode(head)) << "and can be moved";
}

TEST_P(SaveDeformed, BonesThatTheProgramSetsDrawTheSamePixels) {
    const Mesh bar = *makeCylinder({ .radius = 0.3f, .height = 1, .stacks = 8 });
    const Skin skin = scene->add(SkinDesc{ .boneCount = 3 });
    RenderableDesc desc = bending(bar, VertexFormat::Float4, 3);
    desc.skin = skin;
    scene->add(desc);
    float4x4 turned(glm::rotate(double4x4(1.0), 0.7, double3(0, 0.3, 1)));
    turned[3] = { 0.2f, 0.1f, -0.3f, 1 };
    turned[1].x += 0.3f; // which no node could
    const std::array bones{ float4x4(1.0f), float4x4(1.0f), turned };
    scene->setBones(skin, bones);
    EXPECT_EQ(difference(), 0u);
}

TEST_P(SaveDeformed, MorphTargetsDrawTheSamePixels) {
    const Mesh ball = *makeUvSphere();
    std::vector<float3> wide, wideNormals, tall, tallTangents;
    for (MeshVertex const& vertex : ball.vertices) {
        wide.push_back(vertex.position * float3(1, 0, 0.1f));
        wideNormals.push_back(vertex.normal * float3(-0.3f, 0.1f, 0));
        tall.push_back(vertex.position * float3(-0.2f, 0.7f, 0));
        tallTangents.emplace_back(0, 0.1f, 0.2f);
    }
    targets.push_back(engine->own(
            engine->create(MorphTargetsDesc{ .vertexCount = static_cast<uint32_t>(ball.vertices.size()),
                                             .targets = { { .positions = wide, .normals = wideNormals },
                                                          { .positions = tall, .tangents = tallTangents } } })));
    double x = -0.9;
    for (const float weight : { 0.75f, -0.3f }) {
        RenderableDesc desc = add(ball, ball.vertexBuffer());
        desc.node = scene->add(NodeDesc{ .parentFromNode = shiftedBy({ x, 0.1, 0 }) });
        desc.morphTargets = targets.back();
        desc.morphWeights = { weight, 0.6f };
        scene->add(desc);
        x += 1.8;
    }
    EXPECT_EQ(difference(), 0u);
}

TEST_P(SaveDeformed, WeightsWithAnotherSumAreScaledWithAWarning) {
    Mesh bar = *makeCylinder({ .radius = 0.3f, .height = 1, .stacks = 8 });
    RenderableDesc desc = bending(bar, VertexFormat::Float4, 1);
    VertexBufferDesc twice = bar.vertexBuffer();
    std::vector<float> numbers;
    for (size_t i = 0; i < bar.vertices.size(); ++i) numbers.insert(numbers.end(), { 0, 1, 1, 0, 0 }); // joints are 0
    twice.streams.push_back(
            { 20,
              { { Attribute::Joints, VertexFormat::UByte4, 0 }, { Attribute::Weights, VertexFormat::Float4, 4 } },
              std::as_bytes(std::span(numbers)) });
    desc = add(bar, twice);
    desc.skin = scene->add(SkinDesc{ .boneCount = 1 });
    scene->add(desc);
    std::vector<std::string> warnings;
    difference(&warnings);
    EXPECT_THAT(warnings, Contains(HasSubstr("did not have a sum of 1 and were scaled")));
}

} // namespace
} // namespace filament_core
