// SPDX-License-Identifier: Apache-2.0
/// GltfDocument: the JSON of a glTF 2.0 file as plain structs, before any geometry or image is touched.
///   The parser has range-checked every index between elements: it is valid or kNone. Elements that are broken and that
///   the default scene does not reach (GltfUse.h) are empty. Byte ranges are not yet checked:
///   a view is checked when its buffer is loaded (GltfBuffers.h), an accessor when it is read (Accessor.h).
///   Section numbers in comments are those of the glTF 2.0.1 specification.
#pragma once

#include "filament_core/assets/gltf/AnimatedProperty.h"
#include "filament_core/assets/gltf/DracoPatience.h"
#include "filament_core/assets/gltf/GltfUse.h"
#include "filament_core/assets/gltf/ModelData.h"
#include "filament_core/assets/gltf/NodePose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

enum class ComponentType : uint8_t { Byte, UByte, Short, UShort, UInt, Float };

/// Bytes of one component.
constexpr uint32_t componentBytes(ComponentType type) {
    constexpr std::array<uint8_t, 6> kBytes{ 1, 1, 2, 2, 4, 4 };
    return kBytes[static_cast<size_t>(type)];
}

struct GltfBuffer {
    std::string uri;
    uint64_t byteLength = 0;
    bool isFallback = false; ///< EXT_meshopt_compression: may have no data
};

enum class MeshoptMode : uint8_t { Attributes, Triangles, Indices };
enum class MeshoptFilter : uint8_t { None, Octahedral, Quaternion, Exponential, Color };

/// EXT_meshopt_compression or KHR_meshopt_compression: the actual location of a view's bytes.
struct MeshoptSource {
    uint32_t buffer = kNone;
    uint64_t byteOffset = 0, byteLength = 0;
    uint64_t byteStride = 0, count = 0;
    MeshoptMode mode = MeshoptMode::Attributes;
    MeshoptFilter filter = MeshoptFilter::None;
    bool isKhr = false; ///< which of the two extensions
};

struct GltfBufferView {
    uint32_t buffer = kNone;
    uint64_t byteOffset = 0, byteLength = 0;
    uint32_t byteStride = 0; ///< 0: tightly packed
    std::optional<MeshoptSource> meshopt;
};

/// Section 3.6.2.3: `count` elements replaced at increasing indices.
struct GltfSparse {
    uint64_t count = 0;
    uint32_t indicesView = kNone, valuesView = kNone;
    uint64_t indicesOffset = 0, valuesOffset = 0;
    ComponentType indicesType = ComponentType::UShort;
};

struct GltfAccessor {
    uint32_t view = kNone; ///< kNone: zeros
    uint64_t byteOffset = 0, count = 0;
    ComponentType component = ComponentType::Float;
    uint8_t components = 1; ///< 1..4 or 16
    bool normalized = false;
    std::optional<GltfSparse> sparse;
};

/// Accessor per attribute; kNone: absent.
struct GltfAttributes {
    static constexpr uint32_t kUvSets = 4, kJointSets = 2;
    static constexpr uint32_t kFirstUvSets = 2; ///< are kept even if no map uses them
    uint32_t position = kNone, normal = kNone, tangent = kNone, color = kNone;
    uint32_t frame = kNone; ///< _FILAMENT_TANGENTS: instead of the other two, if they are there, too
    std::array<uint32_t, kUvSets> uv{ kNone, kNone, kNone, kNone }; ///< those of `uvSets` that are kept (GltfUvSets.h)
    std::array<uint32_t, kUvSets> keptSets{ 0, 1, kNone, kNone };   ///< which those are
    std::vector<uint32_t> uvSets;                                   ///< TEXCOORD_n of the file, by n
    std::array<uint32_t, kJointSets> joints{ kNone, kNone };
    std::array<uint32_t, kJointSets> weights{ kNone, kNone };

    bool operator==(GltfAttributes const&) const = default;
};

/// KHR_draco_mesh_compression: the same attributes as ids inside the compressed stream.
struct GltfDraco {
    uint32_t view = kNone;
    GltfAttributes ids;
};

enum class GltfMode : uint8_t { Points, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

struct GltfMorphTarget {
    uint32_t position = kNone, normal = kNone, tangent = kNone;
};

/// KHR_gaussian_splatting: accessors of what POSITION is not. `harmonics`: by degree and order.
struct GltfSplats {
    static constexpr uint32_t kMaxDegree = 3, kMaxHarmonics = 16;
    uint32_t rotation = kNone, scale = kNone, opacity = kNone;
    uint32_t degree = 0;
    std::array<uint32_t, kMaxHarmonics> harmonics{}; ///< (degree + 1)^2 of them
    SplatColors colors = SplatColors::Srgb;
};

struct GltfPrimitive {
    GltfAttributes attributes;
    uint32_t indices = kNone, material = kNone;
    std::vector<VariantMaterial> variants;
    GltfMode mode = GltfMode::Triangles;
    std::vector<GltfMorphTarget> targets;
    std::optional<GltfDraco> draco;
    std::optional<GltfSplats> splats;
    bool restarts = false; ///< the largest index of its type begins another strip, loop or fan
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
    std::vector<float> weights;
    std::vector<std::string> targetNames{}; ///< "extras": { "targetNames": [...] }, as exporters agreed
};

/// EXT_mesh_gpu_instancing: one transform per instance, below the node's own.
struct GltfInstancing {
    uint32_t translation = kNone, rotation = kNone, scale = kNone;
};

/// EXT_lights_ies: a photometric file. Exactly one of the two is set.
struct GltfProfile {
    std::string name, uri;
    uint32_t view = kNone;
};

/// EXT_lights_ies: what a node makes of one.
struct GltfProfiledLight {
    uint32_t profile = kNone;
    float multiplier = 1; ///< of the file's candelas
    float3 color{ 1.0f };
};

/// EXT_lights_image_based. Faces are in the order of IblDirections.h.
struct GltfImageBasedLight {
    std::string name;
    double4 rotation{ 0, 0, 0, 1 }; ///< quaternion x, y, z, w, of length 1
    float intensity = 1;
    std::array<double3, 9> irradiance{};         ///< coefficients of irradiance: l = 0, 1, 2, each with m from -l to l
    uint32_t size = 0;                           ///< texels per side of the first level: a power of two
    std::vector<std::array<uint32_t, 6>> levels; ///< images of each level
};

struct GltfNode {
    std::string name;
    double4x4 parentFromNode{ 1.0 };
    NodePose pose{};        ///< of the same transform
    bool hasMatrix = false; ///< the pose was decomposed from a matrix
    std::vector<uint32_t> children;
    uint32_t mesh = kNone, skin = kNone, light = kNone, camera = kNone;
    bool isVisible = true;             ///< KHR_node_visibility: false hides it and its descendants
    bool isSelectable = true;          ///< KHR_node_selectability, KHR_node_hoverability: false lets picks pass
    bool isHoverable = true;           ///< through it and its descendants
    bool isVisibilityAnimated = false; ///< KHR_animation_pointer: it may be shown later
    bool isCoarserLevel = false;       ///< MSFT_lod: another node is the same thing in more detail
    std::vector<uint32_t> levels;      ///< MSFT_lod: nodes that are the same thing in less detail, the finest first
    std::vector<double> coverage;      ///< MSFT_screencoverage of the node and its levels, as the file has them
    std::vector<float> weights;
    std::optional<GltfInstancing> instancing;
    std::optional<GltfProfiledLight> profiledLight;
};

struct GltfAnimationSampler {
    uint32_t input = kNone, output = kNone; ///< accessors
    Interpolation interpolation = Interpolation::Linear;
};

struct GltfAnimationChannel {
    uint32_t sampler = 0;  ///< of its animation
    uint32_t node = kNone; ///< kNone: given by an extension
    AnimationPath path = AnimationPath::Translation;
    bool isReached = false; ///< the scene has what it moves (GltfUse.h)

    // KHR_animation_pointer
    uint32_t mesh = kNone;       ///< whose weights it moves, where nodes have none of their own
    uint32_t weight = kNone;     ///< the only one that it moves; kNone: all
    AnimatedProperty property{}; ///< AnimationPath::Property; its object is an index of the file
};

struct GltfAnimation {
    std::string name;
    std::vector<GltfAnimationSampler> samplers;
    std::vector<GltfAnimationChannel> channels;
};

struct GltfSkin {
    std::string name;
    uint32_t inverseBindMatrices = kNone;
    std::vector<uint32_t> joints; ///< nodes
};

struct GltfTextureInfo {
    uint32_t texture = kNone;
    uint32_t uvSet = 0;       ///< of the file, until chooseUvSets() has made it 0 to 3
    uint32_t leftSet = kNone; ///< the set of the file, if it is not kept and another one takes its place
    float3x3 uvTransform{ 1.0f };
    bool hasTransform = false;
    UvPlacement placement{};
    bool isAnimated = false; ///< KHR_animation_pointer changes the placement
};

/// Two maps that share a texture after loading (MaterialData.h: TexturePair).
struct GltfTexturePair {
    GltfTextureInfo first, second;
};

/// `values` holds everything except the texture references, which the loader fills in from the infos.
struct GltfMaterial {
    MaterialData values;
    GltfTextureInfo baseColor, metallicRoughness, normal, occlusion, emissive, bump;
    GltfTextureInfo clearCoatNormal, anisotropy, specularGlossiness, multiscatter, light;
    GltfTexturePair clearCoat, sheen, specular, iridescence, transmission, diffuseTransmission;
};

struct GltfTexture {
    uint32_t sampler = kNone;
    uint32_t image = kNone;    ///< kNone: the file offers none, or only formats that this loader cannot read
    uint32_t openness = kNone; ///< FILAMENT_lightmap: an image whose red channel replaces alpha
};

/// Exactly one of the two is set.
struct GltfImage {
    std::string uri;
    uint32_t view = kNone;
};

struct GltfDocument {
    std::vector<GltfBuffer> buffers;
    std::vector<GltfBufferView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfSkin> skins;
    std::vector<GltfMaterial> materials;
    std::vector<GltfTexture> textures;
    std::vector<Sampler> samplers;
    std::vector<GltfImage> images;
    std::vector<LightData> lights;
    std::vector<CameraData> cameras;
    std::vector<GltfProfile> profiles;
    std::vector<std::string> variants; ///< KHR_materials_variants: their names
    std::vector<uint32_t> roots;       ///< of the default scene
    std::vector<GltfImageBasedLight> imageBasedLights;
    uint32_t imageBasedLight = kNone; ///< of the default scene
    std::vector<GltfAnimation> animations;
    GltfUse use; ///< of all arrays above

    /// Bytes of each view; filled by loadBuffers(). They point into the file or into `ownedBytes`.
    std::vector<std::span<const std::byte>> viewBytes;
    std::vector<std::vector<std::byte>> ownedBytes;

    std::shared_ptr<DracoPatience> dracoPatience = std::make_shared<DracoPatience>(); ///< with the streams of this file
};

} // namespace filament_core::assets
