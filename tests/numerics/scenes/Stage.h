// SPDX-License-Identifier: Apache-2.0
/// Stage: what a row of the hard cases builds its scene on. One Device for each API and program, one Stage for each
/// image.
///   In      looks and shapes by name.  Out: a Picture, scene-linear and as displayed.
///   Thread  the app thread. Memory: the stage owns what its scene draws, until the end of its life.
///   Fails   a device that is missing is a test failure with its reason.
#pragma once

#include "tests/numerics/scenes/Picture.h"

#include <filament_core/filament_core.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::hard {

struct Vertex {
    float3 position{ 0 };
    float4 tangents{ 0, 0, 0, 1 }; ///< quaternion of the frame: this one has its normal at +z
    float2 uv{ 0 };
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<uint16_t> indices;
};

/// Unit sphere at the origin.
Mesh sphereMesh();
/// [-1, 1]^2 at z = 0, looking along +z.
Mesh quadMesh();
Mesh transformed(Mesh mesh, float3 scale); ///< positions only, component by component

struct Look {
    float4 baseColor{ 0.8f, 0.8f, 0.8f, 1 };
    float metallic = 0;
    float roughness = 0.5f;
    float3 emissive{ 0 };
    bool blended = false;
    bool bumpy = false; ///< with a normal map of waves: needs tangents and texture coordinates
};
inline const Look kRed{ .baseColor = { 0.9f, 0.05f, 0.05f, 1 } }, kBlue{ .baseColor = { 0.05f, 0.05f, 0.9f, 1 } };

/// An engine with everything that all stages share: materials compile once.
class Device {
public:
    explicit Device(Backend backend);
    Engine& engine() { return *mEngine; }
    explicit operator bool() const { return mEngine.has_value(); }
    Material material(Look const& look) const;
    Texture waves() const { return mWaves; }
    backend::FrameCapture& capture() { return *mCapture; }

private:
    std::shared_ptr<backend::FrameCapture> mCapture;
    std::optional<Engine> mEngine;
    Owned<Material> mOpaque, mBlended, mBumpy;
    Owned<Texture> mWaves;
};

class Stage {
public:
    explicit Stage(Device& device);

    Scene scene;
    View view; ///< 64 x 64, what nothing covers has alpha 0

    Renderable add(Mesh const& mesh, double4x4 const& worldFromObject = double4x4(1.0), Look const& look = {},
                   Node node = {});
    /// The bytes of a .glb, loaded as an app would. One at a time per test program.
    void addFile(std::span<const std::byte> glb);
    /// The same radiance from everywhere; `illuminance` is what a surface receives of it, times 1 / pi.
    void addConstantSky(Lux illuminance, float radiance = 1, bool visible = false);
    Engine& engine() { return mDevice.engine(); }

    Picture take();

private:
    Texture constantCube(float radiance);

    Device& mDevice;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::vector<Owned<Texture>> mTextures;
    std::vector<Owned<IndirectLight>> mLights;
    std::vector<Owned<Skybox>> mSkies;
    std::vector<Model> mModels;
};

double4x4 translation(double3 by);
double4x4 scaling(double3 by);

} // namespace filament_core::hard
