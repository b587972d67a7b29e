// SPDX-License-Identifier: Apache-2.0
/// GltfImageStore: the encoded images of a model, from which its textures are decoded again at any of their levels.
///   In      planStreams(): what a load has planned and read; decides which textures can be streamed.
///   Out     textures as the loader makes them, without their largest levels: the same texels.
///   Rule    a texture is streamed if it may begin at a smaller level: where each dimension halves without a remainder,
///           down to about kCoarseTexels. Samplers scale the derivatives of coordinates by the size of the texture:
///           with exact halves they choose the same levels. Left whole are textures that samplers read at the largest
///           level only or with different filters above and below it, and those read by their size (bump maps).
///   Thread  decode(): any, several at once. The rest: one.
///   Memory  the files of streamed textures as they are.
///   Fails   decode(): the errors of decodeTexture(); std::bad_alloc.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/GltfTextures.h"
#include "filament_core/assets/image/Image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::assets {

/// The coarse levels that are always there: at most so many texels a side, where the texture can begin with them.
inline constexpr uint32_t kCoarseTexels = 64;

class GltfImageStore {
public:
    struct Texture {
        uint32_t first = kNone, second = kNone; ///< into the files; first kNone: it is not streamed
        enum class Use : uint8_t { Color, Data, Normals, Packed } use = Use::Color;
        PackLayout layout{};
        TextureBlocks blocks = TextureBlocks::Decoded;
        uint2 size{ 0 };
        uint32_t coarsest = 0; ///< the level that it can begin with at most

        bool isStreamed() const { return first != kNone; }
        uint32_t maxSize(uint32_t level) const { return std::max(size.x, size.y) >> level; }
    };

    uint32_t budgetMegabytes = 0; ///< GltfLoadOptions::textureBudgetMegabytes

    /// By slot of ModelData::images.
    std::vector<Texture> const& textures() const { return mTextures; }
    /// A texture that begins with this level.
    Result<Image> decode(uint32_t texture, uint32_t level) const;
    size_t fileBytes() const;

    /// Takes the bytes of the sources that it needs; the sources keep reading them.
    void plan(GltfDocument const& document, GltfTextures& textures, GltfBlocks blocks);

private:
    struct File {
        std::string name;
        std::vector<std::byte> bytes;
    };

    uint32_t keep(GltfDocument const& document, GltfImageSource& source);
    Result<Image> decodePacked(Texture const& texture, uint32_t maxSize) const;

    std::vector<Texture> mTextures;
    std::vector<File> mFiles;
    std::vector<uint32_t> mFileOfImage; ///< by image of the document, while it is planned
};

} // namespace filament_core::assets
