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
#include <ctime>
#include <exception>

namespace filament_core::assets {

namespace {

/// Of this thread: other programs do not make a stream look slow.
double processorSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

struct DracoMesh::State {
    std::unique_ptr<draco::Mesh> mesh; // null: decoding failed
};

DracoMesh::DracoMesh(std::span<const std::byte> stream, std::string_view path, DracoPatience& patience,
                     Diagnostics& diagnostics)
        : mState(std::make_unique<State>()) {
    const std::string reason =
            patience.isLost ? "another one of this file took too long" : decodeInTime(stream, patience);
    if (!mState->mesh) diagnostics.refuse(ErrorCode::Corrupt, "{}: the Draco stream is broken: {}", path, reason);
}

std::string DracoMesh::decode(std::span<const std::byte> stream) {
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) return decoded.status().error_msg_string();
        mState->mesh = std::move(decoded).value();
        return {};
    } catch (std::exception const& exception) { // e.g. bad_alloc, length_error: sizes made up by the stream
        return exception.what();
    }
}

std::string DracoMesh::decodeInTime(std::span<const std::byte> stream, DracoPatience& patience) {
    const double begin = processorSeconds();
    std::string reason = decode(stream);
    const double seconds = processorSeconds() - begin;
    if (seconds <= patience.seconds + patience.secondsPerVertex * vertexCount()) return reason;
    patience.isLost = true;
    reason = fmt::format("{} vertices took {:.1f} s", vertexCount(), seconds);
    mState->mesh.reset();
    return reason;
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

} // namespace filament_core::assets
