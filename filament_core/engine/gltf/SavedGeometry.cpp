// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/RecordingGuards.h"
#include "base/math/Half.h"
#include "filament_core/engine/PixelReads.h"
#include "filament_core/engine/gltf/SaveContext.h"

#include <filament_core/Mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// As glTF numbers what the integers and floats of a vertex format are.
uint32_t componentOf(VertexFormat format) {
    switch (format) {
    case VertexFormat::Byte4N:
        return 5120;
    case VertexFormat::UByte4:
    case VertexFormat::UByte4N:
        return 5121;
    case VertexFormat::Short4N:
        return 5122;
    case VertexFormat::UShort4:
    case VertexFormat::UShort4N:
        return 5123;
    default:
        return 5126;
    }
}

template <class T>
std::vector<std::byte> bytesOfAll(std::vector<T> const& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return { bytes.begin(), bytes.end() };
}

template <class Integer>
std::vector<std::byte> integersOf(std::vector<float4> const& values, float one) {
    std::vector<Integer> integers;
    for (float4 const& value : values)
        for (int i = 0; i < 4; ++i) integers.push_back(static_cast<Integer>(std::lround(value[i] * one)));
    return bytesOfAll(integers);
}

/// In the format that the vertices have where glTF has it, too, so that the device converts the same numbers; else as
/// floats.
assets::GltfMergeAttribute attributeOf(std::string name, std::vector<float4> const& values, VertexFormat format) {
    const uint32_t component = componentOf(format);
    const bool isNormalized = component != 5126 && backend::vertexFormatInfo(format).normalized;
    assets::GltfMergeAttribute attribute{ std::move(name), {}, component, isNormalized };
    if (component == 5120) attribute.bytes = integersOf<int8_t>(values, 127);
    if (component == 5121) attribute.bytes = integersOf<uint8_t>(values, isNormalized ? 255.0f : 1.0f);
    if (component == 5122) attribute.bytes = integersOf<int16_t>(values, 32767);
    if (component == 5123) attribute.bytes = integersOf<uint16_t>(values, isNormalized ? 65535.0f : 1.0f);
    if (component == 5126) attribute.bytes = bytesOfAll(values);
    return attribute;
}

/// Frames, with the normals that other programs read, and the tangents if morph targets change them.
void addFrames(std::vector<float4> const& frames, VertexFormat format, bool hasTangents, GltfMergePrimitive& to) {
    for (float4 const& quaternion : frames) {
        const TangentFrame frame = frameOf(quaternion);
        const float3 normal = glm::normalize(frame.normal), tangent = glm::normalize(frame.tangent);
        to.own.normals.push_back(normal);
        const bool isMirrored = glm::dot(glm::cross(normal, tangent), frame.bitangent) < 0;
        if (hasTangents) to.own.tangents.emplace_back(tangent, isMirrored ? -1.0f : 1.0f);
    }
    if (!frames.empty()) to.attributes.push_back(attributeOf("_FILAMENT_TANGENTS", frames, format));
}

struct SkinAttributes {
    std::array<std::vector<float4>, 2> joints, weights;
    std::array<VertexFormat, 2> weightFormats{ VertexFormat::Float4, VertexFormat::Float4 };
};

/// Gives a joint that a vertex names before the weight of the slot, too.
void joinEqual(SkinAttributes& skin, size_t vertex, size_t slot) {
    float const joint = skin.joints[slot / 4][vertex][static_cast<int>(slot % 4)];
    float& weight = skin.weights[slot / 4][vertex][static_cast<int>(slot % 4)];
    for (size_t i = 0; i < slot && weight > 0; ++i) {
        float& earlier = skin.weights[i / 4][vertex][static_cast<int>(i % 4)];
        if (!(earlier > 0) || skin.joints[i / 4][vertex][static_cast<int>(i % 4)] != joint) continue;
        earlier += weight;
        weight = 0;
    }
}

/// What glTF 2.0 asks for in 3.7.3.3: joints that exist, each once, 0 without a weight, and weights with a sum of 1.
bool repairVertex(SkinAttributes& skin, size_t vertex, size_t jointCount) {
    for (size_t slot = 0; slot < 8; ++slot) {
        if (skin.joints[slot / 4].empty()) continue;
        float& joint = skin.joints[slot / 4][vertex][static_cast<int>(slot % 4)];
        float& weight = skin.weights[slot / 4][vertex][static_cast<int>(slot % 4)];
        if (joint >= static_cast<float>(jointCount)) joint = 0;
        joinEqual(skin, vertex, slot);
        if (!(weight > 0)) joint = weight = 0;
    }
    double sum = 0;
    int used = 0;
    for (std::vector<float4> const& weights : skin.weights)
        for (int k = 0; k < 4 && !weights.empty(); ++k) {
            sum += static_cast<double>(weights[vertex][k]);
            used += weights[vertex][k] > 0;
        }
    if (std::abs(sum - 1) <= 2e-7 * std::max(used, 1)) return false;
    if (!(sum > 0)) skin.weights[0][vertex].x = 1;
    for (std::vector<float4>& weights : skin.weights)
        if (sum > 0 && !weights.empty()) weights[vertex] *= static_cast<float>(1 / sum);
    return true;
}

/// Returns how many vertices had to be changed.
size_t addSkin(SkinAttributes skin, size_t jointCount, GltfMergePrimitive& to) {
    size_t changed = 0;
    for (size_t set = 0; set < 2; ++set)
        if (skin.joints[set].empty() || skin.weights[set].empty()) skin.joints[set].clear(), skin.weights[set].clear();
    for (size_t i = 0; i < to.own.positions.size() && !skin.joints[0].empty(); ++i)
        changed += repairVertex(skin, i, jointCount);
    for (size_t set = 0; set < 2; ++set) {
        if (skin.joints[set].empty()) continue;
        const bool isNarrow = jointCount <= 256;
        to.attributes.push_back(attributeOf(fmt::format("JOINTS_{}", set), skin.joints[set],
                                            isNarrow ? VertexFormat::UByte4 : VertexFormat::UShort4));
        to.attributes.push_back(attributeOf(fmt::format("WEIGHTS_{}", set), skin.weights[set],
                                            changed > 0 ? VertexFormat::Float4 : skin.weightFormats[set]));
    }
    return changed;
}

/// What the material, the skin or the morph targets read.
bool isWritten(Attribute which, scene::Material const& material, scene::Deformation const* deformation) {
    switch (which) {
    case Attribute::Position:
        return true;
    case Attribute::Tangents:
        return material.isLit();
    case Attribute::Color:
    case Attribute::Uv0:
        return (material.package.requiredAttributes >> static_cast<uint32_t>(which) & 1) != 0;
    case Attribute::Joints:
    case Attribute::Joints1:
    case Attribute::Weights:
    case Attribute::Weights1:
        return deformation && deformation->skin;
    default:
        return false;
    }
}

void addAttribute(Attribute which, VertexFormat format, std::vector<float4> values,
                  scene::Deformation const* deformation, SkinAttributes& skin, GltfMergePrimitive& to) {
    const size_t set = which == Attribute::Joints1 || which == Attribute::Weights1 ? 1 : 0;
    const bool isShare = format == VertexFormat::UByte4N || format == VertexFormat::UShort4N;
    const bool isSigned = format == VertexFormat::Byte4N || format == VertexFormat::Short4N;
    switch (which) {
    case Attribute::Position:
        for (float4 const& v : values) to.own.positions.emplace_back(v);
        break;
    case Attribute::Tangents:
        addFrames(values, isSigned ? format : VertexFormat::Float4,
                  deformation && deformation->morph && deformation->morph->texels > 2, to);
        break;
    case Attribute::Color:
        to.attributes.push_back(attributeOf("COLOR_0", values, isShare ? format : VertexFormat::Float4));
        break;
    case Attribute::Joints:
    case Attribute::Joints1:
        skin.joints[set] = std::move(values);
        break;
    case Attribute::Weights:
    case Attribute::Weights1:
        skin.weights[set] = std::move(values);
        skin.weightFormats[set] = isShare ? format : VertexFormat::Float4;
        break;
    case Attribute::Uv0: // v of the engine's materials points up
        for (float4 const& v : values) to.own.uvs.emplace_back(v.x, 1 - v.y);
        break;
    default:
        break;
    }
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

Result<void> SavedGeometry::addTargets(scene::MorphTargets const& morph, std::span<const uint32_t> used,
                                       GltfMergePrimitive& primitive) {
    TextureState const* const texture = stateBehind(mContext.engine.textures, morph.deltas);
    if (!texture || morph.targetCount == 0) return {};
    std::vector<std::byte>& texels = mDeltas[morph.deltas.index()];
    if (texels.empty()) {
        Result<std::vector<std::byte>> read = readBack(mContext.engine, *texture);
        if (!read) return read.error();
        texels = std::move(*read);
    }
    const size_t count = size_t{ morph.targetCount } * morph.vertexCount * morph.texels;
    if (texels.size() < count * sizeof(float4))
        return fail(ErrorCode::DeviceUnavailable, "the device did not give the morph targets of a mesh back");
    for (size_t target = 0; target < morph.targetCount; ++target) {
        assets::MorphTargetData& data = primitive.targets.emplace_back();
        for (const uint32_t vertex : used) {
            const size_t at = (target * morph.vertexCount + vertex) * morph.texels;
            const auto delta = [&](size_t part) { return float3(loadAt<float4>(texels.data(), at + part)); };
            data.positions.push_back(delta(0));
            if (morph.texels > 1 && !primitive.own.normals.empty()) data.normals.push_back(delta(1));
            if (morph.texels > 2 && !primitive.own.tangents.empty()) data.tangents.push_back(delta(2));
        }
    }
    return {};
}

Result<GltfMergePrimitive> SavedGeometry::read(Renderable renderable) {
    scene::Drawable const& drawable = mContext.drawableOf(renderable);
    scene::Geometry const& geometry = drawable.geometry;
    scene::Material const& material = *drawable.material->material;
    scene::Deformation const* const deformation = mContext.deformationOf(renderable);
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
    SkinAttributes skin;
    for (uint8_t i = 0; i < vertices->layout.attributeCount; ++i) {
        backend::VertexAttribute const& attribute = vertices->layout.attributes[i];
        const auto which = static_cast<Attribute>(attribute.location);
        if (!isWritten(which, material, deformation)) continue;
        std::byte const* const from = streams[attribute.buffer] + attribute.offset;
        const size_t stride = vertices->layout.buffers[attribute.buffer].stride;
        std::vector<float4> values;
        for (const uint32_t vertex : used)
            values.push_back(vectorAt(from + size_t{ vertex } * stride, attribute.format));
        addAttribute(which, attribute.format, std::move(values), deformation, skin, primitive);
    }
    if (deformation && deformation->skin) {
        const size_t bones = mContext.scene.data.deformations.skin(deformation->skin).bones.size();
        if (const size_t changed = addSkin(std::move(skin), bones, primitive); changed > 0)
            mContext.warn("'{}': weights of {} vertices did not have a sum of 1 and were scaled, as glTF wants them",
                          vertices->name, changed);
    }
    if (deformation && deformation->morph)
        if (Result<void> added = addTargets(*deformation->morph, used, primitive); !added) return added.error();
    return primitive;
}

} // namespace filament_core::engine
