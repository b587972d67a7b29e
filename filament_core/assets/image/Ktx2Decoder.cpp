// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Decoder.h"

#include "filament_core/assets/blocks/BasisLz.h"
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "filament_core/assets/image/Ktx2Formats.h"
#include "filament_core/assets/image/Ktx2Inflate.h"
#include "filament_core/assets/image/Ktx2Texels.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace filament_core::assets {
namespace {

using blocks::BasisLz;
using blocks::Texel8;

/// Samples of Basis formats: KTX 2.0 and Khronos Data Format specifications, "KHR_DF_CHANNEL_...".
constexpr uint8_t kEtc1sRrr = 3, kUastcRrr = 4, kUastcRg = 6, kUastcRgb = 0;

/// Decodes the levels of one file.
class Ktx2Levels {
public:
    Ktx2Levels(Ktx2File const& file, std::string_view name, Ktx2Options const& options)
            : mFile(file), mName(name), mOptions(options) {}

    Result<Ktx2Texture> decode() {
        if (Result<void> chosen = chooseFormat(); !chosen) return chosen.error();
        const uint32_t first = firstLevel();
        Image& image = mTexture.image;
        image.width = std::max(mFile.width >> first, 1u), image.height = std::max(mFile.height >> first, 1u);
        image.layers = mFile.layers;
        image.levels = mOptions.isOneLevel ? 1 : static_cast<uint32_t>(mFile.levels.size()) - first;
        if (mFile.compression == Ktx2Compression::BasisLz) {
            if (Result<void> read = readBooks(); !read) return read.error();
        }
        for (uint32_t level = first; !mBooks && level < first + image.levels; ++level) {
            Result<void> checked = checkLevel(mFile, level, imageBytesOf(level) * mFile.layers, mName);
            if (!checked) return checked.error();
        }
        image.data.resize(image.levelOffset(image.levels));
        for (uint32_t level = 0; level < image.levels; ++level) {
            const auto texels = std::span(image.data).subspan(image.levelOffset(level), image.levelBytes(level));
            if (Result<void> decoded = decodeLevel(first + level, texels); !decoded) return decoded.error();
            if (!mIsKept) arrangeKtx2(mFile, image, level, texels);
        }
        mTexture.isCube = mFile.isCube, mTexture.isArray = mFile.isArray;
        return std::move(mTexture);
    }

private:
    Error damaged(std::string const& what) const {
        return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {}; export it again", mName, what);
    }
    uint32_t widthOf(uint32_t level) const { return std::max(mFile.width >> level, 1u); }
    uint32_t heightOf(uint32_t level) const { return std::max(mFile.height >> level, 1u); }
    /// Of one layer, without supercompression; not of BasisLZ.
    uint64_t imageBytesOf(uint32_t level) const {
        return mFormat.block ? bytesOfBlocks(*mFormat.block, widthOf(level), heightOf(level))
                             : uint64_t{ widthOf(level) } * heightOf(level) * mFormat.texelBytes;
    }

    Result<void> chooseFormat() {
        if (mFile.description.isPremultiplied)
            return fail(ErrorCode::Unsupported,
                        "image '{}' has colours that are multiplied by alpha; export it with straight alpha", mName);
        const uint8_t model = mFile.description.model;
        const bool isLz = mFile.compression == Ktx2Compression::BasisLz;
        if (isLz != (model == Ktx2Description::kEtc1s) ||
            ((isLz || model == Ktx2Description::kUastc) && mFile.format != 0))
            return damaged("its format and its supercompression do not belong together");
        if (mFile.format == 0 && model == Ktx2Description::kUastc) {
            mFormat.block = BlockFormat{ BlockKind::Uastc };
        } else if (!isLz) {
            const std::optional<Ktx2Format> format = ktx2Format(mFile.format);
            if (!format)
                return fail(
                        ErrorCode::Unsupported,
                        "image '{}' has VkFormat {} and colour model {}, which are not read; export it as UASTC, BC7, "
                        "ASTC, or with 8 or 16 bits a channel",
                        mName, mFile.format, model);
            mFormat = *format;
        }
        const bool isBasis = mFile.format == 0;
        mTexture.isSrgb = isBasis ? mFile.description.transfer == Ktx2Description::kSrgb : mFormat.isSrgb;
        mIsHalf = !isLz && !mFormat.hasCodesOf8();
        using backend::Format;
        mTexture.image.format = mIsHalf ? (mOptions.isFull ? Format::RGBA32F : Format::RGBA16F)
                                        : (mTexture.isSrgb ? Format::RGBA8Srgb : Format::RGBA8);
        mIsKept = mOptions.keepsBc7 && !mOptions.isOneLevel && isWholeBc7();
        if (mIsKept) mTexture.image.format = mTexture.isSrgb ? Format::BC7Srgb : Format::BC7;
        if (mOptions.keepsBc6 && mFormat.block && mFormat.block->kind == BlockKind::Bc6 && !isArranged(mFile))
            mIsKept = true, mTexture.image.format = Format::BC6HUfloat;
        return {};
    }

    bool isWholeBc7() const {
        return mFormat.block && mFormat.block->kind == BlockKind::Bc7 && !isArranged(mFile) &&
               mFile.levels.size() == backend::fullMipCount(mFile.width, mFile.height);
    }

    uint32_t firstLevel() const {
        uint32_t level = 0;
        while (mOptions.maxSize && level + 1 < mFile.levels.size() &&
               std::max(widthOf(level), heightOf(level)) > mOptions.maxSize)
            ++level;
        return level;
    }

    Result<void> readBooks() {
        const auto count = static_cast<uint32_t>(mFile.levels.size()) * mFile.layers;
        if (mFile.globalData.size() / 20 < count) return damaged("its codebooks are cut short");
        Result<BasisLz> books = BasisLz::read(mFile.globalData, count);
        if (!books) return damaged(books.error().message);
        mBooks = std::move(*books);
        return {};
    }

    Result<void> decodeLevel(uint32_t level, std::span<std::byte> texels) {
        if (mBooks) return decodeSlices(level, texels);
        const uint32_t width = widthOf(level), height = heightOf(level);
        const uint64_t imageBytes = imageBytesOf(level);
        const Result<std::span<const std::byte>> plain =
                inflatedLevel(mFile, level, imageBytes * mFile.layers, mName, mInflated);
        if (!plain) return plain.error();
        const size_t layerTexels = texels.size() / mFile.layers;
        for (uint32_t layer = 0; layer < mFile.layers; ++layer)
            decodeImage(plain->subspan(layer * imageBytes, imageBytes), width, height,
                        texels.subspan(layer * layerTexels, layerTexels));
        return {};
    }

    void decodeImage(std::span<const std::byte> bytes, uint32_t width, uint32_t height, std::span<std::byte> texels) {
        if (mIsKept) return void(std::ranges::copy(bytes, texels.begin()));
        if (!mFormat.block) {
            if (mIsHalf) return decodeFloats(mFormat, bytes, mOptions.isFull, texels);
            return decodeCodes(mFormat, bytes, texels);
        }
        if (!mIsHalf || !mOptions.isFull) {
            decodeBlocks(*mFormat.block, mTexture.isSrgb, bytes, width, height, texels);
            if (mFormat.block->kind == BlockKind::Uastc) keepUastcChannels(texels);
            return;
        }
        std::vector<std::byte> halves(texels.size() / 2);
        decodeBlocks(*mFormat.block, mTexture.isSrgb, bytes, width, height, halves);
        widenHalves(halves, texels);
    }

    /// Blocks have more channels than some textures.
    void keepUastcChannels(std::span<std::byte> texels) const {
        if (mFile.description.channels.empty()) return;
        const uint8_t channels = mFile.description.channels.front();
        const bool isOpaque = channels == kUastcRgb || channels == kUastcRrr || channels == kUastcRg;
        for (size_t i = 0; i < texels.size() && isOpaque; i += 4) {
            texels[i + 3] = std::byte{ 255 };
            if (channels == kUastcRg) texels[i + 2] = std::byte{ 0 };
        }
    }

    Result<void> decodeSlices(uint32_t level, std::span<std::byte> texels) {
        const size_t count = size_t{ widthOf(level) } * heightOf(level);
        for (uint32_t layer = 0; layer < mFile.layers; ++layer) {
            if (Result<void> decoded = decodeSlicesOf(level, layer, texels.subspan(layer * count * 4, count * 4));
                !decoded)
                return decoded.error();
        }
        return {};
    }

    /// The colours of one image, and its alpha.
    Result<void> decodeSlicesOf(uint32_t level, uint32_t layer, std::span<std::byte> texels) {
        blocks::BasisImage const& image = mBooks->images()[size_t{ level } * mFile.layers + layer];
        if (image.refersToPrevious())
            return fail(ErrorCode::Unsupported, "image '{}' is a video; export its pictures one by one", mName);
        const bool hasAlpha = mFile.description.channels.size() > 1;
        if (hasAlpha != (image.alphaLength > 0))
            return damaged(fmt::format("level {} {} alpha, unlike its descriptor", level, hasAlpha ? "has no" : "has"));
        mSlice.resize(texels.size() / 4);
        if (Result<void> decoded = decodeSlice(level, image.colorOffset, image.colorLength); !decoded) return decoded;
        const bool isGrey = !mFile.description.channels.empty() && mFile.description.channels.front() == kEtc1sRrr;
        for (size_t i = 0; i < mSlice.size(); ++i) {
            if (isGrey) mSlice[i].g = mSlice[i].b = mSlice[i].r;
            std::memcpy(&texels[4 * i], &mSlice[i], sizeof(Texel8));
        }
        if (!hasAlpha) return {};
        if (Result<void> decoded = decodeSlice(level, image.alphaOffset, image.alphaLength); !decoded) return decoded;
        for (size_t i = 0; i < mSlice.size(); ++i) texels[4 * i + 3] = std::byte{ mSlice[i].g };
        return {};
    }

    Result<void> decodeSlice(uint32_t level, uint64_t offset, uint64_t length) {
        const std::span<const std::byte> bytes = mFile.levels[level].bytes;
        if (length == 0 || offset + length > bytes.size())
            return damaged(
                    fmt::format("a slice of level {} ends at byte {} of {}", level, offset + length, bytes.size()));
        const Result<void> decoded =
                mBooks->decodeSlice(bytes.subspan(offset, length), widthOf(level), heightOf(level), mSlice);
        if (!decoded) return damaged(fmt::format("level {}: {}", level, decoded.error().message));
        return {};
    }

    Ktx2File const& mFile;
    std::string_view mName;
    Ktx2Options mOptions;
    Ktx2Format mFormat;
    bool mIsHalf = false;
    bool mIsKept = false; ///< as blocks
    std::optional<BasisLz> mBooks;
    std::vector<std::byte> mInflated;
    std::vector<Texel8> mSlice;
    Ktx2Texture mTexture;
};

} // namespace

Result<Ktx2Texture> decodeKtx2(std::span<const std::byte> bytes, std::string_view name, Ktx2Options const& options) {
    const Result<Ktx2File> file = readKtx2(bytes, name);
    if (!file) return file.error();
    return Ktx2Levels(*file, name, options).decode();
}

} // namespace filament_core::assets
