// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/RecordingGuards.h"
#include "base/math/Half.h"
#include "filament_core/engine/PixelReads.h"
#include "filament_core/engine/gltf/SaveContext.h"

#include <filament_core/Mesh.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::engine {
namespace {

using assets::GltfMergePrimitive;
using assets::kNone;

template <class T>
T loadAt(const std::byte* from, size_t index) {
    T value;
    std::memcpy(&value, from + index * sizeof(T), sizeof(T));
    return value;
}

/// As the shader reads it: components that the format lacks are 0, 0, 0, 1.
float4 vectorAt(const std::byte* from, VertexFormat format) {
    const backend::VertexFormatInfo info = backend::vertexFormatInfo(format);
    float4 vector(0, 0, 0, 1);
    const auto snorm = [](float value, float most) { return std::max(value / most, -1.0f); };
    for (uint8_t i = 0; i < info.components; ++i) {
        switch (format) {
        case VertexFormat::Half2:
        case VertexFormat::Half4:
            vector[i] = floatFromHalf(loadAt<uint16_t>(from, i));
            break;
        case VertexFormat::UByte4:
        case VertexFormat::UByte4N:
            vector[i] = static_cast<float>(loadAt<uint8_t>(from, i)) / (info.normalized ? 255.0f : 1.0f);
            break;
        case VertexFormat::Byte4:
        case VertexFormat::Byte4N:
            vector[i] = snorm(static_cast<float>(loadAt<int8_t>(from, i)), info.normalized ? 127.0f : 1.0f);
            break;
        case VertexFormat::UShort2:
        case VertexFormat::UShort2N:
        case VertexFormat::UShort4:
        case VertexFormat::UShort4N:
            vector[i] = static_cast<float>(loadAt<uint16_t>(from, i)) / (info.normalized ? 65535.0f : 1.0f);
            break;
        case VertexFormat::Short2:
        case VertexFormat::Short2N:
        case VertexFormat::Short4:
        case VertexFormat::Short4N:
            vector[i] = snorm(static_cast<float>(loadAt<int16_t>(from, i)), info.normalized ? 32767.0f : 1.0f);
            break;
        default:
            vector[i] = loadAt<float>(from, i);
        }
    }
    return vector;
}

/// glTF 2.0, section 3.7.2.1.
uint32_t modeOf(PrimitiveType type) {
    switch (type) {
    case PrimitiveType::Points:
        return 0;
    case PrimitiveType::Lines:
        return 1;
    case PrimitiveType::LineStrip:
        return 3;
    case PrimitiveType::Triangles:
        return 4;
    case PrimitiveType::TriangleStrip:
        return 5;
    }
    return 4;
}

/// Gives each index of a mesh the place of its vertex among those that are used.
std::vector<uint32_t> usedVertices(std::vector<uint32_t>& indices, uint32_t vertexCount) {
    std::vector<uint32_t> places(vertexCount, kNone), used;
    for (uint32_t& index : indices) {
        uint32_t& place = places[std::min(index, vertexCount - 1)];
        if (place == kNone) {
            place = static_cast<uint32_t>(used.size());
            used.push_back(std::min(index, vertexCount - 1));
        }
        index = place;
    }
    return used;
}

template <class Record>
Result<std::vector<std::byte>> readBackBy(Engine::Impl& engine, Record const& record) {
    const backend::Ticket ticket = engine.stream->nextTicket();
    {
        backend::FrameCommands commands(*engine.stream);
        engine.drainPending(*commands);
        record(*commands, ticket);
    }
    return engine.stream->waitReadback(ticket);
}

} // namespace

Result<std::vector<std::byte>> readBack(Engine::Impl& engine, TextureState const& texture) {
    const backend::Rect all{ 0, 0, texture.desc.width, texture.desc.height };
    if (!texture.handle) return noImage(all.width, all.height);
    Result<std::vector<std::byte>> pixels =
            readBackBy(engine, [&](backend::CommandBuffer& commands, backend::Ticket ticket) {
                commands.record(backend::CmdReadTexture{ texture.handle, 0, 0, all, ticket });
            });
    if (pixels && pixels->empty()) return noImage(all.width, all.height);
    return pixels;
}

Result<std::vector<std::byte>> readBack(Engine::Impl& engine, backend::BufferHandle buffer, uint64_t bytes) {
    return readBackBy(engine, [&](backend::CommandBuffer& commands, backend::Ticket ticket) {
        commands.record(backend::CmdReadBuffer{ buffer, 0, bytes, ticket });
    });
}

Result<std::vector<std::byte> const*> SavedGeometry::bytesOf(backend::BufferHandle buffer, uint64_t bytes) {
    std::vector<std::byte>& kept = mBuffers[buffer.index()];
    if (!kept.empty()) return &kept;
    Result<std::vector<std::byte>> read = readBack(mContext.engine, buffer, bytes);
    if (!read) return read.error();
    if (read->size() != bytes)
        return fail(ErrorCode::DeviceUnavailable, "the device did not give {} bytes of a mesh back", bytes);
    kept = std::move(*read);
    return &kept;
}

Result<GltfMergePrimitive> SavedGeometry::read(scene::Geometry const& geometry, scene::Material const& material) {
    VertexBufferState const* const vertices = stateBehind(mContext.engine.vertexBuffers, geometry.vertices);
    IndexBufferState const* const indices = stateBehind(mContext.engine.indexBuffers, geometry.indices);
    GltfMergePrimitive primitive;
    if (!vertices || !indices || geometry.indexCount == 0) return primitive;
    std::array<std::byte const*, kMaxVertexStreams> streams{};
    for (uint8_t i = 0; i < vertices->layout.bufferCount; ++i) {
        const uint64_t bytes = uint64_t{ vertices->vertexCount } * vertices->layout.buffers[i].stride;
        const Result<std::vector<std::byte> const*> block =
                bytesOf(i == 0 ? vertices->handle : vertices->streams[i - 1u], bytes);
        if (!block) return block.error();
        streams[i] = (*block)->data();
    }
    const bool isShort = geometry.indexFormat == IndexFormat::UInt16;
    const Result<std::vector<std::byte> const*> list =
            bytesOf(geometry.indices, uint64_t{ indices->indexCount } * (isShort ? 2u : 4u));
    if (!list) return list.error();
    for (uint32_t i = geometry.firstIndex; i < geometry.firstIndex + geometry.indexCount; ++i)
        primitive.own.indices.push_back(isShort ? loadAt<uint16_t>((*list)->data(), i)
                                                : loadAt<uint32_t>((*list)->data(), i));
    primitive.mode = modeOf(mContext.engine.layouts[geometry.layout].topology);
    const std::vector<uint32_t> used = usedVertices(primitive.own.indices, vertices->vertexCount);
    const auto reads = [&](Attribute attribute) {
        return (material.package.requiredAttributes >> static_cast<uint32_t>(attribute) & 1) != 0;
    };
    for (uint8_t i = 0; i < vertices->layout.attributeCount; ++i) {
        backend::VertexAttribute const& attribute = vertices->layout.attributes[i];
        std::byte const* const from = streams[attribute.buffer] + attribute.offset;
        const size_t stride = vertices->layout.buffers[attribute.buffer].stride;
        const auto each = [&](auto const& add) {
            for (const uint32_t vertex : used) add(vectorAt(from + size_t{ vertex } * stride, attribute.format));
        };
        switch (static_cast<Attribute>(attribute.location)) {
        case Attribute::Position:
            each([&](float4 const& v) { primitive.own.positions.push_back(float3(v)); });
            break;
        case Attribute::Tangents:
            if (!material.isLit()) break;
            each([&](float4 const& v) { primitive.own.normals.push_back(glm::normalize(frameOf(v).normal)); });
            break;
        case Attribute::Color:
            if (reads(Attribute::Color)) each([&](float4 const& v) { primitive.own.colors.push_back(v); });
            break;
        case Attribute::Uv0: // v of the engine's materials points up
            if (reads(Attribute::Uv0)) each([&](float4 const& v) { primitive.own.uvs.emplace_back(v.x, 1 - v.y); });
            break;
        default:
            break;
        }
    }
    return primitive;
}

} // namespace filament_core::engine
