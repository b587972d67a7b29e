// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/MaterialMaps.h"

#include "tools/reference/TextureLookup.h"

namespace filament::reference {
namespace {

double3 normalizedOr(double3 v, double3 fallback) {
    const double length = glm::length(v);
    return length > 1e-15 ? v / length : fallback;
}

} // namespace

double4 MaterialPoint::fetch(assets::TextureRef const& texture) const {
    double2 uv = varyings.uvs[texture.uvSet];
    if (texture.hasTransform) uv = double2(double3x3(texture.uvTransform) * double3(uv, 1.0));
    return lookUp((*part.images)[texture.image], texture.sampler, uv);
}

double2 MaterialPoint::fetchScalars(assets::TexturePair const& pair) const {
    if (!has(pair.texture)) return double2(1.0);
    const double4 texel = fetch(pair.texture);
    return { pair.hasFirst ? texel.x : 1, pair.hasSecond ? texel.y : 1 };
}

double4 MaterialPoint::fetchColorAndScalar(assets::TexturePair const& pair) const {
    if (!has(pair.texture)) return double4(1.0);
    const double4 texel = fetch(pair.texture);
    return { pair.hasFirst ? double3(texel) : double3(1.0), pair.hasSecond ? texel.w : 1 };
}

double3 MaterialPoint::toWorld(double3 local) const {
    const double3 tangent(varyings.tangent);
    const double3 bitangent = glm::cross(varyings.normal, tangent) * varyings.tangent.w;
    return (tangent * local.x + bitangent * local.y + varyings.normal * local.z) * side;
}

double3 MaterialPoint::smoothNormal() const { return normalizedOr(varyings.normal * side, varyings.faceNormal * side); }

double3 MaterialPoint::mappedNormal(assets::TextureRef const& map, double scale) const {
    if (!has(map)) return smoothNormal();
    const double3 texel = double3(fetch(map)) * 2.0 - 1.0;
    return normalizedOr(toWorld({ texel.x * scale, texel.y * scale, texel.z }), smoothNormal());
}

} // namespace filament::reference
