// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Encoder.h"

#include "base/Assert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace filament_core::assets {
namespace {

using KtxBytes = std::vector<std::byte>;
using backend::Format;

struct EncodedFormat {
    Format format;
    uint32_t vkFormat, typeSize;
};
constexpr std::array<EncodedFormat, 9> kEncodedFormats{ {
        { Format::R8, 9, 1 },
        { Format::RGBA8, 37, 1 },
        { Format::RGBA8Srgb, 43, 1 },
        { Format::RGBA16F, 97, 2 },
        { Format::RGBA32F, 109, 4 },
        { Format::R11G11B10F, 122, 4 },
        { Format::RGB9E5, 123, 4 },
        { Format::BC4, 139, 1 },
        { Format::BC6HUfloat, 143, 1 },
} };

/// Where a channel lies in a texel, and which numbers stand for the ends of its range.
struct DescribedSample {
    uint32_t firstBit, bits, channel, lower, upper;
};

constexpr uint32_t kAlphaChannel = 15, kExponentSample = 0x20, kSignedSample = 0x40, kFloatSample = 0x80,
                   kLinearSample = 0x10;                              // qualifiers
constexpr uint32_t kOneBits = 0x3F800000, kMinusOneBits = 0xBF800000; // bits of floats

std::vector<DescribedSample> samplesOf(Format format) {
    if (format == Format::R11G11B10F)
        return { { 0, 11, kFloatSample | 0, 0, kOneBits },
                 { 11, 11, kFloatSample | 1, 0, kOneBits },
                 { 22, 10, kFloatSample | 2, 0, kOneBits } };
    std::vector<DescribedSample> samples;
    if (format == Format::RGB9E5) { // Khronos Data Format Specification, "E5B9G9R9"
        for (uint32_t c = 0; c < 3; ++c) {
            samples.push_back({ 9 * c, 9, c, 0, 8448 });
            samples.push_back({ 27, 5, kExponentSample | c, 15, 31 });
        }
        return samples;
    }
    if (format == Format::R8) return { { 0, 8, 0, 0, 255 } };
    if (format == Format::BC4) return { { 0, 64, 0, 0, ~0u } }; // chapter 5.6: one sample for each block
    if (format == Format::BC6HUfloat) return { { 0, 128, kFloatSample, 0, kOneBits } };
    const bool isFloat = format == Format::RGBA16F || format == Format::RGBA32F;
    const uint32_t bits = format == Format::RGBA32F ? 32 : format == Format::RGBA16F ? 16 : 8;
    for (uint32_t c = 0; c < 4; ++c) {
        const uint32_t alpha = format == Format::RGBA8Srgb ? kLinearSample | kAlphaChannel : kAlphaChannel;
        const uint32_t channel = (c == 3 ? alpha : c) | (isFloat ? kFloatSample | kSignedSample : 0);
        samples.push_back({ bits * c, bits, channel, isFloat ? kMinusOneBits : 0, isFloat ? kOneBits : 255 });
    }
    return samples;
}

void putNumber(KtxBytes& bytes, uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void putBytes(KtxBytes& bytes, std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

uint64_t roundedUp(uint64_t value, uint64_t step) { return (value + step - 1) / step * step; }

/// Colour models of the Khronos Data Format Specification.
uint32_t modelOf(Format format) {
    constexpr uint32_t kRgbsda = 1, kBc4 = 131, kBc6h = 133;
    return format == Format::BC4 ? kBc4 : format == Format::BC6HUfloat ? kBc6h : kRgbsda;
}

KtxBytes descriptionOf(Format format) {
    constexpr uint32_t kVersion = 2, kBt709 = 1;
    const std::vector<DescribedSample> samples = samplesOf(format);
    const size_t block = 24 + 16 * samples.size();
    KtxBytes bytes;
    putNumber(bytes, 4 + block, 4);
    putNumber(bytes, 0, 4), putNumber(bytes, kVersion, 2), putNumber(bytes, block, 2);
    putNumber(bytes, modelOf(format), 1), putNumber(bytes, kBt709, 1);
    putNumber(bytes, format == Format::RGBA8Srgb ? Ktx2Description::kSrgb : Ktx2Description::kLinear, 1);
    putNumber(bytes, 0, 1);                                           // straight alpha
    const uint32_t last = backend::formatInfo(format).blockSize - 1u; // blocks of 1 x 1 or 4 x 4
    putNumber(bytes, last, 1), putNumber(bytes, last, 1), putNumber(bytes, 0, 2);
    putNumber(bytes, backend::formatInfo(format).bytesPerBlock, 1), putNumber(bytes, 0, 7); // one plane
    for (DescribedSample const& sample : samples) {
        putNumber(bytes, sample.firstBit, 2), putNumber(bytes, sample.bits - 1, 1), putNumber(bytes, sample.channel, 1);
        putNumber(bytes, 0, 4), putNumber(bytes, sample.lower, 4), putNumber(bytes, sample.upper, 4);
    }
    return bytes;
}

/// Pairs are sorted by their keys, and padded to 4 bytes each.
KtxBytes pairsOf(std::span<const Ktx2Value> values) {
    std::vector<Ktx2Value> sorted(values.begin(), values.end());
    sorted.push_back(ktx2Text("KTXorientation", "rd"));
    std::ranges::sort(sorted, {}, &Ktx2Value::key);
    KtxBytes bytes;
    for (auto const& [key, value] : sorted) {
        putNumber(bytes, key.size() + 1 + value.size(), 4);
        putBytes(bytes, std::as_bytes(std::span(key)));
        bytes.push_back(std::byte{ 0 });
        putBytes(bytes, value);
        bytes.resize(roundedUp(bytes.size(), 4));
    }
    return bytes;
}

EncodedFormat const& encodedFormat(Format format) {
    const auto found = std::ranges::find(kEncodedFormats, format, &EncodedFormat::format);
    FILAMENT_ASSERT(found != kEncodedFormats.end(), "a KTX 2.0 file is written of a format that Ktx2Encoder.h names");
    return *found;
}

constexpr uint64_t kKtx2HeaderBytes = 80, kLevelEntryBytes = 24;

/// The smallest level comes first in the file; each starts at a multiple of its texels and of 4.
std::vector<uint64_t> levelPlaces(Image const& image, uint64_t begin) {
    const uint64_t step = std::lcm(uint64_t{ backend::formatInfo(image.format).bytesPerBlock }, uint64_t{ 4 });
    std::vector<uint64_t> places(image.levels);
    for (uint32_t level = image.levels; level-- > 0;) {
        places[level] = roundedUp(begin, step);
        begin = places[level] + image.levelBytes(level);
    }
    return places;
}

} // namespace

Ktx2Value ktx2Text(std::string_view key, const char* text) {
    return { key, std::as_bytes(std::span(text, std::strlen(text) + 1)) };
}

std::optional<Format> formatOfVkFormat(uint32_t vkFormat) {
    const auto found = std::ranges::find(kEncodedFormats, vkFormat, &EncodedFormat::vkFormat);
    return found == kEncodedFormats.end() ? std::nullopt : std::optional(found->format);
}

std::vector<std::byte> encodeKtx2(Image const& image, std::span<const Ktx2Value> values) {
    FILAMENT_ASSERT(image.layers == 1 || (image.layers == 6 && image.width == image.height),
                    "a KTX 2.0 file is written of a picture or of a cube");
    FILAMENT_ASSERT(image.data.size() == image.levelOffset(image.levels), "an image has all its texels");
    const EncodedFormat format = encodedFormat(image.format);
    const KtxBytes description = descriptionOf(image.format), pairs = pairsOf(values);
    const uint64_t descriptionAt = kKtx2HeaderBytes + kLevelEntryBytes * image.levels;
    const uint64_t pairsAt = descriptionAt + description.size();
    const std::vector<uint64_t> places = levelPlaces(image, pairsAt + pairs.size());

    constexpr std::string_view kIdentifier("\xABKTX 20\xBB\r\n\x1A\n", 12);
    KtxBytes bytes;
    bytes.reserve(places.front() + image.levelBytes(0));
    putBytes(bytes, std::as_bytes(std::span(kIdentifier)));
    for (const uint32_t number : { format.vkFormat, format.typeSize, image.width, image.height, 0u, 0u, image.layers,
                                   image.levels, static_cast<uint32_t>(Ktx2Compression::None) })
        putNumber(bytes, number, 4);
    putNumber(bytes, descriptionAt, 4), putNumber(bytes, description.size(), 4);
    putNumber(bytes, pairsAt, 4), putNumber(bytes, pairs.size(), 4);
    putNumber(bytes, 0, 8), putNumber(bytes, 0, 8); // no supercompression
    for (uint32_t level = 0; level < image.levels; ++level) {
        putNumber(bytes, places[level], 8);
        putNumber(bytes, image.levelBytes(level), 8), putNumber(bytes, image.levelBytes(level), 8);
    }
    putBytes(bytes, description), putBytes(bytes, pairs);
    for (uint32_t level = image.levels; level-- > 0;) {
        bytes.resize(places[level]);
        putBytes(bytes, std::span(image.data).subspan(image.levelOffset(level), image.levelBytes(level)));
    }
    return bytes;
}

} // namespace filament_core::assets
