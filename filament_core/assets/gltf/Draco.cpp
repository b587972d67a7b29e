// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Draco.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <exception>

namespace filament::assets {

struct DracoMesh::State {
    std::unique_ptr<draco::Mesh> mesh; // null: decoding failed
};

DracoMesh::DracoMesh(std::span<const std::byte> stream, std::string_view path, Diagnostics& diagnostics)
        : mState(std::make_unique<State>()) {
    std::string reason;
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (decoded.ok())
            mState->mesh = std::move(decoded).value();
        else
            reason = decoded.status().error_msg_string();
    } catch (std::exception const& exception) { // e.g. bad_alloc, length_error: sizes made up by the stream
        reason = exception.what();
    }
    if (!mState->mesh) diagnostics.refuse(ErrorCode::Corrupt, "{}: the Draco stream is broken: {}", path, reason);
}

DracoMesh::~DracoMesh() = default;
DracoMesh::DracoMesh(DracoMesh&&) noexcept = default;

uint32_t DracoMesh::vertexCount() const { return mState->mesh ? mState->mesh->num_points() : 0; }

std::vector<uint32_t> DracoMesh::indices() const {
    std::vector<uint32_t> indices;
    if (!mState->mesh) return indices;
    indices.reserve(size_t{ mState->mesh->num_faces() } * 3);
    for (uint32_t i = 0; i < mState->mesh->num_faces(); ++i) {
        for (draco::PointIndex const& corner : mState->mesh->face(draco::FaceIndex(i)))
            indices.push_back(corner.value());
    }
    return indices;
}

uint8_t DracoMesh::componentCount(uint32_t id) const {
    draco::PointAttribute const* attribute = mState->mesh ? mState->mesh->GetAttributeByUniqueId(id) : nullptr;
    return attribute ? attribute->num_components() : uint8_t{ 0 };
}

void DracoMesh::read(uint32_t id, uint8_t components, std::span<float> out) const {
    draco::PointAttribute const* attribute = mState->mesh->GetAttributeByUniqueId(id);
    for (uint32_t i = 0; i < vertexCount(); ++i) {
        const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
        float* target = &out[size_t{ i } * components];
        const bool isRead = value.value() < attribute->size() &&
                            attribute->ConvertValue<float>(value, static_cast<int8_t>(components), target);
        if (!isRead) std::fill_n(target, components, 0.0f);
    }
}

} // namespace filament::assets
