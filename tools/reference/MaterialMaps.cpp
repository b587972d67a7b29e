// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/MaterialMaps.h"

#include "tools/reference/TextureLookup.h"

#include <algorithm>

namespace filament_core::reference {
namespace {

double3 normalizedOr(double3 v, double3 fallback) {
    const double length = glm::length(v);
    return length > 1e-15 ? v / length : fallback;
}

} // namespace

double2 MaterialPoint::uvOf(assets::TextureRef const& texture) const {
    const double2 uv = varyings.uvs[texture.uvSet];
    return texture.hasTransform ? double2(double3x3(texture.uvTransform) * double3(uv, 1.0)) : uv;
}

double4 MaterialPoint::fetchAt(assets::TextureRef const& texture, double2 uv) const {
    return lookUp((*part.images)[texture.image], texture.sampler, uv);
}

double4 MaterialPoint::fetch(assets::TextureRef const& texture) const { return fetchAt(texture, uvOf(texture)); }

double2 MaterialPoint::fetchScalars(assets::TexturePair const& pair) const {
    if (!has(pair.texture)) return double2(1.0);
    const double4 texel = fetch(pair.texture), second = pair.isApart() ? fetch(pair.second) : texel;
    return { pair.hasFirst ? texel.x : 1, pair.hasSecond ? second.y : 1 };
}

double4 MaterialPoint::fetchColorAndScalar(assets::TexturePair const& pair) const {
    if (!has(pair.texture)) return double4(1.0);
    const double4 texel = fetch(pair.texture), second = pair.isApart() ? fetch(pair.second) : texel;
    return { pair.hasFirst ? double3(texel) : double3(1.0), pair.hasSecond ? second.w : 1 };
}

double3 MaterialPoint::toWorld(double3 local) const {
    const double3 tangent(varyings.tangent);
    const double3 bitangent = glm::cross(varyings.normal, tangent) * varyings.tangent.w;
    return (tangent * local.x + bitangent * local.y + varyings.normal * local.z) * side;
}

double3 MaterialPoint::smoothNormal() const { return normalizedOr(varyings.normal * side, varyings.faceNormal * side); }

std::array<double2, 2> MaterialPoint::uvEdgesOf(assets::TextureRef const& map) const {
    std::array<double2, 2> edges;
    for (size_t i = 0; i < 2; ++i) {
        edges[i] = varyings.uvEdges[map.uvSet][i];
        if (map.hasTransform) edges[i] = double2(double3x3(map.uvTransform) * double3(edges[i], 0.0));
    }
    return edges;
}

double2 MaterialPoint::derivedVector(assets::TextureRef const& map, double2 vector) const {
    const std::array<double2, 2> uv = uvEdgesOf(map);
    const double area = uv[0].x * uv[1].y - uv[1].x * uv[0].y, sign = area < 0 ? -1 : 1;
    const double3 tangent(varyings.tangent), bitangent = glm::cross(varyings.normal, tangent) * varyings.tangent.w;
    const auto inFrame = [&](double3 v) { return double2(glm::dot(v, tangent), glm::dot(v, bitangent)) * sign; };
    const double2 right = inFrame(varyings.edges[0] * uv[1].y - varyings.edges[1] * uv[0].y);
    const double2 up = inFrame(varyings.edges[0] * uv[1].x - varyings.edges[1] * uv[0].x);
    if (area == 0 || right == double2(0.0)) return vector;
    const double2 x = glm::normalize(right), y(-x.y, x.x);
    return vector.x * x + vector.y * (glm::dot(y, up) < 0 ? -1.0 : 1.0) * y;
}

double2 MaterialPoint::vectorOfVertex(assets::TextureRef const& map, double2 vector) const {
    const assets::MapFrame frame = assets::frameOf(map, part.tangentBasis);
    if (frame == assets::MapFrame::Derived) return derivedVector(map, vector);
    const glm::dmat2 turn{ double3x3(map.uvTransform) };
    const double area = glm::determinant(turn);
    if (frame == assets::MapFrame::Vertex || area == 0) return vector;
    const double sign = area < 0 ? -1 : 1;
    const double2 x = glm::normalize(double2(turn[1].y, turn[0].y) * sign), y(-x.y, x.x);
    return vector.x * x + vector.y * sign * y;
}

double3 MaterialPoint::mappedNormal(assets::TextureRef const& map, double scale) const {
    if (!has(map)) return smoothNormal();
    const double3 texel = double3(fetch(map)) * 2.0 - 1.0;
    return normalizedOr(toWorld({ vectorOfVertex(map, double2(texel)) * scale, texel.z }), smoothNormal());
}

double2 MaterialPoint::riseAlongEdges() const {
    assets::BumpData const& bump = material().bump;
    assets::Image const& image = (*part.images)[bump.map.image];
    const double2 size(image.width, image.height), uv = uvOf(bump.map), toU(0.5 / size.x, 0), toV(0, 0.5 / size.y);
    const auto height = [&](double2 at) { return fetchAt(bump.map, at).x * bump.factor; };
    const double2 perTexel(height(uv + toU) - height(uv - toU), height(uv + toV) - height(uv - toV));
    double2 rise(0.0);
    const std::array<double2, 2> steps = uvEdgesOf(bump.map);
    for (int edge = 0; edge < 2; ++edge) rise[edge] = glm::dot(perTexel, steps[static_cast<size_t>(edge)] * size);
    return rise;
}

double3 MaterialPoint::bumpedNormal() const {
    const double3 normal = mappedNormal(material().normal, material().normalScale);
    if (!material().bump.isUsed() || !has(material().bump.map)) return normal;
    const double2 rise = riseAlongEdges();
    const double3 n = smoothNormal();
    const double3 acrossSecond = glm::cross(varyings.edges[1], n), acrossFirst = glm::cross(n, varyings.edges[0]);
    const double area = glm::dot(varyings.edges[0], acrossSecond);
    if (area == 0 || rise == double2(0.0)) return normal;
    const double3 gradient = (acrossSecond * rise.x + acrossFirst * rise.y) * (side / area);
    const double upright = has(material().normal) ? std::max(glm::dot(n, normal), 0.0) : 1.0;
    return normalizedOr(normal - gradient * upright, normal);
}

} // namespace filament_core::reference
