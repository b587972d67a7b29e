// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfTextures.h"

#include "filament_core/assets/image/ColorProfile.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/MipMaps.h"
#include "filament_core/assets/image/NormalVariance.h"
#include "filament_core/assets/image/TextureDecoder.h"

#include <exception>
#include <map>
#include <tuple>

namespace filament_core::assets {
namespace {

/// Section 3.8.4: without a sampler, repeat; the filters are implementation-defined.
constexpr Sampler kDefaultSampler{ .magFilter = Filter::Linear,
                                   .minFilter = Filter::Linear,
                                   .mipFilter = MipFilter::Linear,
                                   .wrapU = WrapMode::Repeat,
                                   .wrapV = WrapMode::Repeat };

class TexturePlanner {
public:
    TexturePlanner(GltfDocument const& document, GltfFolder const& folder, GltfNormals normals, GltfTextures& textures,
                   Diagnostics& diagnostics)
            : mDocument(document), mFolder(folder), mNormals(normals), mTextures(textures), mDiagnostics(diagnostics),
              mFirstOfSame(firstOfSameImages(document)), mSourceOfImage(document.images.size(), kNone),
              mJobOfSource(document.images.size(), kNone) {}

    MaterialData resolve(uint32_t index) {
        GltfMaterial const& material = mDocument.materials[index];
        MaterialData data = material.values;
        data.baseColor = textureFor(material.baseColor, Use::Color);
        if (data.unlit) return data; // shows only the base colour
        data.normal = normalsFor(material.normal);
        data.occlusion = textureFor(material.occlusion, Use::Data);
        data.emissive = textureFor(material.emissive, Use::Color);
        if (data.bump.isUsed()) data.bump.map = textureFor(material.bump, Use::Data);
        if (data.specularGlossiness) {
            data.specularGlossiness->map = textureFor(material.specularGlossiness, Use::Color);
            return data;
        }
        data.metallicRoughness = textureFor(material.metallicRoughness, Use::Data);
        resolveExtensions(material, data);
        data.light.map = lightFor(material.light);
        return data;
    }

private:
    // Maps that a material does not use are neither decoded nor uploaded.
    void resolveExtensions(GltfMaterial const& material, MaterialData& data) {
        if (data.clearCoat.isUsed()) {
            data.clearCoat.maps = pairFor(material.clearCoat, PackLayout::RedGreen);
            data.clearCoat.normal = normalsFor(material.clearCoatNormal);
        }
        if (data.sheen.isUsed()) data.sheen.maps = pairFor(material.sheen, PackLayout::ColorAlpha);
        if (data.specular.isUsed()) data.specular.maps = pairFor(material.specular, PackLayout::ColorAlpha);
        if (data.anisotropy.isUsed()) data.anisotropy.map = textureFor(material.anisotropy, Use::Data);
        if (data.iridescence.isUsed()) data.iridescence.maps = pairFor(material.iridescence, PackLayout::RedGreen);
        if (data.transmission.isUsed() || data.scatters()) {
            GltfTexturePair maps = material.transmission;
            if (!data.transmission.isUsed()) maps.first = {};
            if (!data.transmission.isSolid() && !data.scatters()) maps.second = {};
            data.transmission.maps = pairFor(maps, PackLayout::RedGreen);
        }
        if (data.diffuseTransmission.isUsed())
            data.diffuseTransmission.maps = pairFor(material.diffuseTransmission, PackLayout::ColorAlpha);
        if (data.scatters()) data.volumeScatter.map = textureFor(material.multiscatter, Use::Color);
    }

    enum class Use : uint8_t { Color, Data, Normals };

    TextureRef textureFor(GltfTextureInfo const& info, Use use) {
        TextureRef reference = referenceTo(info);
        if (reference.image != kNone) reference.image = slotFor(reference.image, use);
        return reference;
    }

    TextureRef lightFor(GltfTextureInfo const& info) {
        TextureRef reference = referenceTo(info);
        if (reference.image == kNone) return reference;
        const uint32_t openness = mDocument.textures[info.texture].openness;
        const std::pair images(reference.image, openness == kNone ? kNone : mFirstOfSame[openness]);
        const auto [entry, isNew] = mLights.try_emplace(images, mTextures.textureCount);
        if (isNew) {
            const uint32_t source = sourceFor(images.first);
            const uint32_t alpha = images.second == kNone ? kNone : sourceFor(images.second);
            mTextures.lights.push_back({ source, alpha, mTextures.textureCount++, {}, {} });
        }
        reference.image = entry->second;
        return reference;
    }

    TextureRef normalsFor(GltfTextureInfo const& info) {
        const bool hasVariance = mNormals == GltfNormals::WithVariance;
        TextureRef reference = textureFor(info, hasVariance ? Use::Normals : Use::Data);
        reference.hasVariance = hasVariance && reference.image != kNone;
        return reference;
    }

    TexturePair pairFor(GltfTexturePair const& infos, PackLayout layout) {
        const Use use = layout == PackLayout::ColorAlpha ? Use::Color : Use::Data;
        const TextureRef first = referenceTo(infos.first), second = referenceTo(infos.second);
        TexturePair pair{ first, first.image != kNone, second.image != kNone };
        if (!pair.hasFirst && !pair.hasSecond) return pair;
        const bool isOne = !pair.hasFirst || !pair.hasSecond || first.image == second.image;
        if (!pair.hasFirst) pair.texture = second;
        if (pair.hasFirst && pair.hasSecond && !(isReadAlike(first, second) && (isOne || haveOneSize(first, second)))) {
            pair.texture.image = slotFor(first.image, use);
            pair.second = second;
            pair.second.image = slotFor(second.image, isOne ? use : Use::Data); // alpha is the same in both
            return pair;
        }
        pair.texture.image =
                isOne ? slotFor(pair.texture.image, use) : packedSlotFor({ first.image, second.image, layout });
        return pair;
    }

    static bool isReadAlike(TextureRef const& a, TextureRef const& b) {
        return a.sampler == b.sampler && a.uvSet == b.uvSet && a.uvTransform == b.uvTransform && !a.isAnimated &&
               !b.isAnimated;
    }

    /// Packing would resample images of different sizes: a sampler would no longer see the texels of the smaller one.
    bool haveOneSize(TextureRef const& a, TextureRef const& b) { return sizeOf(a.image) == sizeOf(b.image); }
    uint2 sizeOf(uint32_t image) {
        GltfImageSource& source = mTextures.sources[sourceFor(image)];
        // Whether two images can be packed depends on their sizes, so these are read while planning. Others are read by
        // all workers later.
        if (!source.isRead) readImage(mDocument, mFolder, source);
        return source.size;
    }

    /// `image` is still an index of the document; kNone: there is no image that this loader can read.
    TextureRef referenceTo(GltfTextureInfo const& info) {
        TextureRef reference;
        if (info.texture == kNone) return reference;
        GltfTexture const& texture = mDocument.textures[info.texture];
        if (texture.image == kNone) {
            mDiagnostics.refuse(ErrorCode::Unsupported,
                                "textures[{}]: has no PNG, JPEG, WebP, AVIF, KTX2 or DDS image; export it as one",
                                info.texture);
            return reference;
        }
        reference.image = mFirstOfSame[texture.image];
        reference.sampler = texture.sampler == kNone ? kDefaultSampler : mDocument.samplers[texture.sampler];
        reference.uvSet = info.uvSet;
        reference.uvTransform = info.uvTransform;
        reference.hasTransform = info.hasTransform || info.isAnimated;
        reference.isAnimated = info.isAnimated;
        reference.placement = info.placement;
        return reference;
    }

    uint32_t sourceFor(uint32_t image) {
        uint32_t& source = mSourceOfImage[image];
        if (source == kNone) {
            source = static_cast<uint32_t>(mTextures.sources.size());
            mTextures.sources.push_back({ .image = image });
        }
        return source;
    }

    uint32_t slotFor(uint32_t image, Use use) {
        const uint32_t source = sourceFor(image);
        if (mJobOfSource[source] == kNone) {
            mJobOfSource[source] = static_cast<uint32_t>(mTextures.jobs.size());
            mTextures.jobs.emplace_back().source = source;
        }
        GltfImageJob& job = mTextures.jobs[mJobOfSource[source]];
        uint32_t& slot = use == Use::Color ? job.colorTexture : use == Use::Data ? job.dataTexture : job.normalTexture;
        if (slot == kNone) slot = mTextures.textureCount++;
        return slot;
    }

    using Packed = std::tuple<uint32_t, uint32_t, PackLayout>;
    uint32_t packedSlotFor(Packed const& packed) {
        const auto [entry, isNew] = mPacked.try_emplace(packed, mTextures.textureCount);
        if (isNew) {
            const auto [first, second, layout] = packed;
            const uint32_t one = sourceFor(first), other = sourceFor(second);
            mTextures.packs.push_back({ one, other, layout, mTextures.textureCount++, {}, {} });
        }
        return entry->second;
    }

    GltfDocument const& mDocument;
    GltfFolder const& mFolder;
    GltfNormals mNormals;
    GltfTextures& mTextures;
    Diagnostics& mDiagnostics;
    std::vector<uint32_t> mFirstOfSame, mSourceOfImage; // by index in the document
    std::vector<uint32_t> mJobOfSource;
    std::map<Packed, uint32_t> mPacked;                        // -> its slot
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> mLights; // light and openness -> its slot
};

Result<DecodedTexture> decode(GltfDocument const& document, GltfImageSource const& source, uint32_t maxSize,
                              TextureDepth depth, TextureBlocks blocks = TextureBlocks::Decoded) {
    return decodeTexture(source.bytes, imageName(document, source.image), maxSize, depth, blocks);
}

/// The file of a texture says whether it holds colours, and so does its use.
void warnAboutTransfer(GltfDocument const& document, GltfImageSource const& source, std::optional<bool> isSrgb,
                       GltfImageJob& job) {
    const bool isColor = job.colorTexture != kNone;
    if (!isSrgb || *isSrgb == isColor || (isColor && job.useCount() > 1)) return;
    job.diagnostics.warn("{} is used for {}, but its file says that it is {}; the use counts",
                         imageName(document, source.image), isColor ? "colours" : "data", *isSrgb ? "sRGB" : "linear");
}

/// glTF 2.0, 3.8.3: colour spaces of files are ignored.
void warnAboutColorSpace(GltfDocument const& document, GltfImageSource const& source, Diagnostics& diagnostics) {
    if (const std::optional<std::string> space = foreignColorSpace(source.bytes))
        diagnostics.warn(
                "{} declares {}, which glTF ignores: its colours are taken as those of sRGB; convert it to sRGB",
                imageName(document, source.image), *space);
}

uint64_t pixelsOf(uint2 size) { return uint64_t(size.x) * size.y; }

/// The smaller of two limits, of which 0 is none.
uint32_t smallerLimit(uint32_t a, uint32_t b) { return a == 0 || b == 0 ? std::max(a, b) : std::min(a, b); }

void decodeLight(GltfDocument const& document, GltfTextures const& textures, GltfBlocks blocks, GltfLightJob& job) {
    GltfImageSource const& source = textures.sources[job.source];
    const bool isKept = blocks != GltfBlocks::None && job.openness == kNone;
    Result<DecodedTexture> texture =
            decode(document, source, 0, TextureDepth::Floats, isKept ? TextureBlocks::KeptBc6 : TextureBlocks::Decoded);
    if (!texture) return job.diagnostics.refuse(texture.error());
    const bool isFloat = backend::formatInfo(texture->image.format).isFloat;
    job.image = isFloat ? std::move(texture->image) : withAllLevels(std::move(*texture), false, 0);
    if (job.openness == kNone) return;
    GltfImageSource const& other = textures.sources[job.openness];
    const std::string name = imageName(document, other.image);
    Result<Ktx2Texture> openness = decodeKtx2(other.bytes, name);
    if (!openness) return job.diagnostics.refuse(openness.error());
    Image const& alpha = openness->image;
    if (job.image.format != backend::Format::RGBA16F || alpha.format != backend::Format::RGBA8 || alpha.layers != 1)
        return job.diagnostics.refuse(ErrorCode::Unsupported,
                                      "{} is the openness of {}: that needs 8 bits a channel without sRGB, and light "
                                      "needs floats; bake the model again",
                                      name, imageName(document, source.image));
    if (alpha.width != job.image.width || alpha.height != job.image.height || alpha.levels != job.image.levels)
        return job.diagnostics.refuse(ErrorCode::Corrupt,
                                      "{} has {} x {} texels with {} levels and its light {} has {} x {} with {}; bake "
                                      "the model again",
                                      name, alpha.width, alpha.height, alpha.levels, imageName(document, source.image),
                                      job.image.width, job.image.height, job.image.levels);
    job.image = withAlphaOf(std::move(job.image), alpha);
}

} // namespace

TextureBlocks blocksOf(GltfImageJob const& job, GltfBlocks blocks) {
    const bool isColor = job.colorTexture != kNone, hasNormals = job.normalTexture != kNone;
    const bool isKept = blocks == GltfBlocks::All || (blocks == GltfBlocks::Data && !isColor);
    return isKept && !hasNormals ? TextureBlocks::KeptBc7 : TextureBlocks::Decoded;
}

Result<Image> decodeFirstLevel(std::span<const std::byte> file, std::string const& name) {
    Result<DecodedTexture> texture = decodeTexture(file, name, 0, TextureDepth::EightBits);
    if (!texture) return texture.error();
    Image& image = texture->image;
    image.data.resize(image.levelBytes(0));
    image.levels = 1;
    return std::move(image);
}

GltfTextures planTextures(GltfDocument const& document, GltfFolder const& folder, std::vector<bool> const& used,
                          GltfNormals normals, std::vector<uint32_t>& remap, Diagnostics& diagnostics) {
    GltfTextures textures;
    TexturePlanner planner(document, folder, normals, textures, diagnostics);
    remap.assign(document.materials.size(), kNone);
    for (uint32_t i = 0; i < document.materials.size(); ++i) {
        if (!used[i]) continue;
        remap[i] = static_cast<uint32_t>(textures.materials.size());
        textures.materials.push_back(planner.resolve(i));
    }
    return textures;
}

void checkImageBudget(GltfTextures const& textures, Diagnostics& diagnostics) {
    uint64_t pixels = 0; // of what is kept: larger levels of streamed textures come and go
    const auto kept = [](uint2 size, uint32_t maxSize) {
        return pixelsOf(maxSize == 0 ? size : glm::min(size, uint2(maxSize)));
    };
    for (GltfImageJob const& job : textures.jobs)
        pixels += job.useCount() * kept(textures.sources[job.source].size, job.maxSize);
    for (GltfLightJob const& job : textures.lights) {
        pixels += pixelsOf(textures.sources[job.source].size);
        if (job.openness != kNone) pixels += pixelsOf(textures.sources[job.openness].size);
    }
    for (GltfPackJob const& job : textures.packs) pixels += kept(textures.sources[job.first].size, job.maxSize);
    if (pixels > kMaxImagePixels)
        diagnostics.refuse(ErrorCode::Unsupported,
                           "images: the {} textures have {} pixels, more than {}; use smaller ones",
                           textures.textureCount, pixels, kMaxImagePixels);
}

void decodeImageJob(GltfDocument const& document, GltfTextures const& textures, uint32_t maxSize, GltfBlocks blocks,
                    GltfImageJob& job) {
    GltfImageSource const& source = textures.sources[job.source];
    maxSize = smallerLimit(maxSize, job.maxSize);
    try {
        const bool hasNormals = job.normalTexture != kNone; // of which the first level counts, even if it is dropped
        Result<DecodedTexture> texture =
                decode(document, source, hasNormals ? 0 : maxSize, TextureDepth::AllBits, blocksOf(job, blocks));
        if (!texture) return job.diagnostics.refuse(texture.error());
        warnAboutTransfer(document, source, texture->isSrgb, job);
        if (job.colorTexture != kNone) warnAboutColorSpace(document, source, job.diagnostics);
        uint32_t uses = job.useCount();
        // An image may be both a colour and data. The last use takes it; only the others copy.
        const auto take = [&] { return --uses == 0 ? std::move(*texture) : *texture; };
        if (job.colorTexture != kNone) job.color = withAllLevels(take(), true, maxSize);
        if (job.dataTexture != kNone) job.data = withAllLevels(take(), false, maxSize);
        if (hasNormals) job.normals = withNormalVariance(withAllLevels(take(), false, 0), maxSize);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: out of memory; free some and try again",
                               source.image);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", source.image, exception.what());
    }
}

void decodeLightJob(GltfDocument const& document, GltfTextures const& textures, GltfBlocks blocks, GltfLightJob& job) {
    const uint32_t image = textures.sources[job.source].image;
    try {
        decodeLight(document, textures, blocks, job);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: out of memory; free some and try again", image);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", image, exception.what());
    }
}

void packImagesJob(GltfDocument const& document, GltfTextures const& textures, uint32_t maxSize, GltfPackJob& job) {
    GltfImageSource const &one = textures.sources[job.first], &other = textures.sources[job.second];
    maxSize = smallerLimit(maxSize, job.maxSize);
    try {
        Result<Image> first = decodeFirstLevel(one.bytes, imageName(document, one.image));
        if (!first) return job.diagnostics.refuse(first.error());
        Result<Image> second = decodeFirstLevel(other.bytes, imageName(document, other.image));
        if (!second) return job.diagnostics.refuse(second.error());
        if (first->width != second->width || first->height != second->height)
            return job.diagnostics.refuse(ErrorCode::Corrupt, "{} and {}: the size of one is not what its header says",
                                          imageName(document, one.image), imageName(document, other.image));
        if (job.layout == PackLayout::ColorAlpha) warnAboutColorSpace(document, one, job.diagnostics);
        Image packed = packImages(std::move(*first), *second, job.layout);
        job.image = withMipMaps(std::move(packed), job.layout == PackLayout::ColorAlpha, maxSize);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory,
                               "images[{}] and images[{}]: out of memory; free some and try again", one.image,
                               other.image);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", one.image, exception.what());
    }
}

std::vector<Image> collectImages(GltfTextures& textures) {
    std::vector<Image> images(textures.textureCount);
    for (GltfImageJob& job : textures.jobs) {
        if (job.colorTexture != kNone) images[job.colorTexture] = std::move(job.color);
        if (job.dataTexture != kNone) images[job.dataTexture] = std::move(job.data);
        if (job.normalTexture != kNone) images[job.normalTexture] = std::move(job.normals);
    }
    for (GltfLightJob& job : textures.lights) images[job.texture] = std::move(job.image);
    for (GltfPackJob& job : textures.packs) images[job.texture] = std::move(job.image);
    return images;
}

} // namespace filament_core::assets
