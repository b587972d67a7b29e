// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/UvDensity.h"

#include "filament_core/scene/VertexPositions.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace filament_core::scene {
namespace {

struct UvPlace {
    uint8_t location;
    size_t firstComponent; ///< of the attribute
};
constexpr std::array<UvPlace, 4> kUvPlaces{ { { shader::kAttributeUv0, 0 },
                                              { shader::kAttributeUv1, 0 },
                                              { shader::kAttributeCustom0, 0 },
                                              { shader::kAttributeCustom0, 2 } } };

std::vector<double2> uvsOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices, UvPlace place) {
    const auto attributes = std::span(layout.attributes).first(layout.attributeCount);
    const auto found = std::ranges::find(attributes, place.location, &backend::VertexAttribute::location);
    if (found == attributes.end()) return {};
    const backend::VertexFormat format = place.firstComponent == 0 ? found->format : backend::VertexFormat::Float2;
    const size_t first = found->offset + place.firstComponent * sizeof(float), stride = layout.buffers[0].stride;
    std::vector<double2> uvs;
    for (size_t at = 0; at + stride <= vertices.size(); at += stride) {
        const std::optional<double3> uv = positionAt(&vertices[at + first], format);
        if (!uv) return {};
        uvs.emplace_back(*uv);
    }
    return uvs;
}

float leastDensity(std::span<const float3> positions, std::span<const double2> uvs, std::span<const uint32_t> indices) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (std::max({ a, b, c }) >= positions.size()) return 0;
        const double3 origin(positions[a]);
        const double area = glm::length(glm::cross(double3(positions[b]) - origin, double3(positions[c]) - origin));
        if (!(area > 0)) continue;
        const double2 u = uvs[b] - uvs[a], v = uvs[c] - uvs[a];
        const double share = std::abs(u.x * v.y - u.y * v.x) / area;
        if (!std::isfinite(share)) return 0;
        least = std::min(least, share);
    }
    return static_cast<float>(std::sqrt(least));
}

} // namespace

UvDensity uvDensityOf(GeometryLayout const& layout, std::span<const std::byte> vertices, backend::IndexFormat format,
                      std::span<const std::byte> indices) {
    UvDensity densities{};
    if (layout.topology != backend::PrimitiveType::Triangles) return densities;
    const std::vector<float3> positions = positionsOf(layout.vertices, vertices);
    const std::vector<uint32_t> corners = indicesOf(format, indices);
    for (size_t set = 0; set < densities.size(); ++set) {
        const std::vector<double2> uvs = uvsOf(layout.vertices, vertices, kUvPlaces[set]);
        if (!uvs.empty() && uvs.size() == positions.size()) densities[set] = leastDensity(positions, uvs, corners);
    }
    return densities;
}

} // namespace filament_core::scene
