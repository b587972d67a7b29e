// SPDX-License-Identifier: Apache-2.0
// Skins of any number of bones: pictures and motion equal, bit for bit, those of a mesh whose vertices the CPU moved.
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cstring>
#include <vector>

namespace filament_core::large_skins {
namespace {

constexpr const char* kColored =
        R"(material { name : colored, shadingModel : unlit, culling : none, requires : [ color ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = getColor(); } })";
constexpr uint32_t kTriangles = 60;
const float3 kStep(0.0625f, -0.03125f, 0); // metres a frame

/// Where a bone moves its vertices: sums of such numbers are exact.
float3 placeOf(uint32_t bone, uint32_t rig) {
    const auto part = [&](uint32_t factor, uint32_t count) {
        return static_cast<float>((bone * factor + rig * 5) % count) / 32 - static_cast<float>(count) / 64;
    };
    return { part(7, 40), part(11, 28), part(13, 16) };
}

struct Vertex {
    float3 position;
    float4 color{ 1 };
    glm::u16vec4 joints{ 0 };
    float4 weights{ 1, 0, 0, 0 };
};

/// Triangles, each with a corner at the first bone, one at any, and one between any and the last one.
std::vector<Vertex> trianglesOf(uint32_t bones) {
    std::vector<Vertex> vertices;
    for (uint32_t i = 0; i < kTriangles; ++i) {
        const auto middle = static_cast<uint16_t>(uint64_t{ i } * (bones - 1) / (kTriangles - 1));
        const auto last = static_cast<uint16_t>(bones - 1);
        const float4 color(static_cast<float>(i % 7) / 7, static_cast<float>(i % 5) / 5, static_cast<float>(i % 3) / 3,
                           1);
        const float3 corner(static_cast<float>(i % 10) / 4 - 1.25f, static_cast<float>(i / 10) / 4 - 0.75f, 0);
        vertices.push_back({ .position = corner, .color = color });
        vertices.push_back({ .position = corner + float3(0.25f, 0, 0), .color = color, .joints = { middle, 0, 0, 0 } });
        vertices.push_back({ .position = corner + float3(0, 0.25f, 0),
                             .color = color,
                             .joints = { middle, last, 0, 0 },
                             .weights = { 0.5f, 0.5f, 0, 0 } });
    }
    return vertices;
}

std::vector<Vertex> movedByBones(std::vector<Vertex> vertices, uint32_t rig) {
    for (Vertex& vertex : vertices) {
        float3 way(0);
        for (int k = 0; k < 2; ++k) way += vertex.weights[k] * placeOf(vertex.joints[k], rig);
        vertex.position += way;
    }
    return vertices;
}

enum class Posed { OnDevice, Before };

/// Rigs, each with a number of bones, and all moving by kStep in each frame.
class Stage {
public:
    Stage(Backend backend, std::vector<uint32_t> bones, Posed posed)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mBones(std::move(bones)), mPosed(posed) {
        mMaterial = test::loadMaterial(engine, kColored);
        mInstance = engine.own(engine.createInstance(mMaterial));
        view = { .camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = { 96, 72 } };
        view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        for (uint32_t rig = 0; rig < mBones.size(); ++rig) addRig(rig);
    }
    ~Stage() { test::expectNoErrors(engine); }

    void move(float steps) {
        for (uint32_t rig = 0; rig < mBones.size(); ++rig) {
            if (mPosed == Posed::Before) {
                scene.setTransform(mRenderables[rig], double4x4(glm::translate(float4x4(1), kStep * steps)));
                continue;
            }
            std::vector<float4x4> bones;
            for (uint32_t i = 0; i < mBones[rig]; ++i)
                bones.push_back(glm::translate(float4x4(1), placeOf(i, rig) + kStep * steps));
            scene.setBones(mSkins[rig], bones);
        }
    }

    Image draw() {
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;

private:
    void addRig(uint32_t rig) {
        std::vector<Vertex> vertices = trianglesOf(mBones[rig]);
        if (mPosed == Posed::Before) vertices = movedByBones(std::move(vertices), rig);
        std::vector<uint16_t> indices(vertices.size());
        for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint16_t>(i);
        mVertices.push_back(engine.own(engine.create(VertexBufferDesc{
                .vertexCount = static_cast<uint32_t>(vertices.size()),
                .stride = sizeof(Vertex),
                .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(Vertex, position) },
                                { Attribute::Color, VertexFormat::Float4, offsetof(Vertex, color) },
                                { Attribute::Joints, VertexFormat::UShort4, offsetof(Vertex, joints) },
                                { Attribute::Weights, VertexFormat::Float4, offsetof(Vertex, weights) } },
                .data = std::as_bytes(std::span(vertices)) })));
        mIndices.push_back(engine.own(engine.create(IndexBufferDesc{
                .indexCount = static_cast<uint32_t>(indices.size()), .data = std::as_bytes(std::span(indices)) })));
        RenderableDesc desc{ .vertices = mVertices.back(), .indices = mIndices.back(), .material = mInstance };
        desc.culled = false;
        if (mPosed == Posed::OnDevice) {
            mSkins.push_back(scene.add(SkinDesc{ .boneCount = mBones[rig] }));
            desc.skin = mSkins.back();
        }
        mRenderables.push_back(scene.add(desc));
    }

    std::vector<uint32_t> mBones;
    Posed mPosed;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;
    std::vector<Skin> mSkins;
    std::vector<Renderable> mRenderables;
};

/// A still picture, and one of the motion between two frames.
std::array<Image, 2> drawn(Backend backend, std::vector<uint32_t> const& bones, Posed posed) {
    Stage stage(backend, bones, posed);
    stage.move(0);
    Image still = stage.draw();
    stage.view.debugView = DebugView::Motion;
    for (const float steps : { 1.0f, 2.0f }) {
        stage.move(steps);
        if (steps == 1) stage.draw();
    }
    return { std::move(still), stage.draw() };
}

/// That differ from the upper left one.
size_t shownPixels(Image const& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 4)
        count += std::memcmp(&image.pixels[i], image.pixels.data(), 4) != 0;
    return count;
}

void expectAsPosed(std::vector<uint32_t> const& bones) {
    const std::array<Image, 2> expected = drawn(Backend::Vulkan, bones, Posed::Before);
    EXPECT_GT(shownPixels(expected[0]), 200u) << "something is seen";
    EXPECT_GT(shownPixels(expected[1]), 200u) << "something moves";
    for (const Backend backend : test::kBothApis) {
        const std::array<Image, 2> actual = drawn(backend, bones, Posed::OnDevice);
        EXPECT_TRUE(actual[0].pixels == expected[0].pixels) << toString(backend) << ": still";
        EXPECT_TRUE(actual[1].pixels == expected[1].pixels) << toString(backend) << ": motion";
    }
}

TEST(LargeSkins, OfAnyNumberOfBonesDrawWhatTheCpuWouldMove) {
    for (const uint32_t bones : { 1u, 255u, 256u, 257u, 300u, 513u, 1000u, 5000u, 65536u }) {
        SCOPED_TRACE(std::to_string(bones) + " bones");
        expectAsPosed({ bones });
    }
}

// Their bones lie behind each other, across the rows of a texture.
TEST(LargeSkins, ManyInOneFrameDoNotMixUpTheirBones) { expectAsPosed({ 300, 1, 257, 1024, 40, 2000 }); }

// A texture of bones that grew between frames belongs to new bind groups.
TEST(LargeSkins, BonesMayBecomeMoreFromFrameToFrame) {
    for (const Backend backend : test::kBothApis) {
        Stage stage(backend, { 4, 3000 }, Posed::OnDevice);
        stage.move(0);
        const Image expected = stage.draw();
        Stage grown(backend, { 4, 3000 }, Posed::OnDevice);
        grown.move(0);
        grown.view.visibleLayers = 0;
        grown.draw();
        grown.view.visibleLayers = stage.view.visibleLayers;
        EXPECT_EQ(grown.draw().pixels, expected.pixels) << toString(backend);
    }
}

TEST(LargeSkins, AFileWith300JointsMovesItsLastOne) {
    using assets::hasFaultFiles;
    SKIP_WITHOUT_FAULT_FILES();
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        Result<Model> model = loadGltf(*engine, assets::faultFile("skin_300_joints.glb"));
        ASSERT_TRUE(model.ok()) << model.error().message;
        Scene scene(*engine);
        const Node root = scene.add(*model);
        Animator animator(*model, scene, root);
        Renderer renderer(*engine);
        const View view{ .camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }),
                         .size = { 96, 72 } };
        for (const double seconds : { 0.0, 1.0 }) {
            animator.apply(0, seconds);
            images.push_back(renderer.renderToImage(scene, view).value());
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[2].pixels);
    EXPECT_EQ(images[1].pixels, images[3].pixels);
    EXPECT_GT(test::differenceOf(images[0], images[1]).pixels, 50u) << "the joint moves by half a metre";
}

} // namespace
} // namespace filament_core::large_skins
