// SPDX-License-Identifier: Apache-2.0
/// DeformationStage: a lit scene with spheres that follow bones or have morph targets.
///   drawOnBoth() builds the same stage on Vulkan and OpenGL ES with validation, and expects no messages and equal
///   bits.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <array>
#include <functional>
#include <vector>

namespace filament_core::test {

/// Number of bones per vertex.
enum class Joints : uint8_t { None, Four, Eight };

class DeformationStage {
public:
    explicit DeformationStage(Engine& engine) : mEngine(engine), scene(engine) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        instance = engine.own(engine.createInstance(mMaterial));
        EXPECT_TRUE(engine.set(instance, "baseColorFactor", float4(0.8f, 0.3f, 0.1f, 1)).ok());
        EXPECT_TRUE(engine.set(instance, "roughnessFactor", 0.4f).ok());
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
        view = { .camera = Camera::lookAt({ 0, 0, 5 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = { 96, 72 } };
    }

    /// `place` moves the vertices before they are uploaded.
    RenderableDesc sphere(Joints joints, std::function<float3(float3)> const& place = {}) {
        const scenes::SphereMesh mesh = scenes::makeSphere(12, 24);
        std::vector<Vertex> vertices;
        for (scenes::SphereVertex const& vertex : mesh.vertices) {
            vertices.push_back({ vertex });
            if (place) vertices.back().base.position = place(vertex.position);
            if (joints != Joints::Eight) continue;
            vertices.back().weights *= 0.5f;
            vertices.back().weights1 = float4(0.125f);
        }
        std::vector<AttributeDesc> attributes{
            { Attribute::Position, VertexFormat::Float3, offsetof(Vertex, base.position) },
            { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, base.tangents) }
        };
        if (joints != Joints::None) {
            attributes.push_back({ Attribute::Joints, VertexFormat::UByte4, offsetof(Vertex, joints) });
            attributes.push_back({ Attribute::Weights, VertexFormat::Float4, offsetof(Vertex, weights) });
        }
        if (joints == Joints::Eight) {
            attributes.push_back({ Attribute::Joints1, VertexFormat::UByte4, offsetof(Vertex, joints1) });
            attributes.push_back({ Attribute::Weights1, VertexFormat::Float4, offsetof(Vertex, weights1) });
        }
        mVertices.push_back(
                mEngine.own(mEngine.create(VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(vertices.size()),
                                                             .stride = sizeof(Vertex),
                                                             .attributes = attributes,
                                                             .data = std::as_bytes(std::span(vertices)) })));
        mIndices.push_back(
                mEngine.own(mEngine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(mesh.indices.size()),
                                                            .data = std::as_bytes(std::span(mesh.indices)) })));
        return { .vertices = mVertices.back(),
                 .indices = mIndices.back(),
                 .material = instance,
                 .bounds = Box{ double3(-1), double3(1) } };
    }

    Image draw() {
        Renderer renderer(mEngine);
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }

    Engine& engine() { return mEngine; }

private:
    /// Half weight on one bone, a quarter on a second, and the rest on two more.
    struct Vertex {
        scenes::SphereVertex base;
        std::array<uint8_t, 4> joints{ 0, 1, 2, 3 }, joints1{ 3, 2, 1, 0 };
        float4 weights{ 0.5f, 0.25f, 0.125f, 0.125f }, weights1{ 0.0f };
    };

    Engine& mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;

public:
    Owned<MaterialInstance> instance;
    Scene scene;
    View view;
};

/// The image, which both devices must draw identically and without messages.
inline Image drawOnBoth(std::function<void(DeformationStage&)> const& build) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        auto engine = makeEngine(backend);
        if (!engine) return {};
        {
            DeformationStage stage(*engine);
            build(stage);
            images.push_back(stage.draw());
        }
        expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels) << "Vulkan and OpenGL ES";
    return images[0];
}

/// Allows differences at some edge pixels: positions are rounded in a different way.
inline void expectNearlyEqual(Image const& a, Image const& b, const char* what) {
    const Difference difference = differenceOf(a, b);
    EXPECT_LE(difference.pixels, a.pixels.size() / 4 / 50) << what << ", largest " << difference.largest;
}

} // namespace filament_core::test
