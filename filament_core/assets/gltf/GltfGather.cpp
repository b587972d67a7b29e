// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/Draco.h"
#include "filament_core/assets/gltf/GltfGeometry.h"

#include <algorithm>
#include <numeric>

namespace filament_core::assets {
namespace {

using backend::VertexFormat;

/// The formats that pass an accessor's normalized integers to the shader as floats; three components are stored as
/// four.
struct IntegerFormats {
    VertexFormat byte, ubyte, shorts, ushorts;
};
constexpr IntegerFormats kOfPositions{ VertexFormat::Byte4N, VertexFormat::UByte4N, VertexFormat::Short4N,
                                       VertexFormat::UShort4N };
constexpr IntegerFormats kOfUvs{ VertexFormat::Byte4N, VertexFormat::UByte4N, VertexFormat::Short2N,
                                 VertexFormat::UShort2N };
/// Colours and weights are not negative: signed values are read as floats.
constexpr IntegerFormats kOfShares{ VertexFormat::Float4, VertexFormat::UByte4N, VertexFormat::Float4,
                                    VertexFormat::UShort4N };

/// Of signed numbers.
constexpr IntegerFormats kOfFrames{ VertexFormat::Byte4N, VertexFormat::Float4, VertexFormat::Short4N,
                                    VertexFormat::Float4 };

VertexFormat formatOf(GltfAccessor const& accessor, IntegerFormats const& integers, VertexFormat floats) {
    if (!accessor.normalized) return floats;
    switch (accessor.component) {
    case ComponentType::Byte:
        return integers.byte;
    case ComponentType::UByte:
        return integers.ubyte;
    case ComponentType::Short:
        return integers.shorts;
    case ComponentType::UShort:
        return integers.ushorts;
    default:
        return floats;
    }
}

VertexFormat positionFormat(GltfAccessor const& accessor) {
    return formatOf(accessor, kOfPositions, VertexFormat::Float3);
}
VertexFormat uvFormat(GltfAccessor const& accessor) { return formatOf(accessor, kOfUvs, VertexFormat::Float2); }
VertexFormat shareFormat(GltfAccessor const& accessor) { return formatOf(accessor, kOfShares, VertexFormat::Float4); }

/// Reads the attributes of a primitive: from accessors, or from a Draco stream described by accessors.
class AttributeSource {
public:
    AttributeSource(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                    Diagnostics& diagnostics)
            : mDocument(document), mPath(path), mDiagnostics(diagnostics) {
        if (!primitive.draco) return;
        mDraco.emplace(document.viewBytes[primitive.draco->view], path, *document.dracoPatience, diagnostics);
    }

    DracoMesh const* draco() const { return mDraco ? &*mDraco : nullptr; }

    /// Vectors of `T`, one per vertex; empty if the primitive lacks the attribute. The first call determines the vertex
    /// count.
    template <class T>
    std::vector<T> read(uint32_t accessor, uint32_t dracoId, const char* name,
                        NonFinite nonFinite = NonFinite::BecomesZero) {
        std::vector<T> values;
        if (accessor == kNone || !mDiagnostics.ok()) return values;
        constexpr uint8_t kComponents = sizeof(T) / sizeof(float);
        if (mDraco && dracoId != kNone) {
            values.resize(mDraco->vertexCount());
            const std::span<float> numbers(reinterpret_cast<float*>(values.data()), values.size() * kComponents);
            if (mDraco->componentCount(dracoId) == 0) {
                mDiagnostics.refuse(ErrorCode::Corrupt, "{}: the Draco stream lacks {}", mPath, name);
            } else {
                mDraco->read(dracoId, kComponents, numbers);
                if (nonFinite == NonFinite::BecomesZero && replaceNonFinite(numbers) > 0)
                    mDiagnostics.warn("{}: {} has values that are not finite; they became 0", mPath, name);
            }
        } else {
            values = readVectors<T>(mDocument, accessor, name, mDiagnostics, nonFinite);
        }
        if (!mVertexCount) mVertexCount = values.size();
        if (values.size() != *mVertexCount) {
            mDiagnostics.refuse(ErrorCode::Corrupt, "{}: {} has {} elements, POSITION has {}", mPath, name,
                                values.size(), *mVertexCount);
        }
        return values;
    }

    /// Colours have three or four components, each in [0, 1] (glTF 2.0, 3.7.2.1); float accessors may exceed that
    /// range.
    std::vector<float4> readColors(uint32_t accessor, uint32_t dracoId) {
        std::vector<float4> colors = readAnyColors(accessor, dracoId);
        for (float4& color : colors) color = glm::clamp(color, 0.0f, 1.0f);
        return colors;
    }

    /// Joint indices are integers below 65536, which floats represent exactly.
    std::vector<GltfGeometry::JointIndices> readJoints(uint32_t accessor, uint32_t dracoId, const char* name) {
        std::vector<GltfGeometry::JointIndices> joints;
        for (float4 const& indices : read<float4>(accessor, dracoId, name)) {
            joints.emplace_back(glm::clamp(indices, 0.0f, 65535.0f));
        }
        return joints;
    }

private:
    std::vector<float4> readAnyColors(uint32_t accessor, uint32_t dracoId) {
        if (accessor == kNone) return {};
        const uint8_t components =
                mDraco && dracoId != kNone ? mDraco->componentCount(dracoId) : mDocument.accessors[accessor].components;
        if (components != 3) return read<float4>(accessor, dracoId, "COLOR_0");
        std::vector<float4> colors;
        for (float3 const& color : read<float3>(accessor, dracoId, "COLOR_0")) colors.emplace_back(color, 1.0f);
        return colors;
    }

    GltfDocument const& mDocument;
    std::string const& mPath;
    Diagnostics& mDiagnostics;
    std::optional<DracoMesh> mDraco;
    std::optional<size_t> mVertexCount;
};

void gatherAttributes(AttributeSource& source, GltfAttributes const& attributes, GltfAttributes const& ids,
                      GltfGeometry& geometry) {
    constexpr NonFinite kKept = NonFinite::IsKept; // GltfFinite.cpp repairs them
    geometry.positions = source.read<float3>(attributes.position, ids.position, "POSITION", kKept);
    geometry.normals = source.read<float3>(attributes.normal, ids.normal, "NORMAL", kKept);
    geometry.tangents = source.read<float4>(attributes.tangent, ids.tangent, "TANGENT", kKept);
    geometry.frames = source.read<float4>(attributes.frame, ids.frame, "_FILAMENT_TANGENTS");
    geometry.colors = source.readColors(attributes.color, ids.color);
    for (size_t set = 0; set < GltfAttributes::kUvSets; ++set) {
        const std::string name = fmt::format("TEXCOORD_{}", attributes.keptSets[set]);
        geometry.uvs[set] = source.read<float2>(attributes.uv[set], ids.uv[set], name.c_str());
    }
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        geometry.joints[set] =
                source.readJoints(attributes.joints[set], ids.joints[set], set == 0 ? "JOINTS_0" : "JOINTS_1");
        geometry.weights[set] =
                source.read<float4>(attributes.weights[set], ids.weights[set], set == 0 ? "WEIGHTS_0" : "WEIGHTS_1");
    }
}

void chooseFormats(GltfDocument const& document, GltfAttributes const& attributes, GltfGeometry& geometry) {
    geometry.positionFormat = positionFormat(document.accessors[attributes.position]);
    if (attributes.color != kNone) geometry.colorFormat = shareFormat(document.accessors[attributes.color]);
    if (attributes.frame != kNone)
        geometry.frameFormat = formatOf(document.accessors[attributes.frame], kOfFrames, VertexFormat::Float4);
    for (size_t set = 0; set < GltfAttributes::kFirstUvSets; ++set) {
        if (attributes.uv[set] == kNone) continue;
        geometry.uvFormats[set] = uvFormat(document.accessors[attributes.uv[set]]);
    }
    // Both sets have the same format: their common one, or floats.
    const uint32_t first = attributes.weights[0], second = attributes.weights[1];
    if (first == kNone) return;
    const VertexFormat format = shareFormat(document.accessors[first]);
    if (second == kNone || shareFormat(document.accessors[second]) == format) geometry.weightFormat = format;
}

uint32_t restartIndex(GltfAccessor const& indices) {
    if (indices.component == ComponentType::UInt) return 0xFFFFFFFF;
    return indices.component == ComponentType::UShort ? 0xFFFF : 0xFF;
}

void gatherIndices(GltfDocument const& document, GltfPrimitive const& primitive, AttributeSource const& source,
                   GltfGeometry& geometry, Diagnostics& diagnostics) {
    geometry.wasIndexed = source.draco() || primitive.indices != kNone;
    if (source.draco()) {
        geometry.indices = source.draco()->indices();
    } else if (primitive.indices != kNone) {
        geometry.indices = readIntegerList(document, primitive.indices, 1, "indices", diagnostics);
        if (primitive.restarts)
            std::ranges::replace(geometry.indices, restartIndex(document.accessors[primitive.indices]), kNone);
    } else {
        geometry.indices.resize(geometry.positions.size());
        std::iota(geometry.indices.begin(), geometry.indices.end(), 0u);
    }
}

} // namespace

GltfGeometry gatherGeometry(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                            Diagnostics& diagnostics) {
    GltfGeometry geometry;
    if (primitive.attributes.position == kNone) {
        diagnostics.warn("{}: has no POSITION and is not drawn", path);
        return geometry;
    }
    AttributeSource source(document, primitive, path, diagnostics);
    gatherAttributes(source, primitive.attributes, primitive.draco ? primitive.draco->ids : GltfAttributes{}, geometry);
    if (!diagnostics.ok()) return geometry;
    chooseFormats(document, primitive.attributes, geometry);
    gatherIndices(document, primitive, source, geometry, diagnostics);
    if (diagnostics.ok() && (geometry.positions.empty() || geometry.indices.empty())) {
        diagnostics.warn("{}: is empty and is not drawn", path);
    }
    return geometry;
}

void reorderVertices(GltfGeometry& geometry, std::span<const uint32_t> sources) {
    const auto reorder = [&]<class T>(std::vector<T>& values) {
        if (values.empty()) return;
        std::vector<T> ordered(sources.size());
        std::transform(sources.begin(), sources.end(), ordered.begin(), [&](uint32_t i) { return values[i]; });
        values = std::move(ordered);
    };
    reorder(geometry.positions);
    reorder(geometry.normals);
    reorder(geometry.tangents);
    reorder(geometry.frames);
    reorder(geometry.colors);
    for (auto& uvs : geometry.uvs) reorder(uvs);
    for (auto& joints : geometry.joints) reorder(joints);
    for (auto& weights : geometry.weights) reorder(weights);
    for (MorphTargetData& target : geometry.targets) {
        reorder(target.positions);
        reorder(target.normals);
        reorder(target.tangents);
    }
}

} // namespace filament_core::assets
