// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/AnimatedProperty.h"

#include "base/Assert.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace filament_core::assets {
namespace {

using enum PropertyName;
constexpr PropertyOwner kNode = PropertyOwner::Node, kMaterial = PropertyOwner::Material, kLight = PropertyOwner::Light,
                        kCamera = PropertyOwner::Camera;
constexpr float kFloats = std::numeric_limits<float>::max(), kHalfs = 65504, kHalfPi = 1.57079633f;
constexpr float kLargestMeters = 1e30f, kSmallest = 1e-30f, kNarrowestCone = 1e-3f;

#define EXTENSION "/materials/{}/extensions/KHR_materials_"
#define TRANSFORM "/materials/{}/{texture}/extensions/KHR_texture_transform/"
#define LIGHT "/extensions/KHR_lights_punctual/lights/{}/"

constexpr std::array kRows{
    PropertyRow{ "/nodes/{}/extensions/KHR_node_visibility/visible", kNode, NodeVisible, 1, 0, kFloats },
    PropertyRow{ "/nodes/{}/extensions/KHR_node_selectability/selectable", kNode, NodeSelectable, 1, 0, kFloats },
    PropertyRow{ "/nodes/{}/extensions/KHR_node_hoverability/hoverable", kNode, NodeHoverable, 1, 0, kFloats },
    PropertyRow{ "/materials/{}/pbrMetallicRoughness/baseColorFactor", kMaterial, BaseColorFactor, 4, 0, 1 },
    PropertyRow{ "/materials/{}/pbrMetallicRoughness/metallicFactor", kMaterial, MetallicFactor, 1, 0, 1 },
    PropertyRow{ "/materials/{}/pbrMetallicRoughness/roughnessFactor", kMaterial, RoughnessFactor, 1, 0, 1 },
    PropertyRow{ "/materials/{}/emissiveFactor", kMaterial, EmissiveFactor, 3, 0, 1 },
    PropertyRow{ EXTENSION "emissive_strength/emissiveStrength", kMaterial, EmissiveStrength, 1, 0, kFloats },
    PropertyRow{ "/materials/{}/alphaCutoff", kMaterial, AlphaCutoff, 1, 0, kFloats },
    PropertyRow{ "/materials/{}/normalTexture/scale", kMaterial, NormalScale, 1, -kFloats, kFloats },
    PropertyRow{ "/materials/{}/occlusionTexture/strength", kMaterial, OcclusionStrength, 1, 0, 1 },
    PropertyRow{ "/materials/{}/extensions/EXT_materials_bump/bumpFactor", kMaterial, BumpFactor, 1, -kHalfs, kHalfs },
    PropertyRow{ EXTENSION "anisotropy/anisotropyStrength", kMaterial, AnisotropyStrength, 1, 0, 1 },
    PropertyRow{ EXTENSION "anisotropy/anisotropyRotation", kMaterial, AnisotropyRotation, 1, -kFloats, kFloats },
    PropertyRow{ EXTENSION "clearcoat/clearcoatFactor", kMaterial, ClearCoat, 1, 0, 1 },
    PropertyRow{ EXTENSION "clearcoat/clearcoatRoughnessFactor", kMaterial, ClearCoatRoughness, 1, 0, 1 },
    PropertyRow{ EXTENSION "clearcoat/clearcoatNormalTexture/scale", kMaterial, ClearCoatNormalScale, 1, -kFloats,
                 kFloats },
    PropertyRow{ EXTENSION "diffuse_transmission/diffuseTransmissionFactor", kMaterial, DiffuseTransmission, 1, 0, 1 },
    PropertyRow{ EXTENSION "diffuse_transmission/diffuseTransmissionColorFactor", kMaterial, DiffuseTransmissionColor,
                 3, 0, 1 },
    PropertyRow{ EXTENSION "dispersion/dispersion", kMaterial, Dispersion, 1, 0, 100 },
    PropertyRow{ EXTENSION "ior/ior", kMaterial, Ior, 1, 0, kOpaqueIor },
    PropertyRow{ EXTENSION "iridescence/iridescenceFactor", kMaterial, Iridescence, 1, 0, 1 },
    PropertyRow{ EXTENSION "iridescence/iridescenceIor", kMaterial, IridescenceIor, 1, 1, 100 },
    PropertyRow{ EXTENSION "iridescence/iridescenceThicknessMinimum", kMaterial, IridescenceThicknessMin, 1, 0,
                 kHalfs },
    PropertyRow{ EXTENSION "iridescence/iridescenceThicknessMaximum", kMaterial, IridescenceThicknessMax, 1, 0,
                 kHalfs },
    PropertyRow{ EXTENSION "sheen/sheenColorFactor", kMaterial, SheenColor, 3, 0, 1 },
    PropertyRow{ EXTENSION "sheen/sheenRoughnessFactor", kMaterial, SheenRoughness, 1, 0, 1 },
    PropertyRow{ EXTENSION "specular/specularFactor", kMaterial, Specular, 1, 0, 1 },
    PropertyRow{ EXTENSION "specular/specularColorFactor", kMaterial, SpecularColor, 3, 0, kHalfs },
    PropertyRow{ EXTENSION "transmission/transmissionFactor", kMaterial, Transmission, 1, 0, 1 },
    PropertyRow{ EXTENSION "volume/thicknessFactor", kMaterial, Thickness, 1, 0, kHalfs },
    PropertyRow{ EXTENSION "volume/attenuationDistance", kMaterial, AttenuationDistance, 1, 1e-6f, kFloats },
    PropertyRow{ EXTENSION "volume/attenuationColor", kMaterial, AttenuationColor, 3, 0, 1 },
    PropertyRow{ EXTENSION "volume_scatter/multiscatterColorFactor", kMaterial, MultiscatterColor, 3, 0, 1 },
    PropertyRow{ EXTENSION "volume_scatter/scatterAnisotropy", kMaterial, ScatterAnisotropy, 1, -kMaxScatterAnisotropy,
                 kMaxScatterAnisotropy },
    PropertyRow{ TRANSFORM "offset", kMaterial, UvOffset, 2, -kFloats, kFloats },
    PropertyRow{ TRANSFORM "rotation", kMaterial, UvRotation, 1, -kFloats, kFloats },
    PropertyRow{ TRANSFORM "scale", kMaterial, UvScale, 2, -kFloats, kFloats },
    PropertyRow{ LIGHT "color", kLight, LightColor, 3, 0, kFloats },
    PropertyRow{ LIGHT "intensity", kLight, LightIntensity, 1, 0, kFloats },
    PropertyRow{ LIGHT "range", kLight, LightRange, 1, 0, kFloats, false },
    PropertyRow{ LIGHT "spot/innerConeAngle", kLight, LightInnerCone, 1, 0, kHalfPi },
    PropertyRow{ LIGHT "spot/outerConeAngle", kLight, LightOuterCone, 1, kNarrowestCone, kHalfPi },
    PropertyRow{ "/cameras/{}/perspective/yfov", kCamera, CameraYfov, 1, 1e-3f, 3.1415925f },
    PropertyRow{ "/cameras/{}/perspective/aspectRatio", kCamera, CameraAspect, 1, kSmallest, kLargestMeters, false },
    PropertyRow{ "/cameras/{}/perspective/znear", kCamera, CameraPerspectiveNear, 1, kSmallest, kLargestMeters },
    PropertyRow{ "/cameras/{}/perspective/zfar", kCamera, CameraPerspectiveFar, 1, 0, kFloats, false },
    PropertyRow{ "/cameras/{}/orthographic/xmag", kCamera, CameraXmag, 1, -kLargestMeters, kLargestMeters },
    PropertyRow{ "/cameras/{}/orthographic/ymag", kCamera, CameraYmag, 1, -kLargestMeters, kLargestMeters },
    PropertyRow{ "/cameras/{}/orthographic/znear", kCamera, CameraNear, 1, 0, kLargestMeters },
    PropertyRow{ "/cameras/{}/orthographic/zfar", kCamera, CameraFar, 1, kSmallest, kLargestMeters },
};

#undef EXTENSION
#undef TRANSFORM
#undef LIGHT

#define EXTENSION "extensions/KHR_materials_"
constexpr std::array kTexturePaths{
    TexturePath{ "pbrMetallicRoughness/baseColorTexture", MapName::BaseColor },
    TexturePath{ "pbrMetallicRoughness/metallicRoughnessTexture", MapName::MetallicRoughness },
    TexturePath{ "normalTexture", MapName::Normal },
    TexturePath{ "occlusionTexture", MapName::Occlusion },
    TexturePath{ "emissiveTexture", MapName::Emissive },
    TexturePath{ "extensions/EXT_materials_bump/bumpTexture", MapName::Bump },
    TexturePath{ EXTENSION "clearcoat/clearcoatTexture", MapName::ClearCoat },
    TexturePath{ EXTENSION "clearcoat/clearcoatRoughnessTexture", MapName::ClearCoatRoughness },
    TexturePath{ EXTENSION "clearcoat/clearcoatNormalTexture", MapName::ClearCoatNormal },
    TexturePath{ EXTENSION "sheen/sheenColorTexture", MapName::Sheen },
    TexturePath{ EXTENSION "sheen/sheenRoughnessTexture", MapName::SheenRoughness },
    TexturePath{ EXTENSION "specular/specularColorTexture", MapName::Specular },
    TexturePath{ EXTENSION "specular/specularTexture", MapName::SpecularFactor },
    TexturePath{ EXTENSION "anisotropy/anisotropyTexture", MapName::Anisotropy },
    TexturePath{ EXTENSION "iridescence/iridescenceTexture", MapName::Iridescence },
    TexturePath{ EXTENSION "iridescence/iridescenceThicknessTexture", MapName::IridescenceThickness },
    TexturePath{ EXTENSION "transmission/transmissionTexture", MapName::Transmission },
    TexturePath{ EXTENSION "volume/thicknessTexture", MapName::Thickness },
    TexturePath{ EXTENSION "diffuse_transmission/diffuseTransmissionColorTexture", MapName::DiffuseTransmission },
    TexturePath{ EXTENSION "diffuse_transmission/diffuseTransmissionTexture", MapName::DiffuseTransmissionFactor },
    TexturePath{ EXTENSION "volume_scatter/multiscatterColorTexture", MapName::Multiscatter },
    TexturePath{ "extensions/FILAMENT_lightmap/lightmapTexture", MapName::Light },
};
#undef EXTENSION

using Field = std::span<float>;
Field one(float& value) { return { &value, 1 }; }
Field three(float3& value) { return { &value.x, 3 }; }

Field layerField(MaterialData& m, PropertyName name) {
    switch (name) {
    case AnisotropyStrength:
        return one(m.anisotropy.strength);
    case AnisotropyRotation:
        return one(m.anisotropy.rotationRadians);
    case ClearCoat:
        return one(m.clearCoat.factor);
    case ClearCoatRoughness:
        return one(m.clearCoat.roughness);
    case ClearCoatNormalScale:
        return one(m.clearCoat.normalScale);
    case DiffuseTransmission:
        return one(m.diffuseTransmission.factor);
    case DiffuseTransmissionColor:
        return three(m.diffuseTransmission.color);
    case Dispersion:
        return one(m.transmission.dispersion);
    case Ior:
        return one(m.ior);
    case Iridescence:
        return one(m.iridescence.factor);
    case IridescenceIor:
        return one(m.iridescence.ior);
    case IridescenceThicknessMin:
        return one(m.iridescence.thicknessMinNanometers);
    case IridescenceThicknessMax:
        return one(m.iridescence.thicknessMaxNanometers);
    case SheenColor:
        return three(m.sheen.color);
    case SheenRoughness:
        return one(m.sheen.roughness);
    case Specular:
        return one(m.specular.factor);
    case SpecularColor:
        return three(m.specular.color);
    case Transmission:
        return one(m.transmission.factor);
    case Thickness:
        return one(m.transmission.thicknessMeters);
    case AttenuationDistance:
        return one(m.transmission.attenuationDistanceMeters);
    case AttenuationColor:
        return three(m.transmission.attenuationColor);
    case MultiscatterColor:
        return three(m.volumeScatter.color);
    case ScatterAnisotropy:
        return one(m.volumeScatter.anisotropy);
    default:
        return {};
    }
}

Field fieldOf(MaterialData& m, PropertyName name, MapName map) {
    switch (name) {
    case BaseColorFactor:
        return { &m.baseColorFactor.x, 4 };
    case MetallicFactor:
        return one(m.metallicFactor);
    case RoughnessFactor:
        return one(m.roughnessFactor);
    case EmissiveFactor:
        return three(m.emissiveFactor);
    case EmissiveStrength:
        return one(m.emissiveStrength);
    case AlphaCutoff:
        return one(m.alphaCutoff);
    case NormalScale:
        return one(m.normalScale);
    case OcclusionStrength:
        return one(m.occlusionStrength);
    case BumpFactor:
        return one(m.bump.factor);
    case UvOffset:
        return { &mapOf(m, map).placement.offset.x, 2 };
    case UvRotation:
        return one(mapOf(m, map).placement.rotationRadians);
    case UvScale:
        return { &mapOf(m, map).placement.scale.x, 2 };
    default:
        return layerField(m, name);
    }
}

Field fieldOf(LightData& light, PropertyName name) {
    switch (name) {
    case LightColor:
        return three(light.color);
    case LightIntensity:
        return one(light.intensity);
    case LightRange:
        return one(light.rangeMeters);
    case LightInnerCone:
        return one(light.innerConeRadians);
    case LightOuterCone:
        return one(light.outerConeRadians);
    default:
        return {};
    }
}

Field fieldOf(CameraData& camera, PropertyName name) {
    switch (name) {
    case CameraYfov:
        return one(camera.verticalFovRadians);
    case CameraAspect:
        return one(camera.aspect);
    case CameraPerspectiveNear:
    case CameraNear:
        return one(camera.nearMeters);
    case CameraFar:
        return one(camera.farMeters);
    default:
        return {};
    }
}

float4 read(Field field) {
    float4 value(0.0f);
    for (size_t i = 0; i < field.size(); ++i) value[static_cast<int>(i)] = field[i];
    return value;
}

void write(Field field, PropertyName name, float4 value) {
    PropertyRow const& row = rowOf(name);
    for (size_t i = 0; i < field.size(); ++i) {
        const float number = value[static_cast<int>(i)];
        field[i] = std::isnan(number) ? row.low : std::clamp(number, row.low, row.high);
    }
}

} // namespace

std::span<const PropertyRow> propertyRows() { return kRows; }
std::span<const TexturePath> texturePaths() { return kTexturePaths; }

PropertyRow const& rowOf(PropertyName name) {
    auto const* row = std::ranges::find(kRows, name, &PropertyRow::name);
    FILAMENT_ASSERT(row != kRows.end(), "every animated property has a row");
    return *row;
}

TextureRef& mapOf(MaterialData& m, MapName map) {
    const auto secondOf = [](TexturePair& pair) -> TextureRef& { return pair.isApart() ? pair.second : pair.texture; };
    switch (map) {
    case MapName::MetallicRoughness:
        return m.metallicRoughness;
    case MapName::Normal:
        return m.normal;
    case MapName::Occlusion:
        return m.occlusion;
    case MapName::Emissive:
        return m.emissive;
    case MapName::Bump:
        return m.bump.map;
    case MapName::ClearCoat:
        return m.clearCoat.maps.texture;
    case MapName::ClearCoatRoughness:
        return secondOf(m.clearCoat.maps);
    case MapName::ClearCoatNormal:
        return m.clearCoat.normal;
    case MapName::Sheen:
        return m.sheen.maps.texture;
    case MapName::SheenRoughness:
        return secondOf(m.sheen.maps);
    case MapName::Specular:
        return m.specular.maps.texture;
    case MapName::SpecularFactor:
        return secondOf(m.specular.maps);
    case MapName::Anisotropy:
        return m.anisotropy.map;
    case MapName::Iridescence:
        return m.iridescence.maps.texture;
    case MapName::IridescenceThickness:
        return secondOf(m.iridescence.maps);
    case MapName::Transmission:
        return m.transmission.maps.texture;
    case MapName::Thickness:
        return secondOf(m.transmission.maps);
    case MapName::DiffuseTransmission:
        return m.diffuseTransmission.maps.texture;
    case MapName::DiffuseTransmissionFactor:
        return secondOf(m.diffuseTransmission.maps);
    case MapName::Multiscatter:
        return m.volumeScatter.map;
    case MapName::Light:
        return m.light.map;
    case MapName::BaseColor:
    case MapName::None:
        break;
    }
    return m.baseColor;
}

void keepProperty(MaterialData& m, PropertyName name) {
    const PropertyName first = name;
    m.isAnimated = true;
    if (first == AnisotropyStrength) m.anisotropy.isAnimated = true;
    if (first == BumpFactor) m.bump.isAnimated = true;
    if (first == ClearCoat) m.clearCoat.isAnimated = true;
    if (first == DiffuseTransmission) m.diffuseTransmission.isAnimated = true;
    if (first == Dispersion) m.transmission.isDispersionAnimated = true;
    if (first == Ior) m.isIorAnimated = true;
    if (first == Iridescence) m.iridescence.isAnimated = true;
    if (first == SheenColor) m.sheen.isAnimated = true;
    if (first == Specular || first == SpecularColor) m.specular.isAnimated = true;
    if (first == Transmission) m.transmission.isAnimated = true;
    if (first == Thickness) m.transmission.isThicknessAnimated = true;
    if (first == MultiscatterColor) m.volumeScatter.isAnimated = true;
    if (first == AttenuationDistance || first == AttenuationColor) m.transmission.isAbsorptionAnimated = true;
}

float4 valueOf(NodeData const& node, PropertyName name) {
    const bool value = name == NodeVisible      ? node.isVisible
                       : name == NodeSelectable ? node.isSelectable
                                                : node.isHoverable;
    return float4(value ? 1.0f : 0.0f, 0, 0, 0);
}

float4 valueOf(MaterialData const& material, PropertyName name, MapName map) {
    return read(fieldOf(const_cast<MaterialData&>(material), name, map));
}
float4 valueOf(LightData const& light, PropertyName name) { return read(fieldOf(const_cast<LightData&>(light), name)); }
float4 valueOf(CameraData const& camera, PropertyName name) {
    if (name == CameraYmag) return float4(camera.halfHeightMeters, 0, 0, 0);
    if (name == CameraXmag) return float4(camera.halfHeightMeters * camera.aspect, 0, 0, 0);
    return read(fieldOf(const_cast<CameraData&>(camera), name));
}

void setValue(MaterialData& material, PropertyName name, MapName map, float4 value) {
    write(fieldOf(material, name, map), name, value);
    if (name == Ior) material.ior = material.ior == 0 ? kOpaqueIor : std::max(material.ior, 1.0f);
    if (map == MapName::None) return;
    TextureRef& texture = mapOf(material, map);
    texture.uvTransform = matrixFrom(texture.placement);
}

void setValue(LightData& light, PropertyName name, float4 value) {
    write(fieldOf(light, name), name, value);
    // KHR_lights_punctual: the inner cone is smaller.
    if (light.innerConeRadians >= light.outerConeRadians)
        light.innerConeRadians = std::nextafter(light.outerConeRadians, 0.0f);
    if (name != LightIntensity || light.shape == AreaShape::None) return;
    const double view = largestView(light), nits = view > 0 ? double{ light.intensity } / view : 0;
    light.luminance = static_cast<float>(std::min(nits, double{ kFloats }));
}

void setValue(CameraData& camera, PropertyName name, float4 value) {
    if (name == CameraXmag || name == CameraYmag) {
        const float size = std::isnan(value.x) ? kSmallest : std::clamp(std::abs(value.x), kSmallest, kLargestMeters);
        const float width = name == CameraXmag ? size : camera.halfHeightMeters * camera.aspect;
        if (name == CameraYmag) camera.halfHeightMeters = size;
        camera.aspect = std::clamp(width / camera.halfHeightMeters, kSmallest, kLargestMeters);
        return;
    }
    write(fieldOf(camera, name), name, value);
    if (camera.isParallel && !(camera.farMeters > camera.nearMeters))
        camera.farMeters = std::max(camera.nearMeters + 1, camera.nearMeters * 2);
}

} // namespace filament_core::assets
