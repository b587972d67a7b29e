// SPDX-License-Identifier: Apache-2.0
/// Meshopt: one compressed buffer view of EXT_meshopt_compression or KHR_meshopt_compression. The latter also has codec
/// version 1 for attributes and the filter COLOR.
///   In      the description and the compressed bytes; untrusted.
///   Out     count * byteStride bytes. `path` names the view in messages; on failure the result is empty.
///   Thread  any.
///   Limits  those of the extension: strides 4..256 (attributes), 2 or 4 (indices), 4 or 8 (octahedral, colour), 8
///           (quaternion); and at most 2048 decoded bytes per compressed byte, which no valid stream reaches, so that a
///           small file cannot cause a large allocation.
///   Fails   Corrupt.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <span>
#include <string_view>

namespace filament_core::assets {

std::vector<std::byte> decodeMeshopt(MeshoptSource const& source, std::span<const std::byte> bytes,
                                     std::string_view path, Diagnostics& diagnostics);

} // namespace filament_core::assets
