// SPDX-License-Identifier: Apache-2.0
/// One flat patch, one sun and a synthetic environment: the radiance of pixels has a closed form.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"

#include "shaders/package/EngineMaterials.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace filament_core::test {

/// The plane z = 0 between -1 and 1, normal +z, seen at an angle, with the exposure undone: pixels are radiances. The
/// sun and the environment are off until added.
class Patch {
public:
    explicit Patch(Engine& engine, double viewDegrees = 0, MaterialDesc const& material = lit())
            : scene(engine), mEngine(engine) {
        struct Vertex {
            float3 position;
            float2 uv;
            float4 tangents{ 0, 0, 0, 1 }; // no rotation: the normal is +z
        };
        const std::array<Vertex, 4> corners{ { { { -1, -1, 0 }, { 0, 0 } },
                                               { { 1, -1, 0 }, { 1, 0 } },
                                               { { -1, 1, 0 }, { 0, 1 } },
                                               { { 1, 1, 0 }, { 1, 1 } } } };
        const std::array<uint16_t, 6> indices{ 0, 1, 2, 2, 1, 3 };
        mVertices = engine.own(engine.create(VertexBufferDesc{
                .vertexCount = 4,
                .stride = sizeof(Vertex),
                .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                { Attribute::Uv0, VertexFormat::Float2, offsetof(Vertex, uv) },
                                { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, tangents) } },
                .data = std::as_bytes(std::span(corners)) }));
        mIndices = engine.own(
                engine.create(IndexBufferDesc{ .indexCount = 6, .data = std::as_bytes(std::span(indices)) }));
        mMaterial = engine.own(*engine.create(material));
        mInstance = engine.own(engine.createInstance(mMaterial, "patch"));
        renderable = add(mInstance, double3(0));
        const double angle = viewDegrees * std::numbers::pi / 180;
        view.camera = Camera::lookAt({ 40 * std::sin(angle), 0, 40 * std::cos(angle) }, { 0, 0, 0 },
                                     { .verticalFovDegrees = 0.5f });
        view.size = { 16, 16 };
    }

    static MaterialDesc lit() { return { .package = shader::engineMaterial("gltf_lit_opaque") }; }

    /// Another patch with its own centre and material.
    Renderable add(MaterialInstance material, double3 center) {
        double4x4 world(1.0);
        world[3] = double4(center, 1);
        return scene.add({ .vertices = mVertices,
                           .indices = mIndices,
                           .material = material,
                           .bounds = Box{ double3(-1), double3(1) },
                           .worldFromObject = world });
    }

    void setSurface(float4 baseColor, float metallic, float roughness) {
        EXPECT_TRUE(mEngine.set(mInstance, "baseColorFactor", baseColor));
        EXPECT_TRUE(mEngine.set(mInstance, "metallicFactor", metallic));
        EXPECT_TRUE(mEngine.set(mInstance, "roughnessFactor", roughness));
    }

    /// Pre-exposed illuminance pi, so that a white Lambert surface facing the sun has radiance 1.
    void addSun(float3 towardsSun) {
        scene.add(SunLight{ .directionWorld = -towardsSun,
                            .illuminance = Lux{ std::numbers::pi_v<float> / view.camera.exposure.factor() } });
    }

    /// Radiance `level + 1` in specular level `level`, of `levels`; irradiance / pi from the coefficients.
    void addEnvironment(std::array<float4, 9> const& irradianceSh, uint32_t levels = 3,
                        RoughnessMapping mapping = RoughnessMapping::Quadratic, Texture irradiance = {}) {
        std::vector<uint16_t> texels;
        for (uint32_t level = 0; level < levels; ++level) {
            const uint32_t side = 1u << (levels - 1 - level);
            texels.insert(texels.end(), size_t{ 6 } * side * side * 4, halfFromFloat(static_cast<float>(level + 1)));
        }
        mCube = mEngine.own(mEngine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                        .format = Format::RGBA16F,
                                                        .width = 1u << (levels - 1),
                                                        .height = 1u << (levels - 1),
                                                        .layers = 6,
                                                        .levels = levels,
                                                        .pixels = std::as_bytes(std::span(texels)) }));
        IndirectLightDesc light{
            .specular = mCube, .specularLevels = levels, .mapping = mapping, .irradiance = irradiance
        };
        light.irradianceSh = irradianceSh;
        mLight = mEngine.own(mEngine.create(light));
        scene.setIndirectLight(mLight, Lux{ 1 / view.camera.exposure.factor() });
    }

    Image render() { return renderLinear(mEngine, scene, view); }
    MaterialInstance instance() const { return mInstance; }
    float3 renderCenter() { return float3(halfPixel(render(), 8, 8)); }

    Scene scene;
    View view;
    Renderable renderable;

private:
    Engine& mEngine;
    Owned<Texture> mCube;
    Owned<IndirectLight> mLight;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
};

} // namespace filament_core::test
