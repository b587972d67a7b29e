// SPDX-License-Identifier: Apache-2.0
/// GltfWriter: writes a generated scene as a binary glTF 2.0 file that every glTF viewer can read.
///   In      triangles with float attributes, MaterialData, LightData, PNG images, a forest of nodes.
///   Out     the bytes of a .glb: one buffer, attributes 4-byte aligned, 16-bit indices if they suffice. Materials
///           write only values that differ from glTF's defaults, and KHR_materials_unlit,
///           KHR_materials_emissive_strength, EXT_materials_bump, KHR_texture_transform, KHR_lights_punctual and
///           EXT_lights_image_based if used. The same scene gives the same bytes.
///   Thread  any.
///   Memory  twice the size of the file.
///   Fails   InvalidArgument, naming the element: an index out of range, attributes of different length, a node with
///           two parents; OutOfMemory beyond 4 GiB, the limit of the container.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

struct GlbImage {
    std::string name;
    std::vector<std::byte> file; ///< PNG or JPEG
};

enum class GlbAlpha : uint8_t {
    IfUsed, ///< no channel if it is 255 everywhere
    Always,
};

/// Encodes 8-bit RGBA pixels, row 0 at the top.
Result<GlbImage> glbImageFromPixels(std::string name, uint32_t width, uint32_t height, std::span<const std::byte> rgba8,
                                    GlbAlpha alpha = GlbAlpha::IfUsed);

/// Triangles, counter-clockwise from outside. Empty attributes are omitted.
struct GlbPrimitive {
    std::vector<float3> positions = {}, normals = {};
    std::vector<float4> tangents = {};
    std::vector<float4> colors = {}; ///< linear
    std::vector<float2> uvs = {};
    std::vector<uint32_t> indices = {}; ///< empty: vertices in order
    uint32_t material = kNone;
    bool arePoints = false;
};

struct GlbMesh {
    std::string name;
    std::vector<GlbPrimitive> primitives;
};

struct GlbNode {
    std::string name;
    double4x4 parentFromNode{ 1.0 };
    uint32_t mesh = kNone;
    uint32_t light = kNone;
    std::vector<uint32_t> children = {};
};

/// EXT_lights_image_based, see GltfEnvironment.h.
struct GlbImageBasedLight {
    std::string name = {};
    double4 rotation{ 0, 0, 0, 1 }; ///< quaternion x, y, z, w
    float intensity = 1;
    std::array<double3, 9> irradiance{};
    uint32_t size = 0;                                ///< of the images of the first level
    std::vector<std::array<uint32_t, 6>> levels = {}; ///< indices of images
};

/// The inverse of the loader, except that RGBD rounds. The images are added to `images`. Fails: InvalidArgument if
/// worldFromCube is not a rotation of the extension's cube.
Result<GlbImageBasedLight> glbImageBasedLight(CubeLight const& light, std::vector<GlbImage>& images);

struct GlbScene {
    std::string name = {};
    std::string copyright = {}; ///< asset.copyright; empty: none
    std::vector<GlbImage> images = {};
    std::vector<MaterialData> materials = {}; ///< TextureRef::image is an index into `images`
    std::vector<GlbMesh> meshes = {};
    std::vector<LightData> lights = {};
    std::optional<GlbImageBasedLight> imageBasedLight = {};
    std::vector<GlbNode> nodes = {}; ///< nodes without a parent are the scene's roots
};

Result<std::vector<std::byte>> writeGlb(GlbScene const& scene);

} // namespace filament_core::assets
