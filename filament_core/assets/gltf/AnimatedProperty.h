// SPDX-License-Identifier: Apache-2.0
/// AnimatedProperty: what channels of KHR_animation_pointer change beside the poses of nodes, and how a value gets into
/// the data of a material, light or camera.
///   Sources glTF 2.0 Asset Object Model: pointers and types. Ranges are those that the parser gives the same fields.
///   Values  linear numbers; booleans are 0 or anything else. What leaves its range is clamped: cubic curves overshoot.
///   Thread  plain values; the functions are pure.   Fails: never.
#pragma once

#include "filament_core/assets/gltf/MaterialData.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

struct CameraData;
struct LightData;
struct NodeData;

enum class PropertyOwner : uint8_t { Node, Material, Light, Camera };

enum class PropertyName : uint8_t {
    NodeVisible,
    NodeSelectable,
    NodeHoverable,
    BaseColorFactor,
    MetallicFactor,
    RoughnessFactor,
    EmissiveFactor,
    EmissiveStrength,
    AlphaCutoff,
    NormalScale,
    OcclusionStrength,
    BumpFactor,
    AnisotropyStrength,
    AnisotropyRotation,
    ClearCoat,
    ClearCoatRoughness,
    ClearCoatNormalScale,
    DiffuseTransmission,
    DiffuseTransmissionColor,
    Dispersion,
    Ior,
    Iridescence,
    IridescenceIor,
    IridescenceThicknessMin,
    IridescenceThicknessMax,
    SheenColor,
    SheenRoughness,
    Specular,
    SpecularColor,
    Transmission,
    Thickness,
    AttenuationDistance,
    AttenuationColor,
    MultiscatterColor,
    ScatterAnisotropy,
    UvOffset, ///< KHR_texture_transform of AnimatedProperty::map
    UvRotation,
    UvScale,
    LightColor,
    LightIntensity,
    LightRange,
    LightInnerCone,
    LightOuterCone,
    CameraYfov,
    CameraAspect,
    CameraPerspectiveNear,
    CameraPerspectiveFar, ///< not kept: projections have no far plane
    CameraXmag,
    CameraYmag,
    CameraNear,
    CameraFar,
};

/// The maps of a material. The second map of a pair follows the first.
enum class MapName : uint8_t {
    None,
    BaseColor,
    MetallicRoughness,
    Normal,
    Occlusion,
    Emissive,
    Bump,
    ClearCoat,
    ClearCoatRoughness,
    ClearCoatNormal,
    Sheen,
    SheenRoughness,
    Specular,
    SpecularFactor,
    Anisotropy,
    Iridescence,
    IridescenceThickness,
    Transmission,
    Thickness,
    DiffuseTransmission,
    DiffuseTransmissionFactor,
    Multiscatter,
    Light,
};

struct AnimatedProperty {
    PropertyOwner owner = PropertyOwner::Node;
    PropertyName name = PropertyName::NodeVisible;
    MapName map = MapName::None;
    uint32_t object = 0; ///< into ModelData::nodes, materials, lights or cameras; kNone: nothing that the scene shows
    float4 rest{ 0.0f }; ///< the value in the file

    bool operator==(AnimatedProperty const&) const = default;
};

/// One row of the object model; `{}` stands for an index, and `{texture}` for the path of a texture.
struct PropertyRow {
    const char* pointer;
    PropertyOwner owner;
    PropertyName name;
    uint8_t width;               ///< numbers in a value
    float low, high;             ///< of each of them
    bool isDefinedAlways = true; ///< false: it has no default, so that the file must have it
};

/// Changes from one value to another, never in between.
inline bool isBoolean(PropertyName name) { return name <= PropertyName::NodeHoverable; }

std::span<const PropertyRow> propertyRows();
PropertyRow const& rowOf(PropertyName name);

/// Paths of textures below a material, as the object model writes them.
struct TexturePath {
    const char* path; ///< "pbrMetallicRoughness/baseColorTexture"
    MapName map;
};
std::span<const TexturePath> texturePaths();

/// The texture that holds the map.
TextureRef& mapOf(MaterialData& material, MapName map);

/// Keeps what the property is part of in the material, whatever its value is.
void keepProperty(MaterialData& material, PropertyName name);

float4 valueOf(NodeData const& node, PropertyName name);
float4 valueOf(MaterialData const& material, PropertyName name, MapName map);
float4 valueOf(LightData const& light, PropertyName name);
float4 valueOf(CameraData const& camera, PropertyName name);
void setValue(MaterialData& material, PropertyName name, MapName map, float4 value);
void setValue(LightData& light, PropertyName name, float4 value);
void setValue(CameraData& camera, PropertyName name, float4 value);

} // namespace filament_core::assets
