// SPDX-License-Identifier: Apache-2.0
#include "base/Hash.h"
#include "base/math/Half.h"
#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/gltf/GltfGeometry.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

using backend::VertexFormat;

template <class Integer>
Integer normalizedInteger(float value) {
    constexpr auto kOne = static_cast<float>(std::numeric_limits<Integer>::max());
    const float low = std::is_signed_v<Integer> ? -kOne : 0.0f;
    return static_cast<Integer>(std::lround(std::clamp(value * kOne, low, kOne)));
}

template <class Integer, int N>
void writeIntegers(std::byte* target, float const* values) {
    std::array<Integer, N> integers;
    for (size_t i = 0; i < N; ++i) integers[i] = normalizedInteger<Integer>(values[i]);
    std::memcpy(target, integers.data(), sizeof integers);
}

/// Writes one vertex attribute; `value` has four components.
using Writer = void (*)(std::byte* target, float const* value);

template <int N>
void writeFloats(std::byte* target, float const* values) {
    std::memcpy(target, values, N * sizeof(float));
}

void writeHalves(std::byte* target, float const* values) {
    std::array<uint16_t, 4> halves;
    for (size_t i = 0; i < 4; ++i) halves[i] = halfFromFloat(values[i]);
    std::memcpy(target, halves.data(), sizeof halves);
}

Writer writerOf(VertexFormat format) {
    switch (format) {
    case VertexFormat::Float2:
        return writeFloats<2>;
    case VertexFormat::Float3:
        return writeFloats<3>;
    case VertexFormat::Float4:
        return writeFloats<4>;
    case VertexFormat::Half4:
        return writeHalves;
    case VertexFormat::Byte4N:
        return writeIntegers<int8_t, 4>;
    case VertexFormat::UByte4N:
        return writeIntegers<uint8_t, 4>;
    case VertexFormat::Short2N:
        return writeIntegers<int16_t, 2>;
    case VertexFormat::UShort2N:
        return writeIntegers<uint16_t, 2>;
    case VertexFormat::Short4N:
        return writeIntegers<int16_t, 4>;
    case VertexFormat::UShort4N:
        return writeIntegers<uint16_t, 4>;
    default:
        FILAMENT_ASSERT(false, "vertices are packed in formats that the shader reads as floats");
    }
    return nullptr;
}

/// Builds the layout attribute by attribute, then fills the stream column by column.
class Interleaver {
public:
    explicit Interleaver(PrimitiveData& primitive) : mPrimitive(primitive), mLayout(primitive.layout) {}

    uint16_t addAttribute(uint8_t location, VertexFormat format) {
        const uint16_t offset = mLayout.buffers[0].stride;
        mLayout.attributes[mLayout.attributeCount++] = { .location = location, .format = format, .offset = offset };
        mLayout.buffers[0].stride = static_cast<uint16_t>(offset + backend::vertexFormatInfo(format).bytes);
        mLayout.bufferCount = 1;
        return offset;
    }

    void allocate() { mPrimitive.vertices.resize(size_t{ mPrimitive.vertexCount } * mLayout.buffers[0].stride); }

    std::byte* at(size_t vertex, uint16_t offset) {
        return &mPrimitive.vertices[vertex * mLayout.buffers[0].stride + offset];
    }

    template <class T>
    void write(std::vector<T> const& values, uint16_t offset, VertexFormat format) {
        const Writer writer = writerOf(format);
        for (size_t i = 0; i < values.size(); ++i) {
            float4 padded(0.0f, 0.0f, 0.0f, 1.0f);
            std::memcpy(&padded[0], &values[i][0], sizeof(T));
            writer(at(i, offset), &padded[0]);
        }
    }

private:
    PrimitiveData& mPrimitive;
    backend::VertexLayout& mLayout;
};

void findBounds(std::vector<float3> const& positions, PrimitiveData& primitive) {
    primitive.boundsMin = primitive.boundsMax = positions[0];
    for (float3 const& position : positions) {
        primitive.boundsMin = glm::min(primitive.boundsMin, position);
        primitive.boundsMax = glm::max(primitive.boundsMax, position);
    }
}

VertexFormat formatOf(TangentStorage storage) {
    switch (storage) {
    case TangentStorage::Snorm16:
        return VertexFormat::Short4N;
    case TangentStorage::Snorm8:
        return VertexFormat::Byte4N;
    case TangentStorage::Float:
        break;
    }
    return VertexFormat::Float4;
}

VertexFormat frameFormat(GltfGeometry const& geometry, TangentStorage storage) {
    return geometry.frames.empty() ? formatOf(storage) : geometry.frameFormat;
}

/// Those of the file, or of its normals and tangents: w keeps its sign when it is rounded, because it is at least one
/// integer step.
std::vector<float4> framesOf(GltfGeometry const& geometry, TangentStorage storage) {
    if (!geometry.frames.empty()) return geometry.frames;
    const float leastW = storage == TangentStorage::Snorm8 ? 1.0f / 127 : 1.0f / 32767;
    std::vector<float4> frames(geometry.normals.size());
    for (size_t i = 0; i < frames.size(); ++i) {
        const float4 tangent = geometry.tangents.empty() ? float4(0, 0, 0, 1) : geometry.tangents[i];
        frames[i] = tangentFrameQuaternion(geometry.normals[i], float3(tangent), tangent.w, leastW);
    }
    return frames;
}

/// Maps positions to [0, 1]^3 by the same factor on all axes, so that normals and tangents stay valid.
void fitUnitCube(GltfGeometry& geometry, PrimitiveData& primitive) {
    findBounds(geometry.positions, primitive);
    const float3 size = primitive.boundsMax - primitive.boundsMin;
    const float largest = std::max({ size.x, size.y, size.z });
    primitive.positionOffset = primitive.boundsMin;
    primitive.positionScale = largest > 0 ? largest : 1.0f;
    for (float3& position : geometry.positions)
        position = (position - primitive.positionOffset) / primitive.positionScale;
}

/// Positions beyond the largest half float stay floats.
void storePositions(PositionStorage storage, GltfGeometry& geometry, PrimitiveData& primitive) {
    if (storage == PositionStorage::AsAuthored) return;
    if (storage == PositionStorage::Unorm16) {
        fitUnitCube(geometry, primitive);
        geometry.positionFormat = VertexFormat::UShort4N;
        return;
    }
    const bool fits = std::ranges::all_of(geometry.positions, [](float3 const& p) {
        return std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }) <= kMaxHalf;
    });
    if (fits) geometry.positionFormat = VertexFormat::Half4;
}

/// 16-bit indices if 0xFFFF, which restarts strips on some APIs, stays unused.
void packIndices(std::span<const uint32_t> indices, PrimitiveData& primitive) {
    const bool isShort = primitive.vertexCount < 65536;
    primitive.indexFormat = isShort ? backend::IndexFormat::UInt16 : backend::IndexFormat::UInt32;
    primitive.indexCount = static_cast<uint32_t>(indices.size());
    primitive.indices.resize(indices.size() * (isShort ? 2 : 4));
    for (size_t i = 0; i < indices.size(); ++i) {
        const auto narrow = static_cast<uint16_t>(indices[i]);
        if (isShort) std::memcpy(&primitive.indices[i * 2], &narrow, 2);
        if (!isShort) std::memcpy(&primitive.indices[i * 4], &indices[i], 4);
    }
}

/// Merges equal vertices of unindexed geometry, where they are common, in the order of their first use. `table` is a
/// hash table with open addressing, at most half full.
void weldEqualVertices(std::vector<uint32_t>& indices, PrimitiveData& primitive) {
    const size_t stride = primitive.layout.buffers[0].stride;
    std::vector<uint32_t> remap(primitive.vertexCount),
            table(std::bit_ceil(size_t{ primitive.vertexCount } * 2), kNone);
    uint32_t unique = 0;
    for (uint32_t i = 0; i < primitive.vertexCount; ++i) {
        const std::byte* vertex = &primitive.vertices[i * stride];
        size_t slot = hashBytes({ vertex, stride });
        while (true) {
            uint32_t& entry = table[slot++ & (table.size() - 1)];
            if (entry == kNone) { // kept vertices move to the front, into the place of one that is not needed any more
                entry = unique++;
                std::memmove(&primitive.vertices[entry * stride], vertex, stride);
            } else if (std::memcmp(&primitive.vertices[entry * stride], vertex, stride) != 0) {
                continue;
            }
            remap[i] = entry;
            break;
        }
    }
    for (uint32_t& index : indices) index = remap[index];
    primitive.vertices.resize(unique * stride);
    primitive.vertexCount = unique;
}

/// The third and the fourth set of texture coordinates, in one attribute; empty if there is neither.
std::vector<float4> otherUvs(GltfGeometry const& geometry) {
    std::vector<float2> const &third = geometry.uvs[2], &fourth = geometry.uvs[3];
    std::vector<float4> both(std::max(third.size(), fourth.size()), float4(0));
    for (size_t i = 0; i < third.size(); ++i) both[i].x = third[i].x, both[i].y = third[i].y;
    for (size_t i = 0; i < fourth.size(); ++i) both[i].z = fourth[i].x, both[i].w = fourth[i].y;
    return both;
}

struct SkinOffsets {
    std::array<uint16_t, GltfAttributes::kJointSets> joints{}, weights{};
    bool isWide = false; ///< joints of 16 bits: glTF has no wider ones
};

bool hasWideJoints(GltfGeometry const& geometry) {
    return std::ranges::any_of(geometry.joints, [](std::vector<GltfGeometry::JointIndices> const& set) {
        return std::ranges::any_of(set,
                                   [](auto joints) { return ((joints.x | joints.y | joints.z | joints.w) >> 8) != 0; });
    });
}

SkinOffsets addJoints(GltfGeometry const& geometry, Interleaver& interleaver) {
    constexpr std::array<uint8_t, 2> kJoints{ shader::kAttributeJoints, shader::kAttributeJoints1 };
    constexpr std::array<uint8_t, 2> kWeights{ shader::kAttributeWeights, shader::kAttributeWeights1 };
    SkinOffsets at{ .isWide = hasWideJoints(geometry) };
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        if (geometry.joints[set].empty()) continue;
        at.joints[set] =
                interleaver.addAttribute(kJoints[set], at.isWide ? VertexFormat::UShort4 : VertexFormat::UByte4);
        at.weights[set] = interleaver.addAttribute(kWeights[set], geometry.weightFormat);
    }
    return at;
}

void writeJoints(GltfGeometry const& geometry, SkinOffsets const& at, Interleaver& interleaver) {
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        interleaver.write(geometry.weights[set], at.weights[set], geometry.weightFormat);
        for (size_t i = 0; i < geometry.joints[set].size(); ++i) {
            const glm::u16vec4 wide(geometry.joints[set][i]);
            const glm::u8vec4 narrow(wide);
            std::memcpy(interleaver.at(i, at.joints[set]), at.isWide ? static_cast<void const*>(&wide) : &narrow,
                        at.isWide ? sizeof wide : sizeof narrow);
        }
    }
}

} // namespace

PrimitiveData packGeometry(GltfGeometry geometry, GeometryStorage const& storage) {
    PrimitiveData primitive;
    const bool isDeformed = geometry.isSkinned || !geometry.targets.empty();
    // Bones and morph targets are in the space of the file, so positions stay in it, too.
    storePositions(isDeformed && storage.positions == PositionStorage::Unorm16 ? PositionStorage::AsAuthored
                                                                               : storage.positions,
                   geometry, primitive);
    primitive.topology = geometry.topology;
    primitive.vertexCount = geometry.vertexCount();
    primitive.hasNormals = !geometry.normals.empty();
    primitive.hasTangents = primitive.hasNormals &&
                            (geometry.topology == backend::PrimitiveType::Triangles || !geometry.tangents.empty());
    primitive.hasColor = !geometry.colors.empty();
    primitive.hasUv0 = !geometry.uvs[0].empty();
    primitive.hasUv1 = !geometry.uvs[1].empty();

    Interleaver interleaver(primitive);
    const auto add = [&](bool exists, uint8_t location, VertexFormat format) {
        return exists ? interleaver.addAttribute(location, format) : uint16_t{ 0 };
    };
    const uint16_t position = add(true, shader::kAttributePosition, geometry.positionFormat);
    const uint16_t frame =
            add(primitive.hasNormals, shader::kAttributeTangents, frameFormat(geometry, storage.tangents));
    const uint16_t color = add(primitive.hasColor, shader::kAttributeColor, geometry.colorFormat);
    const uint16_t uv0 = add(primitive.hasUv0, shader::kAttributeUv0, geometry.uvFormats[0]);
    const uint16_t uv1 = add(primitive.hasUv1, shader::kAttributeUv1, geometry.uvFormats[1]);
    const std::vector<float4> others = otherUvs(geometry);
    const uint16_t uv23 = add(!others.empty(), shader::kAttributeCustom0, VertexFormat::Float4);
    const SkinOffsets skin = geometry.isSkinned ? addJoints(geometry, interleaver) : SkinOffsets{};
    // All attributes are added before the first write: every one changes the stride.
    interleaver.allocate();
    interleaver.write(geometry.positions, position, geometry.positionFormat);
    interleaver.write(framesOf(geometry, storage.tangents), frame, frameFormat(geometry, storage.tangents));
    interleaver.write(geometry.colors, color, geometry.colorFormat);
    interleaver.write(geometry.uvs[0], uv0, geometry.uvFormats[0]);
    interleaver.write(geometry.uvs[1], uv1, geometry.uvFormats[1]);
    interleaver.write(others, uv23, VertexFormat::Float4);

    if (geometry.isSkinned) writeJoints(geometry, skin, interleaver);
    primitive.isSkinned = geometry.isSkinned;
    primitive.boneBounds = boundsOfBones(geometry);

    findBounds(geometry.positions, primitive);
    primitive.morphTargets = std::move(geometry.targets);
    // With morph targets, vertices that are equal now may move apart.
    if (!geometry.wasIndexed && primitive.morphTargets.empty()) weldEqualVertices(geometry.indices, primitive);
    packIndices(geometry.indices, primitive);
    return primitive;
}

} // namespace filament_core::assets
