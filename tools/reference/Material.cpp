// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Material.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/TextureLookup.h"

#include <algorithm>

namespace filament::reference {
namespace {

namespace lib = shader::lib64;

using assets::AlphaMode;
using assets::MaterialData;
using assets::TextureRef;

constexpr double kReflectance = 0.5; // of glTF's dielectrics: f0 = 4 %

double4 fetch(Part const& part, TextureRef const& texture, Varyings const& varyings) {
    double2 uv = varyings.uvs[texture.uvSet];
    if (texture.hasTransform) uv = double2(double3x3(texture.uvTransform) * double3(uv, 1.0));
    return lookUp((*part.images)[texture.image], texture.sampler, uv);
}

bool has(TextureRef const& texture) { return texture.image != assets::kNone; }

double4 baseColorOf(Part const& part, Varyings const& varyings) {
    double4 color = double4(part.material->baseColorFactor) * varyings.color;
    if (has(part.material->baseColor)) color *= fetch(part, part.material->baseColor, varyings);
    return color;
}

double3 normalizedOr(double3 v, double3 fallback) {
    const double length = glm::length(v);
    return length > 1e-15 ? v / length : fallback;
}

double3 shadingNormal(Part const& part, Varyings const& varyings, double side) {
    const double3 n = varyings.normal * side;
    const double3 smooth = normalizedOr(n, varyings.faceNormal * side);
    TextureRef const& map = part.material->normal;
    if (!has(map)) return smooth;
    const double3 texel = double3(fetch(part, map, varyings)) * 2.0 - 1.0;
    const double scale = part.material->normalScale;
    const double3 t = double3(varyings.tangent) * side;
    const double3 b = glm::cross(varyings.normal, double3(varyings.tangent)) * (varyings.tangent.w * side);
    return normalizedOr(t * (texel.x * scale) + b * (texel.y * scale) + n * texel.z, smooth);
}

void evaluateLit(Part const& part, Varyings const& varyings, double3 baseColor, SurfaceSample& surface) {
    MaterialData const& material = *part.material;
    double metallic = material.metallicFactor, roughness = material.roughnessFactor;
    if (has(material.metallicRoughness)) {
        const double4 texel = fetch(part, material.metallicRoughness, varyings);
        roughness *= texel.y;
        metallic *= texel.z;
    }
    surface.metallic = metallic;
    surface.diffuse = lib::diffuseColor(baseColor, metallic);
    surface.f0 = lib::f0FromBaseColor(baseColor, metallic, kReflectance);
    surface.f90 = lib::saturate(lib::dot(surface.f0, double3(50.0 * 0.33))); // as surface_lit_surface.glsl
    surface.perceptualRoughness = lib::clampPerceptualRoughness(roughness);
    if (has(material.occlusion)) {
        const double occlusion = fetch(part, material.occlusion, varyings).x;
        surface.occlusion = lib::saturate(1 + material.occlusionStrength * (occlusion - 1));
    }
    surface.emitted = double3(material.emissiveFactor * material.emissiveStrength);
    if (has(material.emissive)) surface.emitted *= double3(fetch(part, material.emissive, varyings));
    surface.emitted *= surface.opacity;
}

} // namespace

SurfaceSample surfaceAt(Part const& part, TrianglePoint const& point, double3 view) {
    const Varyings varyings = varyingsAt(part, point);
    const double side = glm::dot(varyings.faceNormal, view) < 0 ? -1 : 1;
    SurfaceSample surface;
    surface.position = varyings.position;
    surface.geometricNormal = varyings.faceNormal * side;
    surface.view = view;
    surface.normal = shadingNormal(part, varyings, side);
    surface.tangent = double3(varyings.tangent) * side;
    surface.uv = varyings.uvs[0];
    // Embree's floats: 2^-24 of the coordinates and, for the distance along a ray, some 2^-23 of the triangle's size.
    const double3 size = glm::abs(varyings.position);
    surface.selfAvoidance = 0x1p-20 * (std::max({ size.x, size.y, size.z }) + varyings.longestEdge);

    double4 color = baseColorOf(part, varyings);
    if (part.material->alphaMode == AlphaMode::Blend) {
        surface.opacity = std::clamp(color.w, 0.0, 1.0);
        color *= double4(double3(surface.opacity), 1.0); // glTF's colours are not pre-multiplied
    }
    if (part.material->unlit) {
        surface.scatters = false;
        surface.emitted = double3(color);
    } else {
        evaluateLit(part, varyings, double3(color), surface);
    }
    if (part.finish) part.finish(surface);
    TransmissionSample& below = surface.transmission;
    below.isFromInside = side < 0 && !below.isThin && below.color != double3(0.0);
    return surface;
}

bool isMaskedOut(Part const& part, TrianglePoint const& point) {
    if (part.material->alphaMode != AlphaMode::Mask) return false;
    return baseColorOf(part, colorVaryingsAt(part, point)).w < part.material->alphaCutoff;
}

double opacityAt(Part const& part, TrianglePoint const& point) {
    if (part.material->alphaMode != AlphaMode::Blend) return 1;
    return std::clamp(baseColorOf(part, colorVaryingsAt(part, point)).w, 0.0, 1.0);
}

} // namespace filament::reference
