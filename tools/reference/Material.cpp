// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Material.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/MaterialLayers.h"
#include "tools/reference/MaterialMaps.h"

#include <algorithm>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

using assets::AlphaMode;
using assets::MaterialData;

constexpr double kReflectance = 0.5; // glTF's dielectrics: f0 = 4 %

double4 baseColorOf(MaterialPoint const& point) {
    MaterialData const& material = point.material();
    double4 color = double4(material.baseColorFactor) * point.varyings.color;
    if (has(material.baseColor)) color *= point.fetch(material.baseColor);
    return color;
}

double4 baseColorAt(Part const& part, TrianglePoint const& point) {
    return baseColorOf({ part, colorVaryingsAt(part, point) });
}

void evaluateMaps(MaterialPoint const& point, SurfaceSample& surface) {
    MaterialData const& material = point.material();
    if (has(material.occlusion)) {
        const double occlusion = point.fetch(material.occlusion).x;
        surface.occlusion = lib::saturate(1 + material.occlusionStrength * (occlusion - 1));
    }
    surface.emitted = double3(material.emissiveFactor * material.emissiveStrength);
    if (has(material.emissive)) surface.emitted *= double3(point.fetch(material.emissive));
}

void evaluateMetallicRoughness(MaterialPoint const& point, double3 baseColor, SurfaceSample& surface) {
    MaterialData const& material = point.material();
    double metallic = material.metallicFactor, roughness = material.roughnessFactor;
    if (has(material.metallicRoughness)) {
        const double4 texel = point.fetch(material.metallicRoughness);
        roughness *= texel.y;
        metallic *= texel.z;
    }
    surface.metallic = metallic;
    surface.diffuse = lib::diffuseColor(baseColor, metallic);
    surface.f0 = lib::f0FromBaseColor(baseColor, metallic, kReflectance);
    surface.f90 = f90Of(surface.f0);
    surface.perceptualRoughness = lib::clampPerceptualRoughness(roughness);
    addLayers(point, baseColor, roughness, surface);
}

// KHR_materials_pbrSpecularGlossiness, like shaders/material/gltf/specular_glossiness.glsl.
void evaluateSpecularGlossiness(MaterialPoint const& point, double3 baseColor, SurfaceSample& surface) {
    assets::SpecularGlossinessData const& data = *point.material().specularGlossiness;
    const double4 map = has(data.map) ? point.fetch(data.map) : double4(1.0);
    surface.f0 = double3(data.specularFactor) * double3(map);
    surface.f90 = f90Of(surface.f0);
    surface.diffuse = lib::diffuseColorFromSpecularGlossiness(baseColor, surface.f0);
    const double roughness = lib::perceptualRoughnessFromGlossiness(data.glossinessFactor * map.w);
    surface.perceptualRoughness = lib::clampPerceptualRoughness(roughness);
}

void evaluateLit(MaterialPoint const& point, double3 baseColor, SurfaceSample& surface) {
    evaluateMaps(point, surface);
    if (point.material().specularGlossiness) {
        evaluateSpecularGlossiness(point, baseColor, surface);
    } else {
        evaluateMetallicRoughness(point, baseColor, surface);
    }
}

} // namespace

SurfaceSample surfaceAt(Part const& part, TrianglePoint const& point, double3 view) {
    const Varyings varyings = varyingsAt(part, point);
    const double side = glm::dot(varyings.faceNormal, view) < 0 ? -1 : 1;
    const MaterialPoint at{ part, varyings, side };
    SurfaceSample surface;
    surface.position = varyings.position;
    surface.geometricNormal = varyings.faceNormal * side;
    surface.view = view;
    surface.normal = at.bumpedNormal();
    if (has(part.material->normal) || has(part.material->bump.map)) surface.unmappedNormal = at.smoothNormal();
    surface.tangent = double3(varyings.tangent) * side;
    surface.uv = varyings.uvs[0];
    // The precision of Embree's floats: 2^-24 of the coordinates and, for the distance along a ray, about 2^-23 of the
    // triangle's size.
    const double3 size = glm::abs(varyings.position);
    surface.selfAvoidance = 0x1p-20 * (std::max({ size.x, size.y, size.z }) + varyings.longestEdge);

    double4 color = baseColorOf(at);
    if (part.material->alphaMode == AlphaMode::Blend) surface.opacity = std::clamp(color.w, 0.0, 1.0);
    if (part.material->unlit) {
        surface.scatters = false;
        surface.emitted = double3(color);
    } else {
        evaluateLit(at, double3(color), surface);
    }
    if (part.finish) part.finish(surface);
    TransmissionSample& below = surface.transmission;
    // After the finish, which may make a surface transmit.
    below.isFromInside = side < 0 && !below.isThin && below.color != double3(0.0);
    if (surface.medium) surface.medium->isFromInside = side < 0;
    return surface;
}

bool isMaskedOut(Part const& part, TrianglePoint const& point) {
    if (part.material->alphaMode != AlphaMode::Mask) return false;
    return baseColorAt(part, point).w < part.material->alphaCutoff;
}

double opacityAt(Part const& part, TrianglePoint const& point) {
    if (part.material->alphaMode != AlphaMode::Blend) return 1;
    return std::clamp(baseColorAt(part, point).w, 0.0, 1.0);
}

double3 passedAt(Part const& part, TrianglePoint const& point, double3 direction) {
    if (!part.material->transmission.isUsed()) return double3(0.0);
    const SurfaceSample surface = surfaceAt(part, point, -direction);
    TransmissionSample const& below = surface.transmission;
    if (below.share <= 0) return double3(0.0);
    const double cosine = std::abs(glm::dot(surface.normal, direction));
    const double3 reflected = lib::fresnelSchlick(double3(lib::f0FromIor(below.ior)), 1.0, cosine);
    const double path = below.isThin ? lib::thinPathLength(cosine, below.ior, below.thickness)
                                     : lib::solidPathLength(cosine, below.ior, below.thickness);
    const double3 tint = below.color / below.share * lib::transmittance(below.absorption, path);
    return below.share * (below.isThin ? lib::thinTransmittance(reflected, tint) : (1.0 - reflected) * tint);
}

} // namespace filament_core::reference
