// SPDX-License-Identifier: Apache-2.0
/// GltfTextures: the materials that a scene uses, and the images that those need.
///   In      a document, and which of its materials something drawn uses.
///   Out     materials in file order; image jobs, one per image and use: an image that serves as colour and as data
///           becomes two textures (sRGB and linear) from one decoding. Pairs of maps that an extension keeps in one
///           texture, and that the file keeps in two, are packed: one job for each distinct pair. TextureRef::image
///           counts in the jobs' textures, in order.
///   Thread  planTextures(): one. decodeImageJob(): any, one call per job, all in parallel.
///   Fails   a missing or broken image is an error that names it. A texture in a format that this loader does not read
///           (KTX2, WebP without fallback) is left out with a warning; so is the second map of a pair whose texture
///           coordinates or sampler differ from those of the first.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/image/TexturePacking.h"

#include <filesystem>
#include <vector>

namespace filament::assets {

struct GltfImageJob {
    uint32_t image = 0;                                 ///< of the document
    uint32_t colorTexture = kNone, dataTexture = kNone; ///< slots in ModelData::images
    Image color, data;                                  ///< filled as far as asked for
    Diagnostics diagnostics;
};

struct GltfPackJob {
    uint32_t first = 0, second = 0; ///< images of the document
    PackLayout layout = PackLayout::RedGreen;
    uint32_t texture = 0; ///< slot in ModelData::images
    Image image;
    Diagnostics diagnostics;
};

struct GltfTextures {
    std::vector<MaterialData> materials;
    std::vector<GltfImageJob> jobs;
    std::vector<GltfPackJob> packs;
    uint32_t textureCount = 0;
};

/// `used`: per material of the document whether something drawn uses it. Unused materials are left out of the result;
/// `remap` gives the new index of the others.
GltfTextures planTextures(GltfDocument const& document, std::vector<bool> const& used, std::vector<uint32_t>& remap,
                          Diagnostics& diagnostics);

void decodeImageJob(GltfDocument const& document, std::filesystem::path const& baseDirectory, uint32_t maxSize,
                    GltfImageJob& job);
void packImagesJob(GltfDocument const& document, std::filesystem::path const& baseDirectory, uint32_t maxSize,
                   GltfPackJob& job);

/// Moves the decoded images into their slots.
std::vector<Image> collectImages(GltfTextures& textures);

} // namespace filament::assets
