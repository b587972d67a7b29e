// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Geometry.h"

#include "base/Assert.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace filament_core::reference {
namespace {

using assets::PrimitiveData;
using backend::VertexFormat;

template <class T>
T read(const std::byte* source) {
    T value;
    std::memcpy(&value, source, sizeof value);
    return value;
}

// Vulkan 1.3, "Conversion from Normalized Fixed-Point to Floating-Point": the most negative integer is -1 as well.
template <class Integer>
float4 readNormalized(const std::byte* source, int components) {
    constexpr auto kOne = static_cast<float>(std::numeric_limits<Integer>::max());
    float4 value(0, 0, 0, 1);
    for (int i = 0; i < components; ++i) {
        const auto integer = read<Integer>(source + static_cast<size_t>(i) * sizeof(Integer));
        value[i] = std::max(static_cast<float>(integer) / kOne, -1.0f);
    }
    return value;
}

float4 readFloats(const std::byte* source, int components) {
    float4 value(0, 0, 0, 1);
    std::memcpy(&value[0], source, static_cast<size_t>(components) * sizeof(float));
    return value;
}

float4 readAttribute(const std::byte* source, VertexFormat format) {
    const int components = backend::vertexFormatInfo(format).components;
    switch (format) {
    case VertexFormat::Float:
    case VertexFormat::Float2:
    case VertexFormat::Float3:
    case VertexFormat::Float4:
        return readFloats(source, components);
    case VertexFormat::UByte4N:
        return readNormalized<uint8_t>(source, components);
    case VertexFormat::Byte4N:
        return readNormalized<int8_t>(source, components);
    case VertexFormat::UShort2N:
    case VertexFormat::UShort4N:
        return readNormalized<uint16_t>(source, components);
    case VertexFormat::Short2N:
    case VertexFormat::Short4N:
        return readNormalized<int16_t>(source, components);
    default:
        FILAMENT_ASSERT(false, "models are packed in formats that the shader reads as floats");
    }
    return float4(0.0f);
}

double3 normalizedOrZero(double3 v) {
    const double length = glm::length(v);
    return length > 1e-15 ? v / length : double3(0.0);
}

// The inverse transpose times the determinant: it exists for singular transforms, too.
double3x3 cofactors(double3x3 const& m) {
    return { glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]) };
}

void placeFrames(PrimitiveData const& primitive, double4x4 const& worldFromObject, Part& part) {
    const double3x3 linear(worldFromObject);
    const double side = part.isMirrored ? -1 : 1;
    const double3x3 normalMatrix = cofactors(linear) * side;
    const std::vector<float4> frames = decodeAttribute(primitive, shader::kAttributeTangents);
    part.normals.resize(primitive.vertexCount, double3(0.0));
    part.tangents.resize(primitive.vertexCount, double4(0, 0, 0, side));
    for (size_t i = 0; i < frames.size(); ++i) {
        double3 normal, tangent, bitangent;
        shader::lib64::tangentFrame(double4(frames[i]), normal, tangent, bitangent);
        part.normals[i] = normalizedOrZero(normalMatrix * normal);
        part.tangents[i] = double4(normalizedOrZero(linear * tangent), frames[i].w < 0 ? -side : side);
    }
}

struct Corners {
    size_t a, b, c;
    double wa, wb, wc;

    template <class T>
    auto mix(std::vector<T> const& values) const {
        using Wide = glm::vec<T::length(), double, glm::defaultp>;
        return Wide(values[a]) * wa + Wide(values[b]) * wb + Wide(values[c]) * wc;
    }
};

Corners cornersOf(Part const& part, TrianglePoint const& point) {
    const uint32_t* const indices = &part.indices[size_t(point.triangle) * 3];
    return { indices[0], indices[1], indices[2], 1 - point.u - point.v, point.u, point.v };
}

} // namespace

std::vector<float4> decodeAttribute(PrimitiveData const& primitive, uint8_t location) {
    std::vector<float4> values;
    for (uint8_t i = 0; i < primitive.layout.attributeCount; ++i) {
        backend::VertexAttribute const& attribute = primitive.layout.attributes[i];
        if (attribute.location != location) continue;
        const size_t stride = primitive.layout.buffers[0].stride;
        values.resize(primitive.vertexCount);
        for (size_t vertex = 0; vertex < values.size(); ++vertex) {
            values[vertex] = readAttribute(&primitive.vertices[vertex * stride + attribute.offset], attribute.format);
        }
    }
    return values;
}

std::vector<uint32_t> decodeIndices(PrimitiveData const& primitive) {
    std::vector<uint32_t> indices(primitive.indexCount);
    for (size_t i = 0; i < indices.size(); ++i) {
        indices[i] = primitive.indexFormat == backend::IndexFormat::UInt16 ? read<uint16_t>(&primitive.indices[i * 2])
                                                                           : read<uint32_t>(&primitive.indices[i * 4]);
    }
    return indices;
}

Part makePart(PrimitiveData const& primitive, double4x4 const& worldFromObject, double3 origin) {
    Part part;
    part.isMirrored = glm::determinant(double3x3(worldFromObject)) < 0;
    part.tangentBasis = primitive.tangentBasis;
    part.indices = decodeIndices(primitive);
    part.indices.resize(part.indices.size() / 3 * 3);
    for (float4 const& position : decodeAttribute(primitive, shader::kAttributePosition)) {
        const double3 world(worldFromObject * double4(double3(position), 1.0));
        part.positions.push_back(float3(world - origin));
    }
    placeFrames(primitive, worldFromObject, part);
    part.colors = decodeAttribute(primitive, shader::kAttributeColor);
    for (uint8_t set = 0; set < 2; ++set) {
        const auto location = static_cast<uint8_t>(shader::kAttributeUv0 + set);
        for (float4 const& uv : decodeAttribute(primitive, location)) part.uvs[set].emplace_back(uv.x, uv.y);
    }
    for (float4 const& others : decodeAttribute(primitive, shader::kAttributeCustom0)) {
        part.uvs[2].emplace_back(others.x, others.y);
        part.uvs[3].emplace_back(others.z, others.w);
    }
    return part;
}

double3 faceNormal(Part const& part, uint32_t triangle) {
    const uint32_t* const indices = &part.indices[size_t(triangle) * 3];
    const double3 a(part.positions[indices[0]]), b(part.positions[indices[1]]), c(part.positions[indices[2]]);
    return glm::cross(b - a, c - a) * (part.isMirrored ? -1.0 : 1.0);
}

Varyings colorVaryingsAt(Part const& part, TrianglePoint const& point) {
    const Corners corners = cornersOf(part, point);
    Varyings varyings;
    if (!part.colors.empty()) varyings.color = corners.mix(part.colors);
    for (size_t set = 0; set < std::size(part.uvs); ++set) {
        if (!part.uvs[set].empty()) varyings.uvs[set] = corners.mix(part.uvs[set]);
    }
    return varyings;
}

Varyings varyingsAt(Part const& part, TrianglePoint const& point) {
    const Corners corners = cornersOf(part, point);
    Varyings varyings = colorVaryingsAt(part, point);
    varyings.position = corners.mix(part.positions);
    varyings.faceNormal = normalizedOrZero(faceNormal(part, point.triangle));
    const double3 a(part.positions[corners.a]), b(part.positions[corners.b]), c(part.positions[corners.c]);
    varyings.longestEdge = std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) });
    varyings.edges[0] = b - a;
    varyings.edges[1] = c - a;
    for (size_t set = 0; set < std::size(part.uvs); ++set) {
        std::vector<float2> const& uvs = part.uvs[set];
        if (uvs.empty()) continue;
        varyings.uvEdges[set][0] = double2(uvs[corners.b]) - double2(uvs[corners.a]);
        varyings.uvEdges[set][1] = double2(uvs[corners.c]) - double2(uvs[corners.a]);
    }
    varyings.normal = corners.mix(part.normals);
    varyings.tangent = corners.mix(part.tangents);
    return varyings;
}

} // namespace filament_core::reference
