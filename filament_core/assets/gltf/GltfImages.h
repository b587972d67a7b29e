// SPDX-License-Identifier: Apache-2.0
/// GltfImages: the encoded bytes of the images that a scene needs, and what they will take decoded.
///   In      a document whose buffers are loaded.
///   Thread  readImage(): any, one call per source, all in parallel. The rest: one.
///   Limits  kMaxImagePixels for all textures of a model together, before anything is decoded.
///   Fails   through the diagnostics, with the index of the image.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfUri.h"

#include <vector>

namespace filament_core::assets {

/// 8 GiB as RGBA8, a third more with mips: 128 textures of 4096 x 4096.
inline constexpr uint64_t kMaxImagePixels = uint64_t(1) << 31;

/// One image that is read and decoded, for all images of the document with the same bytes.
struct GltfImageSource {
    uint32_t image = 0; ///< index in the document
    std::vector<std::byte> owned{};
    std::span<const std::byte> bytes{}; ///< `owned`, or of a buffer of the document
    uint2 size{ 0 };                    ///< as its header says
    bool isRead = false;                ///< readImage() was called
    Diagnostics diagnostics{};
};

/// For each image of the document, the first one that has the same URI or the same bytes of a buffer.
std::vector<uint32_t> firstOfSameImages(GltfDocument const& document);

void readImage(GltfDocument const& document, GltfFolder const& folder, GltfImageSource& source);

/// "images[3]", with the name of its file if it has one.
std::string imageName(GltfDocument const& document, uint32_t image);

} // namespace filament_core::assets
