// SPDX-License-Identifier: Apache-2.0
/// Materials from their text, and an image that one of them fills.
#pragma once

#include "tests/filament_core/engine/CompiledMaterials.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace filament_core::test {

inline Owned<Material> loadMaterial(Engine& engine, std::string_view text, std::vector<MaterialConstant> constants = {},
                                    uint16_t filteredVariants = 0) {
    auto material = engine.create(
            MaterialDesc{ .package = compiledPackage(text, filteredVariants), .constants = std::move(constants) });
    if (material) return engine.own(*material);
    ADD_FAILURE() << material.error().message;
    return {};
}

/// A square of 2 x 2 metres in the plane z = 0 around the origin, its front towards +z; position, tangents and uv0.
class SquareMesh {
public:
    explicit SquareMesh(Engine& engine) {
        struct Vertex {
            float3 position;
            float4 tangents;
            float2 uv;
        };
        constexpr float4 kUpright{ 0, 0, 0, 1 };
        const std::array<Vertex, 4> vertices{ { { { -1, -1, 0 }, kUpright, { 0, 1 } },
                                                { { 1, -1, 0 }, kUpright, { 1, 1 } },
                                                { { 1, 1, 0 }, kUpright, { 1, 0 } },
                                                { { -1, 1, 0 }, kUpright, { 0, 0 } } } };
        constexpr std::array<uint16_t, 6> kIndices{ 0, 1, 2, 0, 2, 3 };
        mVertices = engine.own(engine.create(VertexBufferDesc{
                .vertexCount = 4,
                .stride = sizeof(Vertex),
                .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, tangents) },
                                { Attribute::Uv0, VertexFormat::Float2, offsetof(Vertex, uv) } },
                .data = std::as_bytes(std::span(vertices)),
                .name = "square" }));
        mIndices = engine.own(engine.create(
                IndexBufferDesc{ .indexCount = 6, .data = std::as_bytes(std::span(kIndices)), .name = "square" }));
    }

    Renderable add(Scene& scene, MaterialInstance material, double3 at = {}, double scale = 1) const {
        double4x4 world(scale);
        world[3] = double4(at, 1);
        return add(scene, material, world);
    }

    Renderable add(Scene& scene, MaterialInstance material, double4x4 const& world) const {
        return scene.add({ .vertices = mVertices,
                           .indices = mIndices,
                           .material = material,
                           .bounds = Box{ double3(-1, -1, -0.01f), double3(1, 1, 0.01f) },
                           .worldFromObject = world });
    }

    VertexBuffer vertices() const { return mVertices; }
    IndexBuffer indices() const { return mIndices; }

    /// The square fills the image.
    static View view(uint2 size = { 16, 16 }) {
        return { .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 80 }), .size = size };
    }

private:
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
};

/// An engine with one material and a square; it must report no errors until it ends.
struct SquareStage {
    std::shared_ptr<backend::FrameCapture> capture;
    Engine engine;
    SquareMesh square{ engine };
    Owned<Material> material;
    Owned<MaterialInstance> instance;

    SquareStage(Backend backend, std::string_view text, std::shared_ptr<backend::FrameCapture> captures = {})
            : capture(std::move(captures)), engine(open(backend, capture)), material(loadMaterial(engine, text)),
              instance(engine.own(engine.createInstance(material))) {}
    ~SquareStage() { expectNoErrors(engine); }

private:
    static Engine open(Backend backend, std::shared_ptr<backend::FrameCapture> const& capture) {
        EngineOptions options{ .backend = backend, .workers = 1, .validation = true };
        options.debug.capture = capture;
        return std::move(*Engine::create(options));
    }
};

/// The pixel in the middle of an image of the square, scene-linear.
inline float4 shownBy(Engine& engine, MaterialInstance material) {
    const SquareMesh square(engine);
    Scene scene(engine);
    square.add(scene, material);
    const Image image = renderLinear(engine, scene, SquareMesh::view());
    return image.pixels.empty() ? float4(-1) : halfPixel(image, 8, 8);
}

} // namespace filament_core::test
