// SPDX-License-Identifier: Apache-2.0
/// GltfContainer: the two parts of a glTF file in either form of storage (glTF 2.0, section 4).
///   In     a whole .glb or .gltf file in memory; the first four bytes distinguish them.
///   Out    spans into it; `hasBinary` is false for .gltf and for a .glb without a BIN chunk.
///          Unknown and repeated chunks, and bytes behind the length, are ignored.
///   Fails  Corrupt for a chunk that extends past the file or is cut off, Unsupported for another container version.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <span>

namespace filament_core::assets {

struct GltfContainer {
    std::span<const std::byte> json;
    std::span<const std::byte> binary;
    bool hasBinary = false;
};

Result<GltfContainer> openGltfContainer(std::span<const std::byte> file);

} // namespace filament_core::assets
