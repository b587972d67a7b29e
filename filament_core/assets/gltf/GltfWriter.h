// SPDX-License-Identifier: Apache-2.0
/// GltfWriter: a scene made by code as a binary glTF 2.0 file, readable by every glTF viewer.
///   In      triangles with float attributes, MaterialData, LightData, PNG images, a forest of nodes.
///   Out     the bytes of a .glb: one buffer, attributes 4-byte aligned, 16-bit indices where they suffice. Materials
///           write what differs from glTF's defaults, and KHR_materials_unlit, KHR_materials_emissive_strength,
///           KHR_texture_transform and KHR_lights_punctual where they are used. The same scene gives the same bytes.
///   Thread  any.
///   Memory  the file twice.
///   Fails   InvalidArgument, naming the element: an index out of range, attributes of different length, a node with
///           two parents; OutOfMemory beyond 4 GiB, which the container cannot hold.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <span>
#include <string>
#include <vector>

namespace filament::assets {

struct GlbImage {
    std::string name;
    std::vector<std::byte> file; ///< PNG or JPEG
};

/// Encodes 8-bit RGBA pixels, row 0 at the top; without the alpha channel if all of it is 255.
Result<GlbImage> glbImageFromPixels(std::string name, uint32_t width, uint32_t height,
                                    std::span<const std::byte> rgba8);

/// Triangles, counter-clockwise from outside. Empty attributes are left out.
struct GlbPrimitive {
    std::vector<float3> positions = {}, normals = {};
    std::vector<float4> tangents = {};
    std::vector<float4> colors = {}; ///< linear
    std::vector<float2> uvs = {};
    std::vector<uint32_t> indices = {}; ///< empty: vertices in order
    uint32_t material = kNone;
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

struct GlbScene {
    std::string name = {};
    std::string copyright = {}; ///< asset.copyright; empty: none
    std::vector<GlbImage> images = {};
    std::vector<MaterialData> materials = {}; ///< TextureRef::image counts in `images`
    std::vector<GlbMesh> meshes = {};
    std::vector<LightData> lights = {};
    std::vector<GlbNode> nodes = {}; ///< those that are nobody's child are the scene's roots
};

Result<std::vector<std::byte>> writeGlb(GlbScene const& scene);

} // namespace filament::assets
