// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/GltfTextures.h"

#include "filament_core/assets/GltfUri.h"
#include "filament_core/assets/MipMaps.h"
#include "filament_core/assets/StbImage.h"

#include <exception>

namespace filament::assets {
namespace {

/// Section 3.8.4: without a sampler, repeat; the filters are ours to choose.
constexpr backend::SamplerDesc kDefaultSampler{ .magFilter = backend::Filter::Linear,
                                                .minFilter = backend::Filter::Linear,
                                                .mipFilter = backend::MipFilter::Linear,
                                                .wrapU = backend::WrapMode::Repeat,
                                                .wrapV = backend::WrapMode::Repeat };

class TexturePlanner {
public:
    TexturePlanner(GltfDocument const& document, GltfTextures& textures, GltfDiagnostics& diagnostics)
            : mDocument(document), mTextures(textures), mDiagnostics(diagnostics),
              mJobOfImage(document.images.size(), kNone) {}

    MaterialData resolve(GltfMaterial const& material) {
        MaterialData data = material.values;
        data.baseColor = textureFor(material.baseColor, true);
        if (data.unlit) return data; // shows the base colour alone
        data.metallicRoughness = textureFor(material.metallicRoughness, false);
        data.normal = textureFor(material.normal, false);
        data.occlusion = textureFor(material.occlusion, false);
        data.emissive = textureFor(material.emissive, true);
        return data;
    }

private:
    TextureRef textureFor(GltfTextureInfo const& info, bool isColor) {
        TextureRef reference;
        if (info.texture == kNone) return reference;
        GltfTexture const& texture = mDocument.textures[info.texture];
        if (texture.image == kNone) {
            mDiagnostics.warn("textures[{}]: has no PNG or JPEG image and is left out", info.texture);
            return reference;
        }
        reference.image = slotFor(texture.image, isColor);
        reference.sampler = texture.sampler == kNone ? kDefaultSampler : mDocument.samplers[texture.sampler];
        reference.uvSet = info.uvSet;
        reference.uvTransform = info.uvTransform;
        reference.hasTransform = info.hasTransform;
        return reference;
    }

    uint32_t slotFor(uint32_t image, bool isColor) {
        if (mJobOfImage[image] == kNone) {
            mJobOfImage[image] = static_cast<uint32_t>(mTextures.jobs.size());
            mTextures.jobs.push_back({ .image = image, .color = {}, .data = {}, .diagnostics = {} });
        }
        GltfImageJob& job = mTextures.jobs[mJobOfImage[image]];
        uint32_t& slot = isColor ? job.colorTexture : job.dataTexture;
        if (slot == kNone) slot = mTextures.textureCount++;
        return slot;
    }

    GltfDocument const& mDocument;
    GltfTextures& mTextures;
    GltfDiagnostics& mDiagnostics;
    std::vector<uint32_t> mJobOfImage;
};

Result<Image> decode(GltfDocument const& document, std::filesystem::path const& baseDirectory,
                     GltfImageJob const& job) {
    GltfImage const& image = document.images[job.image];
    const std::string name = fmt::format("images[{}]", job.image);
    if (image.view != kNone) return decodeImage(document.viewBytes[image.view], name);
    const Result<std::vector<std::byte>> file = readGltfUri(image.uri, baseDirectory);
    if (!file) return fail(file.error().code, "{}: {}", name, file.error().message);
    const bool isData = image.uri.starts_with("data:");
    return decodeImage(*file, isData ? name : fmt::format("{} {}", name, image.uri));
}

} // namespace

GltfTextures planTextures(GltfDocument const& document, std::vector<bool> const& used, std::vector<uint32_t>& remap,
                          GltfDiagnostics& diagnostics) {
    GltfTextures textures;
    TexturePlanner planner(document, textures, diagnostics);
    remap.assign(document.materials.size(), kNone);
    for (uint32_t i = 0; i < document.materials.size(); ++i) {
        if (!used[i]) continue;
        remap[i] = static_cast<uint32_t>(textures.materials.size());
        textures.materials.push_back(planner.resolve(document.materials[i]));
    }
    return textures;
}

void decodeImageJob(GltfDocument const& document, std::filesystem::path const& baseDirectory, uint32_t maxSize,
                    GltfImageJob& job) {
    try {
        Result<Image> image = decode(document, baseDirectory, job);
        if (!image) return job.diagnostics.refuse(image.error());
        const bool isBoth = job.colorTexture != kNone && job.dataTexture != kNone;
        if (isBoth) job.data = withMipMaps(*image, false, maxSize);
        (job.colorTexture != kNone ? job.color : job.data) =
                withMipMaps(std::move(*image), job.colorTexture != kNone, maxSize);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: out of memory; free some and try again", job.image);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", job.image, exception.what());
    }
}

std::vector<Image> collectImages(GltfTextures& textures) {
    std::vector<Image> images(textures.textureCount);
    for (GltfImageJob& job : textures.jobs) {
        if (job.colorTexture != kNone) images[job.colorTexture] = std::move(job.color);
        if (job.dataTexture != kNone) images[job.dataTexture] = std::move(job.data);
    }
    return images;
}

} // namespace filament::assets
