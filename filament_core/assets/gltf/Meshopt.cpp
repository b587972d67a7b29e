// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Meshopt.h"

#include "filament_core/assets/gltf/MeshoptStreams.h"

namespace filament_core::assets {
namespace {

/// Which rule of the extension's section "JSON schema updates" the description breaks; empty if none.
std::string brokenRule(MeshoptSource const& source) {
    const uint64_t stride = source.byteStride;
    if (source.mode != MeshoptMode::Attributes) {
        if (source.filter != MeshoptFilter::None) return "only the mode ATTRIBUTES has filters";
        if (stride != 2 && stride != 4) return fmt::format("the byteStride of indices must be 2 or 4, not {}", stride);
        if (source.mode == MeshoptMode::Triangles && source.count % 3 != 0) {
            return fmt::format("the count of TRIANGLES must be divisible by 3, {} is not", source.count);
        }
        return {};
    }
    if (stride == 0 || stride > 256 || stride % 4 != 0) {
        return fmt::format("the byteStride of ATTRIBUTES must be a multiple of 4 from 4 to 256, not {}", stride);
    }
    switch (source.filter) {
    case MeshoptFilter::Octahedral:
    case MeshoptFilter::Color:
        if (stride != 4 && stride != 8) return fmt::format("this filter needs a byteStride of 4 or 8, not {}", stride);
        break;
    case MeshoptFilter::Quaternion:
        if (stride != 8) return fmt::format("the filter QUATERNION needs a byteStride of 8, not {}", stride);
        break;
    default:
        break;
    }
    if (source.filter == MeshoptFilter::Color && !source.isKhr) {
        return "the filter COLOR needs KHR_meshopt_compression instead of EXT_meshopt_compression";
    }
    return {};
}

std::string_view decodeStream(MeshoptSource const& source, std::span<const std::byte> bytes, std::span<std::byte> out) {
    switch (source.mode) {
    case MeshoptMode::Triangles:
        return decodeMeshoptTriangles(bytes, source.byteStride, out);
    case MeshoptMode::Indices:
        return decodeMeshoptIndices(bytes, source.byteStride, out);
    default:
        return decodeMeshoptAttributes(bytes, source.isKhr ? 1 : 0, source.byteStride, source.count, out);
    }
}

} // namespace

std::vector<std::byte> decodeMeshopt(MeshoptSource const& source, std::span<const std::byte> bytes,
                                     std::string_view path, Diagnostics& diagnostics) {
    constexpr uint64_t kMaxRatio = 2048, kMaxCount = uint64_t{ 1 } << 31;
    if (const std::string rule = brokenRule(source); !rule.empty()) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: {}", path, rule);
        return {};
    }
    if (source.count > kMaxCount || source.count * source.byteStride > bytes.size() * kMaxRatio) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: {} compressed bytes cannot hold {} elements", path, bytes.size(),
                           source.count);
        return {};
    }
    std::vector<std::byte> out(source.count * source.byteStride);
    if (const std::string_view reason = decodeStream(source, bytes, out); !reason.empty()) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: the meshopt stream is broken: {}; compress the model again", path,
                           reason);
        return {};
    }
    applyMeshoptFilter(source.filter, source.byteStride, out);
    return out;
}

} // namespace filament_core::assets
