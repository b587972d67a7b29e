// SPDX-License-Identifier: Apache-2.0
/// MeshoptStreams: the three bitstreams and the filters of KHR_meshopt_compression (appendices A and B), which contain
/// those of EXT_meshopt_compression.
///   In      compressed bytes, untrusted; stride and count by the rules of the extension (Meshopt.cpp checks them).
///   Out     count * stride bytes.
///   Fails   empty if the stream is sound, otherwise what is wrong with it; `out` is then unspecified.
///   Memory  nothing is read or written beyond the two spans, nothing is allocated.
#pragma once

#include "filament_core/assets/gltf/GltfDocument.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace filament_core::assets {

std::string_view decodeMeshoptAttributes(std::span<const std::byte> bytes, uint32_t maxVersion, size_t stride,
                                         size_t count, std::span<std::byte> out);
std::string_view decodeMeshoptTriangles(std::span<const std::byte> bytes, size_t stride, std::span<std::byte> out);
std::string_view decodeMeshoptIndices(std::span<const std::byte> bytes, size_t stride, std::span<std::byte> out);

/// In place. Values that the specification calls invalid give some bits or other, the same on every machine.
void applyMeshoptFilter(MeshoptFilter filter, size_t stride, std::span<std::byte> elements);

inline constexpr std::string_view kMeshoptTooShort = "it ends too early";
inline constexpr std::string_view kMeshoptLeftOver = "bytes are left over before its tail";

} // namespace filament_core::assets
