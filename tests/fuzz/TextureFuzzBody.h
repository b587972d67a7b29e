// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a KTX 2.0 or DDS file, or the codebooks and a slice
/// of BasisLZ, gives an error of one line, or all texels; and the same twice.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/blocks/BasisLz.h"
#include "filament_core/assets/image/DdsDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "filament_core/assets/image/TextureDecoder.h"

#include <cstdint>
#include <span>
#include <string>

namespace filament_core::assets::test {

inline constexpr uint64_t kMaxFuzzedTexels = 1u << 18;

inline void checkTextureError(Error const& error) {
    FILAMENT_ASSERT(error.message.starts_with("image 'fuzzed' "), "an error names its picture");
    FILAMENT_ASSERT(error.message.find('\n') == std::string::npos, "an error is one line");
}

inline void fuzzUses(std::span<const std::byte> bytes) {
    for (const uint32_t maxSize : { 0u, 4u }) {
        if (const Result<DecodedTexture> used = decodeTexture(bytes, "fuzzed", maxSize); !used)
            checkTextureError(used.error());
    }
    if (const Result<Image> picture = decodePicture(bytes, "fuzzed", { .isFull = true }); !picture)
        checkTextureError(picture.error());
}

inline bool fuzzDds(std::span<const std::byte> bytes) {
    const uint2 size = ddsSize(bytes);
    if (uint64_t{ size.x } * size.y > kMaxFuzzedTexels) return false; // only slow
    const Result<DdsTexture> texture = decodeDds(bytes, "fuzzed");
    if (texture) {
        Image const& image = texture->image;
        FILAMENT_ASSERT(uint2(image.width, image.height) == size && image.layers == 1,
                        "the size is that of the header");
        FILAMENT_ASSERT(image.data.size() == image.levelOffset(image.levels), "every texel is there");
        const Result<DdsTexture> again = decodeDds(bytes, "fuzzed");
        FILAMENT_ASSERT(again && again->image.data == image.data, "decoding twice gives the same texels");
    } else {
        checkTextureError(texture.error());
    }
    fuzzUses(bytes);
    return texture.ok();
}

/// Returns whether it was a texture.
inline bool fuzzTexture(std::span<const std::byte> bytes) {
    if (isDds(bytes)) return fuzzDds(bytes);
    const Result<Ktx2File> file = readKtx2(bytes, "fuzzed");
    if (!file) {
        checkTextureError(file.error());
        FILAMENT_ASSERT(!decodeKtx2(bytes, "fuzzed"), "what cannot be read cannot be decoded");
        return false;
    }
    if (uint64_t{ file->width } * file->height * file->layers > kMaxFuzzedTexels) return false; // only slow
    const Result<Ktx2Texture> texture = decodeKtx2(bytes, "fuzzed");
    if (texture) {
        Image const& image = texture->image;
        FILAMENT_ASSERT(image.levels == file->levels.size() && image.layers == file->layers, "every level is there");
        FILAMENT_ASSERT(image.data.size() == image.levelOffset(image.levels), "every texel is there");
        const Result<Ktx2Texture> again = decodeKtx2(bytes, "fuzzed");
        FILAMENT_ASSERT(again && again->image.data == image.data, "decoding twice gives the same texels");
    } else {
        checkTextureError(texture.error());
    }
    fuzzUses(bytes);
    return texture.ok();
}

/// The first two bytes say how many of the next are codebooks; the rest is a slice of 37 x 29 texels.
inline bool fuzzBasis(std::span<const std::byte> bytes) {
    if (bytes.size() < 2) return false;
    const size_t wanted = std::to_integer<size_t>(bytes[0]) + 256 * std::to_integer<size_t>(bytes[1]);
    const auto books = bytes.subspan(2, std::min(wanted, bytes.size() - 2));
    const Result<blocks::BasisLz> read = blocks::BasisLz::read(books, 1);
    if (!read) return false;
    std::vector<blocks::Texel8> texels(37 * 29);
    return read->decodeSlice(bytes.subspan(2 + books.size()), 37, 29, texels).ok();
}

} // namespace filament_core::assets::test
