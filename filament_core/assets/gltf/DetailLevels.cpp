// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/DetailLevels.h"

#include "filament_core/assets/geometry/SimplifyMesh.h"
#include "filament_core/scene/VertexPositions.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::assets {
namespace {

using backend::VertexFormat;

template <class Integer>
void append(std::vector<std::byte>& bytes, std::vector<uint32_t> const& indices) {
    for (const uint32_t index : indices) {
        const auto narrow = static_cast<Integer>(index);
        auto const* begin = reinterpret_cast<std::byte const*>(&narrow);
        bytes.insert(bytes.end(), begin, begin + sizeof narrow);
    }
}

template <class Number>
float componentAt(std::byte const* source, size_t index, float unit) {
    Number value;
    std::memcpy(&value, source + index * sizeof value, sizeof value);
    return static_cast<float>(value) * unit;
}

/// Component `index` of joints or weights.
float componentOf(VertexFormat format, std::byte const* source, size_t index) {
    switch (format) {
    case VertexFormat::UByte4:
        return componentAt<uint8_t>(source, index, 1);
    case VertexFormat::UShort4:
        return componentAt<uint16_t>(source, index, 1);
    case VertexFormat::UByte4N:
        return componentAt<uint8_t>(source, index, 1.0f / 255);
    case VertexFormat::UShort4N:
        return componentAt<uint16_t>(source, index, 1.0f / 65535);
    default:
        return componentAt<float>(source, index, 1);
    }
}

backend::VertexAttribute const* attributeAt(PrimitiveData const& primitive, uint8_t location) {
    const auto attributes = std::span(primitive.layout.attributes).first(primitive.layout.attributeCount);
    const auto found = std::ranges::find(attributes, location, &backend::VertexAttribute::location);
    return found == attributes.end() ? nullptr : &*found;
}

struct JointAttributes {
    backend::VertexAttribute const *joints = nullptr, *weights = nullptr;
};

std::vector<Influence> influencesOf(PrimitiveData const& primitive) {
    std::vector<JointAttributes> sets;
    constexpr std::array<std::array<uint8_t, 2>, 2> kSets{ { { shader::kAttributeJoints, shader::kAttributeWeights },
                                                             { shader::kAttributeJoints1,
                                                               shader::kAttributeWeights1 } } };
    for (auto const& [joints, weights] : kSets) {
        const JointAttributes set{ attributeAt(primitive, joints), attributeAt(primitive, weights) };
        if (set.joints && set.weights) sets.push_back(set);
    }
    std::vector<Influence> influences;
    influences.reserve(sets.size() * 4 * primitive.vertexCount);
    for (uint32_t vertex = 0; vertex < primitive.vertexCount; ++vertex) {
        std::byte const* const source = &primitive.vertices[size_t{ vertex } * primitive.layout.buffers[0].stride];
        for (JointAttributes const& set : sets) {
            for (size_t i = 0; i < 4; ++i)
                influences.push_back(
                        { static_cast<uint32_t>(componentOf(set.joints->format, source + set.joints->offset, i)),
                          componentOf(set.weights->format, source + set.weights->offset, i) });
        }
    }
    return influences;
}

} // namespace

std::vector<DetailLevel> addDetailLevels(PrimitiveData& primitive) {
    std::vector<DetailLevel> levels;
    if (primitive.topology != backend::PrimitiveType::Triangles || primitive.splats) return levels;
    const bool isSmall = primitive.indexFormat == backend::IndexFormat::UInt16;
    std::vector<uint32_t> indices = scene::indicesOf(primitive.indexFormat, primitive.indices);
    // Left-over corners form no triangle, and the simplifier takes whole ones.
    indices.resize(indices.size() / 3 * 3);
    const std::vector<float3> positions = scene::positionsOf(primitive.layout, primitive.vertices);
    if (positions.size() != primitive.vertexCount) return levels;
    std::vector<std::span<const float3>> displacements;
    for (MorphTargetData const& target : primitive.morphTargets) {
        if (!target.positions.empty()) displacements.push_back(target.positions);
    }
    std::vector<Influence> influences;
    if (primitive.isSkinned) influences = influencesOf(primitive);
    const std::vector<SimplifiedLevel> simplified = simplifyMesh({ .positions = positions,
                                                                   .indices = indices,
                                                                   .vertices = primitive.vertices,
                                                                   .stride = primitive.layout.buffers[0].stride,
                                                                   .displacements = displacements,
                                                                   .influences = influences });
    // All levels share the vertices of the primitive, so their indices follow in the same buffer, in its format.
    auto first = static_cast<uint32_t>(primitive.indices.size() / (isSmall ? 2 : 4));
    for (SimplifiedLevel const& level : simplified) {
        const auto count = static_cast<uint32_t>(level.indices.size());
        isSmall ? append<uint16_t>(primitive.indices, level.indices)
                : append<uint32_t>(primitive.indices, level.indices);
        levels.push_back({ first, count, level.error });
        first += count;
    }
    return levels;
}

} // namespace filament_core::assets
