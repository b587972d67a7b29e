// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfImageStore.h"

#include "filament_core/assets/image/MipMaps.h"
#include "filament_core/assets/image/NormalVariance.h"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <utility>

namespace filament_core::assets {
namespace {

using Use = GltfImageStore::Texture::Use;

/// The largest level that is at least as large as kCoarseTexels and whose sides are exact halves of halves.
uint32_t coarsestLevel(uint2 size) {
    if (size.x == 0 || size.y == 0) return 0;
    const uint32_t larger = std::max(size.x, size.y);
    const auto halves = static_cast<uint32_t>(std::countr_zero(size.x | size.y));
    uint32_t level = 0;
    while (level < halves && larger >> level > kCoarseTexels) ++level;
    return level;
}

/// Whether the texture may begin at a smaller level without a change of what the sampler reads of its smaller levels.
bool readsLevelsAlike(Sampler const& sampler) {
    return sampler.mipFilter != MipFilter::None && sampler.magFilter == sampler.minFilter;
}

std::vector<bool> textureMayBegin(GltfTextures const& textures) {
    std::vector<bool> may(textures.textureCount, true);
    const auto refuse = [&](TextureRef const& map, bool isReadBySize) {
        if (map.image == kNone) return;
        if (isReadBySize || !readsLevelsAlike(map.sampler)) may[map.image] = false;
    };
    for (MaterialData material : textures.materials) {
        for (int map = 1; map <= static_cast<int>(MapName::Multiscatter); ++map)
            refuse(mapOf(material, static_cast<MapName>(map)), static_cast<MapName>(map) == MapName::Bump);
        if (material.specularGlossiness) refuse(material.specularGlossiness->map, false);
    }
    return may;
}

} // namespace

uint32_t GltfImageStore::keep(GltfDocument const& document, GltfImageSource& source) {
    uint32_t& file = mFileOfImage[source.image];
    if (file != kNone) return file;
    file = static_cast<uint32_t>(mFiles.size());
    File& kept = mFiles.emplace_back();
    kept.name = imageName(document, source.image);
    if (source.owned.empty())
        kept.bytes.assign(source.bytes.begin(), source.bytes.end());
    else
        kept.bytes = std::move(source.owned);
    source.owned.clear();
    source.bytes = kept.bytes; // a vector that moves keeps its bytes where they are
    return file;
}

void GltfImageStore::plan(GltfDocument const& document, GltfTextures& textures, GltfBlocks blocks) {
    mTextures.assign(textures.textureCount, {});
    mFileOfImage.assign(document.images.size(), kNone);
    const std::vector<bool> mayBegin = textureMayBegin(textures);
    for (GltfImageJob& job : textures.jobs) {
        GltfImageSource& source = textures.sources[job.source];
        const uint32_t coarsest = coarsestLevel(source.size);
        const std::initializer_list<std::pair<uint32_t, Use>> uses{ { job.colorTexture, Use::Color },
                                                                    { job.dataTexture, Use::Data },
                                                                    { job.normalTexture, Use::Normals } };
        // All uses of an image are decoded at once.
        if (coarsest == 0 ||
            std::ranges::any_of(uses, [&](auto const& use) { return use.first != kNone && !mayBegin[use.first]; }))
            continue;
        for (auto const& [slot, use] : uses) {
            if (slot == kNone) continue;
            mTextures[slot] = { .first = keep(document, source),
                                .use = use,
                                .blocks = blocksOf(job, blocks),
                                .size = source.size,
                                .coarsest = coarsest };
            job.maxSize = mTextures[slot].maxSize(coarsest);
        }
    }
    for (GltfPackJob& job : textures.packs) {
        GltfImageSource &one = textures.sources[job.first], &other = textures.sources[job.second];
        const uint32_t coarsest = coarsestLevel(one.size);
        if (coarsest == 0 || !mayBegin[job.texture]) continue;
        mTextures[job.texture] = { .first = keep(document, one),
                                   .second = keep(document, other),
                                   .use = Use::Packed,
                                   .layout = job.layout,
                                   .size = one.size,
                                   .coarsest = coarsest };
        job.maxSize = mTextures[job.texture].maxSize(coarsest);
    }
    mFileOfImage.clear();
}

size_t GltfImageStore::fileBytes() const {
    size_t bytes = 0;
    for (File const& file : mFiles) bytes += file.bytes.size();
    return bytes;
}

Result<Image> GltfImageStore::decodePacked(Texture const& texture, uint32_t maxSize) const {
    const auto firstLevel = [&](uint32_t at) { return decodeFirstLevel(mFiles[at].bytes, mFiles[at].name); };
    Result<Image> first = firstLevel(texture.first);
    if (!first) return first.error();
    Result<Image> second = firstLevel(texture.second);
    if (!second) return second.error();
    Image packed = packImages(std::move(*first), *second, texture.layout);
    return withMipMaps(std::move(packed), texture.layout == PackLayout::ColorAlpha, maxSize);
}

Result<Image> GltfImageStore::decode(uint32_t texture, uint32_t level) const {
    Texture const& wanted = mTextures[texture];
    const uint32_t maxSize = wanted.maxSize(level);
    if (wanted.use == Use::Packed) return decodePacked(wanted, maxSize);
    File const& file = mFiles[wanted.first];
    const bool hasNormals = wanted.use == Use::Normals;
    Result<DecodedTexture> decoded =
            decodeTexture(file.bytes, file.name, hasNormals ? 0 : maxSize, TextureDepth::AllBits, wanted.blocks);
    if (!decoded) return decoded.error();
    if (hasNormals) return withNormalVariance(withAllLevels(std::move(*decoded), false, 0), maxSize);
    return withAllLevels(std::move(*decoded), wanted.use == Use::Color, maxSize);
}

} // namespace filament_core::assets
