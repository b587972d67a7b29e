// SPDX-License-Identifier: Apache-2.0
/// MaterialStage: an engine with materials from .mat text and a few meshes, for images whose colours are known.
///   onBothApis() builds the same stage on Vulkan and OpenGL ES with validation, expects no errors and equal bits, and
///   returns the image: scene-linear half floats.
#pragma once

#include "tests/filament_core/engine/CompiledMaterials.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <array>
#include <vector>

namespace filament_core::test {

struct StageVertex {
    float3 position{ 0 };
    float4 tangents{ 0, 0, 0, 1 }; ///< the frame of a plane that looks at +z
    float4 color{ 1 };
    float2 uv{ 0 };
};

/// A square around the z axis that covers the whole image, of one colour.
struct Square {
    float z = 0;
    float4 color{ 1 };
    bool facesCamera = true;
    float halfSide = 8;
};

class MaterialStage {
public:
    explicit MaterialStage(Engine& stageEngine) : engine(stageEngine), scene(stageEngine) {
        view.camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        view.size = { 8, 8 };
        view.clearColor = float4(0, 0, 0, 1);
    }

    /// None, and a test failure, if the text does not compile. Filter variants that a test does not need: they only
    /// take time.
    MaterialInstance material(std::string_view text, uint16_t filteredVariants = kNoShadows) {
        Result<Material> material = engine.create(MaterialDesc{ .package = compiledPackage(text, filteredVariants) });
        if (!material) {
            ADD_FAILURE() << material.error().message;
            return {};
        }
        return keep(*material);
    }

    /// An instance of a material that the stage owns from now on.
    MaterialInstance keep(Material material) {
        mMaterials.push_back(engine.own(material));
        mInstances.push_back(engine.own(engine.createInstance(material)));
        return mInstances.back();
    }

    /// One renderable; its squares are drawn in this order.
    Renderable add(MaterialInstance instance, std::vector<Square> const& squares, double4x4 const& world = double4x4(1),
                   uint32_t instanceIndex = 0) {
        return scene.add(describe(instance, squares, world, instanceIndex));
    }

    RenderableDesc describe(MaterialInstance instance, std::vector<Square> const& squares,
                            double4x4 const& world = double4x4(1), uint32_t instanceIndex = 0) {
        std::vector<StageVertex> vertices;
        std::vector<uint16_t> indices;
        for (Square const& square : squares) {
            const auto first = static_cast<uint16_t>(vertices.size());
            for (const float2 corner : { float2(0, 0), float2(1, 0), float2(1, 1), float2(0, 1) }) {
                const float2 at = (corner * 2.0f - 1.0f) * square.halfSide;
                vertices.push_back({ .position = float3(at, square.z), .color = square.color, .uv = corner });
            }
            for (const int corner : { 0, 1, 2, 0, 2, 3 })
                indices.push_back(static_cast<uint16_t>(first + (square.facesCamera ? corner : 3 - corner)));
        }
        return describe(instance, vertices, indices, world, instanceIndex);
    }

    Renderable add(MaterialInstance instance, std::vector<StageVertex> const& vertices,
                   std::vector<uint16_t> const& indices, double4x4 const& world) {
        return scene.add(describe(instance, vertices, indices, world, 0));
    }

    RenderableDesc describe(MaterialInstance instance, std::vector<StageVertex> const& vertices,
                            std::vector<uint16_t> const& indices, double4x4 const& world, uint32_t instanceIndex) {
        using enum Attribute;
        constexpr auto kCustom5 = static_cast<Attribute>(static_cast<int>(Custom0) + 5);
        mVertices.push_back(engine.own(engine.create(
                VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(vertices.size()),
                                  .stride = sizeof(StageVertex),
                                  .attributes = { { Custom0, VertexFormat::Float4, offsetof(StageVertex, color) },
                                                  { kCustom5, VertexFormat::Float2, offsetof(StageVertex, uv) },
                                                  { Position, VertexFormat::Float3, offsetof(StageVertex, position) },
                                                  { Tangents, VertexFormat::Float4, offsetof(StageVertex, tangents) },
                                                  { Color, VertexFormat::Float4, offsetof(StageVertex, color) },
                                                  { Uv0, VertexFormat::Float2, offsetof(StageVertex, uv) } },
                                  .data = std::as_bytes(std::span(vertices)),
                                  .name = "stage" })));
        mIndices.push_back(
                engine.own(engine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(indices.size()),
                                                          .data = std::as_bytes(std::span(indices)),
                                                          .name = "stage" })));
        return { .vertices = mVertices.back(),
                 .indices = mIndices.back(),
                 .material = instance,
                 .bounds = Box{ double3(-8), double3(8) },
                 .worldFromObject = world,
                 .instanceIndex = instanceIndex };
    }

    /// Lives as long as the scene.
    void keep(std::shared_ptr<void> object) { mKept.push_back(std::move(object)); }

    Texture own(Texture texture) {
        mTextures.push_back(engine.own(texture));
        return texture;
    }

    Engine& engine;
    View view;

private:
    std::vector<std::shared_ptr<void>> mKept;
    std::vector<Owned<Texture>> mTextures;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;

public:
    Scene scene; ///< destroyed before the objects it shows
};

/// build(MaterialStage&) puts things on the stage.
template <class Build>
Image onBothApis(Build&& build) {
    std::array<Image, 2> pictures;
    for (size_t i = 0; i < pictures.size(); ++i) {
        auto engine = makeEngine(kBothApis[i]);
        if (!engine) return {};
        MaterialStage stage(*engine);
        build(stage);
        pictures[i] = renderLinear(*engine, stage.scene, stage.view);
        expectNoErrors(*engine);
    }
    EXPECT_FALSE(pictures[0].pixels.empty());
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels) << "not the same bits on both APIs";
    return pictures[0];
}

inline float4 centerPixel(Image const& image) { return halfPixel(image, image.width / 2, image.height / 2); }

} // namespace filament_core::test
