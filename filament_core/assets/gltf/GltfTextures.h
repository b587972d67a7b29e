// SPDX-License-Identifier: Apache-2.0
/// GltfTextures: the materials that a scene uses, and the images that they need.
///   In      a document, and the flags of its materials that are used.
///   Out     materials in file order, and image jobs, one per image and use (images with the same bytes are one): an
///           image used as colour and as data becomes two textures (sRGB and linear) from one decoding. If an extension
///           expects a pair of maps in one texture and the file has two that are read alike and have one size, they are
///           packed, with one job per distinct pair; others stay apart. Lightmaps have jobs of their own: half floats
///           with the levels of the file. TextureRef::image is an index into the jobs'
///           textures, in order. With GltfNormals::WithVariance, normals are a third use: their alpha is filled. On
///           request, textures of BC7 with all levels stay compressed (GltfBlocks); what is packed or filled does not.
///   Thread  planTextures(): one. decodeImageJob(): any, one call per job, all in parallel.
///   Fails   a missing or broken image is an error that names it.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfImages.h"
#include "filament_core/assets/image/TextureDecoder.h"
#include "filament_core/assets/image/TexturePacking.h"

#include <vector>

namespace filament_core::assets {

struct GltfImageJob {
    uint32_t source = 0;                                                       ///< index in GltfTextures::sources
    uint32_t colorTexture = kNone, dataTexture = kNone, normalTexture = kNone; ///< slots in ModelData::images
    Image color, data, normals;                                                ///< filled as requested
    uint32_t maxSize = 0; ///< larger levels are left out, whatever the options allow; 0: none are

    uint32_t useCount() const {
        return (colorTexture != kNone ? 1u : 0u) + (dataTexture != kNone ? 1u : 0u) +
               (normalTexture != kNone ? 1u : 0u);
    }
    Diagnostics diagnostics;
};

struct GltfPackJob {
    uint32_t first = 0, second = 0; ///< indices in GltfTextures::sources
    PackLayout layout = PackLayout::RedGreen;
    uint32_t texture = 0; ///< slot in ModelData::images
    uint32_t maxSize = 0; ///< as that of GltfImageJob
    Image image;
    Diagnostics diagnostics;
};

/// A lightmap. Its levels are those of the file: others would mix charts, which lie apart by less than their texels.
struct GltfLightJob {
    uint32_t source = 0, openness = kNone; ///< indices in GltfTextures::sources; openness: of its alpha, or kNone
    uint32_t texture = 0;                  ///< slot in ModelData::images
    Image image;                           ///< RGBA16F; BC6HUfloat on request, if its alpha is 1; RGBA8 of such a file
    Diagnostics diagnostics;
};

struct GltfTextures {
    std::vector<MaterialData> materials;
    std::vector<GltfImageSource> sources; ///< all read before any job runs
    std::vector<GltfImageJob> jobs;
    std::vector<GltfPackJob> packs;
    std::vector<GltfLightJob> lights;
    uint32_t textureCount = 0;
};

/// `used`: for each material of the document, whether it is used. Unused materials are dropped; `remap` gives the new
/// index of the others. Reads the images of pairs, whose sizes decide.
GltfTextures planTextures(GltfDocument const& document, GltfFolder const& folder, std::vector<bool> const& used,
                          GltfNormals normals, std::vector<uint32_t>& remap, Diagnostics& diagnostics);

/// An error if the textures together have more than kMaxImagePixels; the sources are read.
void checkImageBudget(GltfTextures const& textures, Diagnostics& diagnostics);

void decodeImageJob(GltfDocument const& document, GltfTextures const& textures, uint32_t maxSize, GltfBlocks blocks,
                    GltfImageJob& job);
void decodeLightJob(GltfDocument const& document, GltfTextures const& textures, GltfBlocks blocks, GltfLightJob& job);
void packImagesJob(GltfDocument const& document, GltfTextures const& textures, uint32_t maxSize, GltfPackJob& job);

/// All uses of an image come from one decoding.
TextureBlocks blocksOf(GltfImageJob const& job, GltfBlocks blocks);

/// The first level of a texture, for packing.
Result<Image> decodeFirstLevel(std::span<const std::byte> file, std::string const& name);

/// Moves the decoded images into their slots.
std::vector<Image> collectImages(GltfTextures& textures);

} // namespace filament_core::assets
