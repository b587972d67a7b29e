// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/VertexPositions.h"

#include "base/math/Half.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::scene {
namespace {

using backend::VertexFormat;

template <class T>
T componentOf(const std::byte* source, int index) {
    T value;
    std::memcpy(&value, source + static_cast<size_t>(index) * sizeof(T), sizeof(T));
    return value;
}

template <class Read>
double3 vectorOf(int components, Read&& read) {
    double3 position(0.0);
    for (int i = 0; i < std::min(components, 3); ++i) position[i] = read(i);
    return position;
}

double3 floats(const std::byte* source, int components) {
    return vectorOf(components, [&](int i) { return static_cast<double>(componentOf<float>(source, i)); });
}

double3 halves(const std::byte* source, int components) {
    return vectorOf(components,
                    [&](int i) { return static_cast<double>(floatFromHalf(componentOf<uint16_t>(source, i))); });
}

template <class Integer>
double3 normalized(const std::byte* source, int components) {
    return vectorOf(components, [&](int i) {
        return std::max(static_cast<double>(componentOf<Integer>(source, i)) / std::numeric_limits<Integer>::max(),
                        -1.0);
    });
}

} // namespace

std::optional<double3> positionAt(const std::byte* source, VertexFormat format) {
    const int components = backend::vertexFormatInfo(format).components;
    switch (format) {
    case VertexFormat::Float:
    case VertexFormat::Float2:
    case VertexFormat::Float3:
    case VertexFormat::Float4:
        return floats(source, components);
    case VertexFormat::Half2:
    case VertexFormat::Half4:
        return halves(source, components);
    case VertexFormat::UByte4N:
        return normalized<uint8_t>(source, components);
    case VertexFormat::Byte4N:
        return normalized<int8_t>(source, components);
    case VertexFormat::UShort2N:
    case VertexFormat::UShort4N:
        return normalized<uint16_t>(source, components);
    case VertexFormat::Short2N:
    case VertexFormat::Short4N:
        return normalized<int16_t>(source, components);
    default:
        return std::nullopt;
    }
}

namespace {

/// Null: this stream has none.
backend::VertexAttribute const* positionOf(backend::VertexLayout const& layout, uint8_t stream) {
    const auto attributes = std::span(layout.attributes).first(layout.attributeCount);
    const auto found = std::ranges::find(attributes, shader::kAttributePosition, &backend::VertexAttribute::location);
    return found != attributes.end() && found->buffer == stream ? &*found : nullptr;
}

template <class Visit>
void forEachPosition(backend::VertexLayout const& layout, std::span<const std::byte> vertices, uint8_t stream,
                     Visit const& visit) {
    backend::VertexAttribute const* const found = positionOf(layout, stream);
    if (!found) return;
    const size_t stride = layout.buffers[stream].stride;
    for (size_t at = 0; at + stride <= vertices.size(); at += stride) {
        if (const std::optional<double3> position = positionAt(&vertices[at + found->offset], found->format))
            visit(*position);
    }
}

} // namespace

std::vector<float3> positionsOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices) {
    std::vector<float3> positions;
    forEachPosition(layout, vertices, 0, [&](double3 const& position) { positions.emplace_back(position); });
    return positions;
}

bool hasPositions(backend::VertexLayout const& layout, uint8_t stream) { return positionOf(layout, stream) != nullptr; }

MinMax boundsOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices, uint8_t stream) {
    MinMax bounds;
    forEachPosition(layout, vertices, stream, [&](double3 const& position) {
        if (std::isfinite(position.x + position.y + position.z)) bounds.add(float3(position));
    });
    return bounds;
}

std::vector<uint32_t> indicesOf(backend::IndexFormat format, std::span<const std::byte> indices) {
    const auto read = [&]<class Index>(Index index) {
        std::vector<uint32_t> all(indices.size() / sizeof index);
        for (size_t i = 0; i < all.size(); ++i) {
            std::memcpy(&index, &indices[i * sizeof index], sizeof index);
            all[i] = index;
        }
        return all;
    };
    return format == backend::IndexFormat::UInt16 ? read(uint16_t{}) : read(uint32_t{});
}

} // namespace filament_core::scene
