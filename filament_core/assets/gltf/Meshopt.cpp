// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Meshopt.h"

#include <meshoptimizer.h>

namespace filament_core::assets {
namespace {

/// The rules of the extension's section "Specifying compressed views".
bool isAllowed(MeshoptSource const& source) {
    const uint64_t stride = source.byteStride;
    switch (source.mode) {
    case MeshoptMode::Attributes:
        break;
    case MeshoptMode::Triangles:
        return (stride == 2 || stride == 4) && source.count % 3 == 0 && source.filter == MeshoptFilter::None;
    case MeshoptMode::Indices:
        return (stride == 2 || stride == 4) && source.filter == MeshoptFilter::None;
    }
    if (stride == 0 || stride > 256 || stride % 4 != 0) return false;
    switch (source.filter) {
    case MeshoptFilter::Octahedral:
        return stride == 4 || stride == 8;
    case MeshoptFilter::Quaternion:
        return stride == 8;
    default:
        return true;
    }
}

int decode(MeshoptSource const& source, std::span<const std::byte> bytes, std::vector<std::byte>& out) {
    auto const* data = reinterpret_cast<const unsigned char*>(bytes.data());
    switch (source.mode) {
    case MeshoptMode::Triangles:
        return meshopt_decodeIndexBuffer(out.data(), source.count, source.byteStride, data, bytes.size());
    case MeshoptMode::Indices:
        return meshopt_decodeIndexSequence(out.data(), source.count, source.byteStride, data, bytes.size());
    default:
        return meshopt_decodeVertexBuffer(out.data(), source.count, source.byteStride, data, bytes.size());
    }
}

void applyFilter(MeshoptSource const& source, std::vector<std::byte>& out) {
    switch (source.filter) {
    case MeshoptFilter::None:
        break;
    case MeshoptFilter::Octahedral:
        meshopt_decodeFilterOct(out.data(), source.count, source.byteStride);
        break;
    case MeshoptFilter::Quaternion:
        meshopt_decodeFilterQuat(out.data(), source.count, source.byteStride);
        break;
    case MeshoptFilter::Exponential:
        meshopt_decodeFilterExp(out.data(), source.count, source.byteStride);
        break;
    }
}

} // namespace

std::vector<std::byte> decodeMeshopt(MeshoptSource const& source, std::span<const std::byte> bytes,
                                     std::string_view path, Diagnostics& diagnostics) {
    constexpr uint64_t kMaxRatio = 2048, kMaxCount = uint64_t{ 1 } << 31;
    if (!isAllowed(source)) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: the meshopt stride, count and filter do not match", path);
        return {};
    }
    if (source.count > kMaxCount || source.count * source.byteStride > bytes.size() * kMaxRatio) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: {} compressed bytes cannot hold {} elements", path, bytes.size(),
                           source.count);
        return {};
    }
    std::vector<std::byte> out(source.count * source.byteStride);
    if (const int status = decode(source, bytes, out); status != 0) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: the meshopt stream is broken or newer than codec version 0 ({})",
                           path, status);
        return {};
    }
    applyFilter(source, out);
    return out;
}

} // namespace filament_core::assets
