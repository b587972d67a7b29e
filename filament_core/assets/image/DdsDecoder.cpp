// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/DdsDecoder.h"

#include "filament_core/assets/blocks/BlockDecoder.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Formats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr size_t kDdsHeader = 128, kDdsHeader10 = 148; // with the magic number

constexpr uint32_t fourCc(const char (&text)[5]) {
    uint32_t code = 0;
    for (size_t i = 4; i-- > 0;) code = code << 8 | static_cast<uint8_t>(text[i]);
    return code;
}

uint32_t wordAt(std::span<const std::byte> bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    return value;
}

/// The VkFormat with the same texels.
struct DdsFormatRow {
    uint32_t code; ///< a DXGI_FORMAT, or a four-character code
    uint32_t vkFormat;
};

constexpr std::array kDxgiFormats{
    DdsFormatRow{ 2, 109 },  DdsFormatRow{ 6, 106 },  DdsFormatRow{ 10, 97 },  DdsFormatRow{ 11, 91 },
    DdsFormatRow{ 13, 92 },  DdsFormatRow{ 16, 103 }, DdsFormatRow{ 24, 64 },  DdsFormatRow{ 26, 122 },
    DdsFormatRow{ 28, 37 },  DdsFormatRow{ 29, 43 },  DdsFormatRow{ 31, 38 },  DdsFormatRow{ 34, 83 },
    DdsFormatRow{ 35, 77 },  DdsFormatRow{ 37, 78 },  DdsFormatRow{ 41, 100 }, DdsFormatRow{ 49, 16 },
    DdsFormatRow{ 51, 17 },  DdsFormatRow{ 54, 76 },  DdsFormatRow{ 56, 70 },  DdsFormatRow{ 58, 71 },
    DdsFormatRow{ 61, 9 },   DdsFormatRow{ 63, 10 },  DdsFormatRow{ 67, 123 }, DdsFormatRow{ 71, 133 },
    DdsFormatRow{ 72, 134 }, DdsFormatRow{ 74, 135 }, DdsFormatRow{ 75, 136 }, DdsFormatRow{ 77, 137 },
    DdsFormatRow{ 78, 138 }, DdsFormatRow{ 80, 139 }, DdsFormatRow{ 81, 140 }, DdsFormatRow{ 83, 141 },
    DdsFormatRow{ 84, 142 }, DdsFormatRow{ 85, 4 },   DdsFormatRow{ 86, 8 },   DdsFormatRow{ 87, 44 },
    DdsFormatRow{ 88, 44 },  DdsFormatRow{ 91, 50 },  DdsFormatRow{ 93, 50 },  DdsFormatRow{ 95, 143 },
    DdsFormatRow{ 96, 144 }, DdsFormatRow{ 98, 145 }, DdsFormatRow{ 99, 146 },
};
constexpr uint32_t kA8 = 65, kB8G8R8X8 = 88, kB8G8R8X8Srgb = 93, kB4G4R4A4 = 115;

/// Of headers without a DXGI format; numbers are those of D3DFORMAT.
constexpr std::array kFourCcs{
    DdsFormatRow{ fourCc("DXT1"), 133 },
    DdsFormatRow{ fourCc("DXT3"), 135 },
    DdsFormatRow{ fourCc("DXT5"), 137 },
    DdsFormatRow{ fourCc("ATI1"), 139 },
    DdsFormatRow{ fourCc("BC4U"), 139 },
    DdsFormatRow{ fourCc("BC4S"), 140 },
    DdsFormatRow{ fourCc("ATI2"), 141 },
    DdsFormatRow{ fourCc("BC5U"), 141 },
    DdsFormatRow{ fourCc("BC5S"), 142 },
    DdsFormatRow{ 36, 91 },
    DdsFormatRow{ 110, 92 },
    DdsFormatRow{ 111, 76 },
    DdsFormatRow{ 112, 83 },
    DdsFormatRow{ 113, 97 },
    DdsFormatRow{ 114, 100 },
    DdsFormatRow{ 115, 103 },
    DdsFormatRow{ 116, 109 },
};

std::optional<Ktx2Format> formatFrom(std::span<const DdsFormatRow> rows, uint32_t code) {
    const auto row = std::ranges::find(rows, code, &DdsFormatRow::code);
    return row == rows.end() ? std::nullopt : ktx2Format(row->vkFormat);
}

std::optional<Ktx2Format> formatFromDxgi(uint32_t dxgi) {
    Ktx2Format format{ .block = {}, .texelBytes = 1, .channels = {} };
    if (dxgi == kA8) {
        format.channels[3] = { 0, 8 };
        return format;
    }
    if (dxgi == kB4G4R4A4) {
        format.texelBytes = 2;
        format.channels = { { { 8, 4 }, { 4, 4 }, { 0, 4 }, { 12, 4 } } };
        return format;
    }
    std::optional<Ktx2Format> found = formatFrom(kDxgiFormats, dxgi);
    if (found && (dxgi == kB8G8R8X8 || dxgi == kB8G8R8X8Srgb)) found->channels[3] = {};
    return found;
}

/// Nothing for a mask with holes.
std::optional<Ktx2Channel> channelFrom(uint32_t mask) {
    if (mask == 0) return Ktx2Channel{};
    const auto first = static_cast<uint8_t>(std::countr_zero(mask));
    const auto bits = static_cast<uint8_t>(std::popcount(mask));
    if (static_cast<uint64_t>(mask) >> first != (uint64_t{ 1 } << bits) - 1) return std::nullopt;
    return Ktx2Channel{ first, bits };
}

struct DdsLevel {
    uint32_t width = 0, height = 0;
    std::span<const std::byte> bytes;
};

/// Reads the parts of one file; the first error ends it.
class DdsReader {
public:
    DdsReader(std::span<const std::byte> bytes, std::string_view name) : mBytes(bytes), mName(name) {}

    Result<DdsTexture> decode(Ktx2Options const& options) {
        if (Result<void> read = readHeader(); !read) return read.error();
        const uint32_t all = backend::fullMipCount(mWidth, mHeight);
        const bool isWhole = mLevelCount == all && !options.isOneLevel;
        uint32_t first = 0;
        while (isWhole && options.maxSize && first + 1 < all && std::max(mWidth, mHeight) >> first > options.maxSize)
            ++first;
        const Result<std::vector<DdsLevel>> levels = levelsFrom(first, isWhole ? all - first : 1);
        if (!levels) return levels.error();
        DdsTexture texture{ .image = {},
                            .isSrgb = mFormat.isSrgb ? std::optional(true) : std::nullopt,
                            .isRg = isTwoChannels() };
        const bool isKept = options.keepsBc7 && isWhole && mFormat.block && mFormat.block->kind == BlockKind::Bc7;
        texture.image.format =
                isKept ? (mFormat.isSrgb ? backend::Format::BC7Srgb : backend::Format::BC7) : formatOfTexels(options);
        texture.image.width = levels->front().width, texture.image.height = levels->front().height;
        texture.image.levels = static_cast<uint32_t>(levels->size());
        texture.image.data.resize(texture.image.levelOffset(texture.image.levels));
        for (uint32_t i = 0; i < levels->size(); ++i) {
            const auto texels =
                    std::span(texture.image.data).subspan(texture.image.levelOffset(i), texture.image.levelBytes(i));
            if (isKept)
                std::ranges::copy((*levels)[i].bytes, texels.begin());
            else
                decodeLevel((*levels)[i], options.isFull, texels);
        }
        return texture;
    }

private:
    uint32_t word(size_t at) const { return wordAt(mBytes, at); }
    bool isDeep() const { return !mFormat.hasCodesOf8(); }
    backend::Format formatOfTexels(Ktx2Options const& options) const {
        using backend::Format;
        if (isDeep()) return options.isFull ? Format::RGBA32F : Format::RGBA16F;
        return mFormat.isSrgb ? Format::RGBA8Srgb : Format::RGBA8;
    }

    template <class... T>
    Error damaged(fmt::format_string<T...> what, T&&... values) const {
        return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {}; export it again", mName,
                    fmt::format(what, std::forward<T>(values)...));
    }
    Error unsupported(std::string const& what, const char* cure) const {
        return fail(ErrorCode::Unsupported, "image '{}' {}; {}", mName, what, cure);
    }

    Result<void> readHeader() {
        if (mBytes.size() < kDdsHeader) return damaged("the file is cut short");
        if (word(4) != 124) return damaged("its header says that it has {} bytes, not 124", word(4));
        mHeight = word(12), mWidth = word(16);
        if (mWidth == 0 || mHeight == 0) return damaged("it is {} x {} texels", mWidth, mHeight);
        if (mWidth > kMaxImageSide || mHeight > kMaxImageSide)
            return unsupported(fmt::format("is {} x {} texels, more than {} on a side", mWidth, mHeight, kMaxImageSide),
                               "make it smaller");
        mLevelCount = std::max(word(28), 1u);
        const uint32_t most = backend::fullMipCount(mWidth, mHeight);
        if (mLevelCount > most) return damaged("it has {} levels, and its size has only {}", mLevelCount, most);
        constexpr uint32_t kCube = 0x200, kVolume = 0x200000;
        if ((word(112) & kCube) != 0) return unsupported("is a cube", "export it as a two-dimensional texture");
        if ((word(112) & kVolume) != 0)
            return unsupported("has three dimensions", "export it as a two-dimensional texture");
        return readFormat();
    }

    Result<void> readFormat() {
        constexpr uint32_t kHasFourCc = 4;
        if ((word(80) & kHasFourCc) == 0) return readMasks();
        const uint32_t code = word(84);
        if (code == fourCc("DX10")) return readHeader10();
        if (code == fourCc("DXT2") || code == fourCc("DXT4")) return premultiplied();
        const std::optional<Ktx2Format> format = formatFrom(kFourCcs, code);
        if (!format) return unknown(fmt::format("four-character code {:#010x}", code));
        mFormat = *format;
        return {};
    }

    Result<void> readHeader10() {
        if (mBytes.size() < kDdsHeader10) return damaged("the file is cut short");
        mBegin = kDdsHeader10;
        constexpr uint32_t kTwoDimensions = 3, kIsCube = 4, kPremultiplied = 2;
        if (word(132) != kTwoDimensions)
            return unsupported(fmt::format("has resource dimension {}, not 3", word(132)),
                               "export it as a two-dimensional texture");
        if ((word(136) & kIsCube) != 0) return unsupported("is a cube", "export it as a two-dimensional texture");
        if (word(140) > 1) return unsupported("is an array", "export it as a two-dimensional texture");
        if ((word(144) & 7) == kPremultiplied) return premultiplied();
        const std::optional<Ktx2Format> format = formatFromDxgi(word(128));
        if (!format) return unknown(fmt::format("DXGI_FORMAT {}", word(128)));
        mFormat = *format;
        return {};
    }

    Result<void> readMasks() {
        constexpr uint32_t kHasAlpha = 1, kIsAlpha = 2, kIsRgb = 0x40, kIsLuminance = 0x20000;
        const uint32_t flags = word(80), bits = word(88);
        if ((flags & (kIsAlpha | kIsRgb | kIsLuminance)) == 0)
            return unknown(fmt::format("pixel format flags {:#x}", flags));
        if (bits == 0 || bits > 32 || bits % 8 != 0) return unknown(fmt::format("{} bits a texel", bits));
        mFormat.texelBytes = static_cast<uint8_t>(bits / 8);
        for (size_t c = 0; c < 4; ++c) {
            const bool isColor = c < 3, isGrey = (flags & kIsLuminance) != 0;
            const bool isThere =
                    isColor ? (flags & (kIsRgb | kIsLuminance)) != 0 : (flags & (kHasAlpha | kIsAlpha)) != 0;
            const uint32_t mask = !isThere ? 0 : word(92 + 4 * (isColor && isGrey ? 0 : c));
            const std::optional<Ktx2Channel> channel = channelFrom(mask);
            if (!channel || (mask != 0 && static_cast<uint32_t>(std::bit_width(mask)) > bits))
                return unknown(fmt::format("channel mask {:#010x} of {} bits", mask, bits));
            mFormat.channels[c] = *channel;
        }
        return {};
    }

    Error premultiplied() const {
        return unsupported("has colours that are multiplied by alpha", "export it with straight alpha");
    }
    Error unknown(std::string const& what) const {
        return unsupported("has " + what + ", which is not read", "export it as BC1 to BC7, or with 8 bits a channel");
    }

    Result<std::vector<DdsLevel>> levelsFrom(uint32_t first, uint32_t count) const {
        std::vector<DdsLevel> levels;
        uint64_t at = mBegin;
        for (uint32_t level = 0; level < first + count; ++level) {
            const uint32_t width = std::max(mWidth >> level, 1u), height = std::max(mHeight >> level, 1u);
            const uint64_t bytes = mFormat.block ? bytesOfBlocks(*mFormat.block, width, height)
                                                 : uint64_t{ width } * height * mFormat.texelBytes;
            if (bytes > mBytes.size() || at > mBytes.size() - bytes)
                return damaged("its level {} is {} bytes from byte {} on, and the file has {}", level, bytes, at,
                               mBytes.size());
            if (level >= first) levels.push_back({ width, height, mBytes.subspan(at, bytes) });
            at += bytes;
        }
        return levels;
    }

    bool isTwoChannels() const {
        if (mFormat.block) return mFormat.block->kind == BlockKind::Bc5;
        return mFormat.channels[1].bits > 0 && mFormat.channels[2].bits == 0 && mFormat.numbers == Ktx2Numbers::Codes;
    }

    void decodeLevel(DdsLevel const& level, bool isFull, std::span<std::byte> texels) const {
        if (!mFormat.block) {
            if (isDeep()) return decodeFloats(mFormat, level.bytes, isFull, texels);
            return decodeCodes(mFormat, level.bytes, texels);
        }
        if (!isDeep() || !isFull)
            return decodeBlocks(*mFormat.block, mFormat.isSrgb, level.bytes, level.width, level.height, texels);
        std::vector<std::byte> halves(texels.size() / 2);
        decodeBlocks(*mFormat.block, mFormat.isSrgb, level.bytes, level.width, level.height, halves);
        widenHalves(halves, texels);
    }

    std::span<const std::byte> mBytes;
    std::string_view mName;
    uint32_t mWidth = 0, mHeight = 0, mLevelCount = 1;
    size_t mBegin = kDdsHeader;
    Ktx2Format mFormat{};
};

} // namespace

bool isDds(std::span<const std::byte> bytes) { return bytes.size() >= 4 && wordAt(bytes, 0) == fourCc("DDS "); }

uint2 ddsSize(std::span<const std::byte> bytes) {
    return isDds(bytes) && bytes.size() >= kDdsHeader ? uint2(wordAt(bytes, 16), wordAt(bytes, 12)) : uint2(0);
}

Result<DdsTexture> decodeDds(std::span<const std::byte> bytes, std::string_view name, Ktx2Options const& options) {
    return DdsReader(bytes, name).decode(options);
}

} // namespace filament_core::assets
