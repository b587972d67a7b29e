// SPDX-License-Identifier: Apache-2.0
/// ModelData: a glTF file as plain values, ready to upload. No device, no engine.
///   Vertices are de-quantised if the GPU cannot do it, tangent frames are quaternions (MikkTSpace if the file has
///   none), colours are linear, and texture coordinates keep glTF's origin (v = 0 is the top row). The loader has
///   checked every index into the vectors: it is valid or kNone.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/math/Math.h"
#include "filament_core/assets/environment/CubeLight.h"
#include "filament_core/assets/gltf/AnimatedProperty.h"
#include "filament_core/assets/gltf/Animation.h"
#include "filament_core/assets/gltf/MaterialData.h"
#include "filament_core/assets/gltf/NodePose.h"
#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/tables/IesFile.h"
#include "filament_core/scene/SplatData.h"

#include <filament_core/Quality.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::assets {

/// What is loaded of things with levels of detail (MSFT_lod).
enum class GltfLevels : uint8_t {
    Finest, ///< nodes of coarser levels have neither meshes nor lights
    All,
};

/// What textures of normals hold besides the normals.
enum class GltfNormals : uint8_t {
    Plain,
    WithVariance, ///< alpha as image/NormalVariance.h fills it
};

/// Textures that stay blocks of BC7, if the file has all of their levels.
enum class GltfBlocks : uint8_t {
    None, ///< all are decoded
    Data, ///< not colours
    All,
};

/// Where skins and morph targets are applied.
enum class GltfDeformation : uint8_t {
    AtRest, ///< by the loader, once: the vertices are those of the rest pose
    Kept,   ///< by the device, every frame
};

/// How vertices are stored (<filament_core/Quality.h>).
struct GeometryStorage {
    PositionStorage positions = PositionStorage::AsAuthored;
    TangentStorage tangents = TangentStorage::Snorm16;
};

/// A closed box; empty if min > max.
struct BoundsData {
    float3 min{ 3e38f }, max{ -3e38f };
    void add(float3 point) { min = glm::min(min, point), max = glm::max(max, point); }
};

/// Displacements of the vertices of a primitive; an empty list: none.
struct MorphTargetData {
    std::vector<float3> positions, normals, tangents;
};

/// KHR_materials_variants: the material of a primitive in one variant of its model.
struct VariantMaterial {
    uint32_t variant = 0;  ///< into ModelData::variants
    uint32_t material = 0; ///< into ModelData::materials

    bool operator==(VariantMaterial const&) const = default;
};

/// The geometry of one draw. All attributes are interleaved in one stream.
struct PrimitiveData {
    backend::PrimitiveType topology = backend::PrimitiveType::Triangles;
    /// Buffer 0; locations of shaders/interface (position 0, tangents 1, color 2, uv0 3, uv1 4, ...). The third and the
    /// fourth set of texture coordinates are custom0.
    backend::VertexLayout layout{};
    std::vector<std::byte> vertices;
    std::vector<std::byte> indices; ///< always indexed
    backend::IndexFormat indexFormat = backend::IndexFormat::UInt16;
    uint32_t vertexCount = 0, indexCount = 0;
    uint32_t material = kNone;                   ///< kNone: glTF's default material
    std::vector<VariantMaterial> variants;       ///< replacements; at most one per variant
    float3 boundsMin{ 0.0f }, boundsMax{ 0.0f }; ///< of the stored positions
    float3 positionOffset{ 0.0f };               ///< position of the file = offset + scale * stored position
    float positionScale = 1;
    bool hasColor = false, hasUv0 = false, hasUv1 = false;
    bool hasNormals = false;  ///< tangent frames; false: the file has no normals of these points or lines
    bool hasTangents = false; ///< false: the frames of these points or lines turn about their normals as they like
    TangentBasis tangentBasis{};

    // Left to the device (GltfDeformation::Kept)
    bool isSkinned = false;               ///< vertices have joints and weights that sum to 1
    std::vector<BoundsData> boneBounds{}; ///< by joint, of the vertices that it moves; ends with the last such joint
    std::vector<MorphTargetData> morphTargets{};
    BoundsData restBounds{}; ///< in the final space of positions, with the weights and joints of the rest pose
    std::vector<float3> restPositions{}; ///< the vertices of that box, if the device deforms them; else empty

    std::shared_ptr<const scene::SplatData> splats{}; ///< KHR_gaussian_splatting: instead of vertices and indices
};

struct MeshData {
    std::string name;
    std::vector<PrimitiveData> primitives;
    std::vector<std::string> targetNames{}; ///< of morph targets, as many as the file names ("extras": "targetNames")
};

enum class LightType : uint8_t { Directional, Point, Spot };
enum class AreaShape : uint8_t { None, Rect, Disc, Tube };

/// FILAMENT_light: the image and the profile of a light as shaders read them.
struct LightTables {
    std::vector<uint32_t> image, profile; ///< shader::kImageHeaderWords, kProfileHeaderWords; empty: none
    float aspect = 1;                     ///< of the image: height over width
    float imageMeters = 10;               ///< of suns: SunLight::cookieMeters, and its offset
    float2 imageOffset{ 0.0f };
    float peak = 0, lumens = 0; ///< what the profile's file measured
};

/// KHR_lights_punctual: shines along -Z of its node. Tubes lie along its X.
struct LightData {
    std::string name;
    LightType type = LightType::Point;
    float3 color{ 1.0f };  ///< linear
    float intensity = 1;   ///< lux (directional) or candela (point, spot)
    float rangeMeters = 0; ///< 0: unlimited
    float innerConeRadians = 0, outerConeRadians = 0.7853982f;
    uint32_t profile =
            kNone; ///< EXT_lights_ies, points: into ModelData::profiles; `intensity` is then that of its peak

    // FILAMENT_light, with the defaults and ranges of <filament_core/Light.h>
    bool castsShadows = true, contactShadows = false;
    uint8_t channels = 1;
    float sourceRadiusMeters = 0; ///< points and spots
    float angularRadiusDegrees = 0.2665f;
    bool showsDisc = false; ///< suns
    float haloSize = 10, haloFalloff = 80;
    AreaShape shape = AreaShape::None; ///< `type` is what programs show that do not know areas
    float2 sizeMeters{ 0.0f };         ///< of a rectangle; a disc has its radius twice, a tube its length and radius
    float luminance = 0;               ///< nits, of areas: instead of `intensity`
    bool isTwoSided = false, isVisible = false;
    std::shared_ptr<const LightTables> tables{};
};

/// Square metres that an area light shows from where it looks largest; its candelas there are these times its nits.
inline double largestView(LightData const& light) {
    const double x{ light.sizeMeters.x }, y{ light.sizeMeters.y };
    if (light.shape == AreaShape::Disc) return 3.14159265358979323846 * x * y;
    return light.shape == AreaShape::Tube ? 2 * x * y : x * y;
}

/// Looks along -Z of its node, with +Y up (glTF 2.0, section 3.10).
struct CameraData {
    std::string name;
    bool isParallel = false;
    float verticalFovRadians = 0.7853982f; ///< perspective; in (0, pi)
    float halfHeightMeters = 1;            ///< parallel; > 0
    float nearMeters = 0.01f;              ///< > 0, or 0 if parallel
    float farMeters = 0;                   ///< parallel: > nearMeters. Perspective: not kept
    float aspect = 0;                      ///< width / height; 0: that of the view
};

/// EXT_lights_ies: forward is -Z of the node.
struct LightProfileData {
    std::string name;
    IesFile file;
};

/// EXT_lights_image_based: the surroundings of the scene.
struct ImageBasedLightData {
    std::string name;
    CubeLight light; ///< with its intensity
};

struct NodeData {
    std::string name;
    uint32_t parent = kNone; ///< into ModelData::nodes, before this one; kNone: a root
    double4x4 parentFromNode{ 1.0 };
    double4x4 worldFromNode{ 1.0 }; ///< of the rest pose: the product from the root down
    uint32_t mesh = kNone;
    uint32_t light = kNone;
    uint32_t camera = kNone;         ///< into ModelData::cameras
    uint32_t profiledLight = kNone;  ///< EXT_lights_ies: another one, also into ModelData::lights
    std::vector<float> morphWeights; ///< of the rest pose; GltfDeformation::AtRest: already applied by the loader
    uint32_t skin = kNone;           ///< into ModelData::skins; moves the skinned primitives of `mesh`
    NodePose pose{};                 ///< parentFromNode decomposed: the start of animations
    bool isVisible = true;           ///< of its own; false only where an animation may show it
    bool isSelectable = true;        ///< of its own
    bool isHoverable = true;         ///< of its own
    uint32_t visibleWith = kNone;    ///< a node of a skinned mesh: the one of the file, before this one
    bool isCoarserLevel = false;     ///< MSFT_lod: at first not shown
    uint32_t ofFile = kNone;         ///< the node of the file that it is, or whose mesh it carries
    bool carriesMesh = false;        ///< only has the mesh of `ofFile`: an instance, or a skinned mesh
};

/// MSFT_lod: a thing in several levels of detail.
struct LevelsData {
    std::vector<uint32_t> nodes; ///< into ModelData::nodes: two or more, the finest first
    /// Of each level: the smallest screen coverage (prepare/ScreenCoverage.h) of the object at which the
    /// level is shown. >= 0, and not more than that of the level before.
    std::vector<double> leastCoverage;
};

struct SkinData {
    std::string name;
    std::vector<uint32_t> joints; ///< into ModelData::nodes
    std::vector<float4x4> jointFromBind;
};

struct ModelData {
    std::string name;
    std::vector<Image> images; ///< with full mip chains; RGBA8Srgb or BC7Srgb for colours, RGBA8 or BC7 for data
    std::vector<MaterialData> materials;
    std::vector<uint32_t> materialsOfFile; ///< of each material, its place in the file; may end before them
    std::vector<MeshData> meshes;
    std::vector<NodeData> nodes;    ///< of the default scene, parents before children
    std::vector<LevelsData> levels; ///< with GltfLevels::All
    std::vector<LightData> lights;
    std::vector<CameraData> cameras;
    std::vector<LightProfileData> profiles;
    std::optional<ImageBasedLightData> imageBasedLight; ///< of the default scene
    std::vector<SkinData> skins;                        ///< with GltfDeformation::Kept
    std::vector<AnimationData> animations;              ///< with GltfDeformation::Kept
    std::vector<AnimatedProperty> animatedProperties;   ///< that channels of them change, each once
    std::vector<std::string> variants;                  ///< KHR_materials_variants: their names
    std::vector<std::string> warnings;                  ///< one line each: unsupported extensions, repaired values
};

} // namespace filament_core::assets
