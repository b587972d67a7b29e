// SPDX-License-Identifier: Apache-2.0
/// SkyStage: a square or a sphere of one material under an environment with known radiance in every direction.
///   Pictures are those of onBothApis() (MaterialStage.h): scene-linear, and the same bits on both APIs.
#pragma once

#include "filament_core/assets/environment/IblDirections.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"
#include "tests/scenes/Sphere.h"

#include <cmath>
#include <memory>

namespace filament_core::test {

/// Radiance `base` + slope * direction, the same at every roughness, and its reflection by a white diffuse surface.
struct Sky {
    float3 base{ 1 };
    float3 slope{ 0 };

    float3 radiance(float3 direction) const { return base + slope * glm::normalize(direction); }
};

inline constexpr Sky kWhiteSky{};
inline constexpr Sky kDirectionSky{ float3(0.5f), float3(0.5f) }; // shows directions as colours

/// Keeps the objects of a scene's light alive.
struct SkyObjects {
    Owned<Texture> cube;
    Owned<IndirectLight> light;

    SkyObjects(Engine& engine, Sky const& sky) {
        constexpr uint32_t kSide = 64, kLevels = 5;
        std::vector<uint16_t> texels;
        for (uint32_t level = 0; level < kLevels; ++level) {
            const uint32_t side = kSide >> level;
            for (uint32_t i = 0; i < 6 * side * side; ++i) {
                const auto x = static_cast<int>(i % side), y = static_cast<int>(i / side % side);
                const float3 direction = assets::directionFromCube(
                        { i / (side * side), assets::faceCoordinate(x, side), assets::faceCoordinate(y, side) });
                const float3 color = sky.radiance(direction);
                for (int c = 0; c < 3; ++c) texels.push_back(halfFromFloat(color[c]));
                texels.push_back(halfFromFloat(1.0f));
            }
        }
        cube = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                     .format = Format::RGBA16F,
                                                     .width = kSide,
                                                     .height = kSide,
                                                     .layers = 6,
                                                     .levels = kLevels,
                                                     .pixels = std::as_bytes(std::span(texels)) }));
        IndirectLightDesc desc{ .specular = cube, .specularLevels = kLevels };
        desc.irradianceSh[0] = float4(sky.base, 0);
        desc.irradianceSh[1].y = desc.irradianceSh[2].z = desc.irradianceSh[3].x = sky.slope.x * 2 / 3;
        light = engine.own(engine.create(desc));
    }
    SkyObjects(MaterialStage& stage, Sky const& sky) : SkyObjects(stage.engine, sky) {
        shine(stage.scene, stage.view.camera);
    }

    /// Undoes the exposure of the camera, so that pixels are radiances.
    void shine(Scene& scene, Camera const& camera) const {
        scene.setIndirectLight(light, Lux{ 1 / camera.exposure.factor() });
    }
};

inline void addSphere(MaterialStage& stage, MaterialInstance instance) {
    const scenes::SphereMesh sphere = scenes::makeSphere(24, 48);
    std::vector<StageVertex> vertices;
    for (scenes::SphereVertex const& vertex : sphere.vertices)
        vertices.push_back({ .position = vertex.position, .tangents = vertex.tangents });
    stage.add(instance, vertices, sphere.indices, double4x4(1.0));
}

/// Text of a material with this code in main() and these properties.
inline std::string text(std::string_view properties, std::string_view code) {
    return fmt::format("material {{ name : stage, {} }}\nfragment {{ void material(inout MaterialInputs material) {{\n"
                       "prepareMaterial(material);\n{}\n}} }}",
                       properties, code);
}

template <class Build>
Image underSky(Sky const& sky, Build&& build) {
    return onBothApis([&](MaterialStage& stage) {
        stage.keep(std::make_shared<SkyObjects>(stage, sky));
        build(stage);
    });
}

/// The middle of a square that looks straight at the camera.
inline float4 seenOnSquare(std::string const& material, Sky const& sky) {
    return centerPixel(underSky(sky, [&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        stage.add(stage.material(material, kNoLights), { {} });
    }));
}

inline Image seenOnSphere(std::string const& material, Sky const& sky, uint32_t side = 32) {
    return underSky(sky, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        stage.view.size = { side, side };
        stage.view.clearColor = float4(sky.base, 1);
        addSphere(stage, stage.material(material, kNoLights));
    });
}

/// The ray from the camera of seenOnSphere() through the middle of a pixel.
inline float3 directionThrough(uint32_t x, uint32_t y, uint32_t side) {
    const float half = std::tan(glm::radians(22.5f));
    const float2 at = (float2(x, y) + 0.5f) / static_cast<float>(side) * 2.0f - 1.0f;
    return glm::normalize(float3(at.x * half, -at.y * half, -1));
}

inline void expectFurnace(std::string const& material, float least) {
    const Extremes found = extremesOf(seenOnSphere(material, kWhiteSky));
    EXPECT_LE(found.most, 1.005f) << material;
    EXPECT_GE(found.least, least) << material;
}

inline void expectNear(float4 seen, float3 expected, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance) << "component " << c;
}

} // namespace filament_core::test
