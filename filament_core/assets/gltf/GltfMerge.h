// SPDX-License-Identifier: Apache-2.0
/// GltfMerge: copies of glTF files, and what a program added to them, as one glTF 2.0 file.
///   In      sources: whole .gltf or .glb files, and where they find what they name. Copies of them: their nodes and
///           skins, once for each copy; all else, once for each source. Nodes of a scene, which say what differs from
///           the files. New meshes, materials, images and lights.
///   Out     the JSON and one buffer. What comes from a source keeps its bytes: attributes, also compressed ones,
///           images, animations, extensions known or not, extras, and the digits of its numbers as doubles. So a loader
///           makes of it the bits that it makes of the source. Indices are moved, image files become parts of the
///           buffer, variants of equal names become one.
///   Thread  any.
///   Memory  the sources, and twice the result.
///   Fails   errors of reading a source, with its name; Unsupported: a .glb beyond 4 GiB.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/gltf/GltfWriter.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::assets {

struct GltfMergeSource {
    std::string name;
    std::vector<std::byte> file; ///< .gltf or .glb
    GltfFolder folder{ {} };
};

/// A value of a material by its JSON pointer below the material: "pbrMetallicRoughness/baseColorFactor".
struct GltfMergeValue {
    std::string pointer;
    std::vector<double> numbers; ///< one: a number; more: a list
    bool isBoolean = false;      ///< true or false instead of the number
};

/// A material with other values than in its source, or a new one.
struct GltfMergeMaterial {
    uint32_t source = kNone, material = kNone; ///< of a source; kNone: `data`
    MaterialData data{};                       ///< TextureRef::image is an index into GltfMerge::images
    std::vector<GltfMergeValue> values{};
    std::vector<std::pair<std::string, TextureRef>>
            textures{}; ///< in the place of others, by the pointers of their infos
};

/// An attribute of a new primitive as its bytes, one element for each position.
struct GltfMergeAttribute {
    std::string name; ///< "JOINTS_0"
    std::vector<std::byte> bytes;
    uint32_t component = 5126; ///< as glTF numbers them; every element has four of them
    bool isNormalized = false;
};

struct GltfMergePrimitive {
    uint32_t primitive = kNone;                   ///< of the source; kNone: `own`
    std::optional<uint32_t> material{};           ///< into GltfMerge::materials; none: that of the source, or none
    std::optional<uint32_t> ofFile{};             ///< another material of the same source; kNone: the default one
    GlbPrimitive own{};                           ///< without its material
    std::vector<GltfMergeAttribute> attributes{}; ///< beside those of `own`
    std::vector<MorphTargetData> targets{};       ///< of `own`; all primitives of a mesh have as many
    uint32_t mode = 4;                            ///< of `own`, as glTF numbers them: 4 are triangles
};

/// A mesh with other primitives or materials than in its source, or a new one.
struct GltfMergeMesh {
    std::string name;
    uint32_t source = kNone, mesh = kNone;
    uint32_t primitiveCount = 0; ///< of the source, as the program has them
    std::vector<GltfMergePrimitive> primitives;
};

struct GltfMergeSkin {
    std::vector<uint32_t> joints; ///< into GltfMerge::nodes, each once
    std::vector<float4x4> jointFromBind;
};

struct GltfMergeCamera {
    CameraData data;
    double4x4 worldFromCamera{ 1.0 };
};

struct GltfMergeNode {
    uint32_t copy = kNone, node = kNone;         ///< of a file: what is not said here is that of the file
    std::string name{};                          ///< of a new node
    std::optional<double4x4> transform{};        ///< parentFromNode; none: that of the file, or the identity
    std::vector<uint32_t> children{};            ///< into GltfMerge::nodes: all of them
    bool losesMesh = false;                      ///< of the file, with skin and instances
    uint32_t mesh = kNone;                       ///< into GltfMerge::meshes; replaces that of the file
    uint32_t skinOf = kNone;                     ///< a node of the same copy whose skin and weights it has
    uint32_t meshOf = kNone;                     ///< a node of the same copy whose mesh of the file it has
    uint32_t skin = kNone;                       ///< into GltfMerge::skins, of a new node
    std::optional<std::vector<float>> weights{}; ///< of morph targets
    bool losesLights = false;                    ///< of the file
    uint32_t light = kNone;                      ///< into GltfMerge::lights
    bool isHidden = false;                       ///< KHR_node_visibility
};

struct GltfMerge {
    std::string copyright{}, generator = "filament_core";
    std::vector<GltfMergeSource> sources{};
    std::vector<uint32_t> copies{}; ///< the source of each
    std::vector<GlbImage> images{}; ///< new ones
    std::vector<GltfMergeMaterial> materials{};
    std::vector<GltfMergeMesh> meshes{};
    std::vector<LightData> lights{};
    std::vector<GltfMergeSkin> skins{};
    std::vector<GltfMergeCamera> cameras{};
    std::vector<GltfMergeNode> nodes{};
    std::vector<uint32_t> roots{};       ///< into `nodes`
    bool keepsEnvironment = false;       ///< EXT_lights_image_based of the first source
    std::string extras{};                ///< of the scene: JSON text of an object; empty: none
    std::vector<std::string> warnings{}; ///< what could not be written
};

struct GltfMerged {
    std::string json; ///< `buffers[0]`, if there is data, has no uri
    std::vector<std::byte> buffer;
    std::vector<std::string> warnings;
};

/// `bufferUri`: of the first buffer; empty: it is that of a .glb.
Result<GltfMerged> mergeGltf(GltfMerge const& merge, std::string_view bufferUri = {});

/// As a .glb.
Result<std::vector<std::byte>> glbOf(GltfMerged const& merged);

} // namespace filament_core::assets
