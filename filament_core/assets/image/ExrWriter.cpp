// SPDX-License-Identifier: Apache-2.0
// "OpenEXR File Layout", and "Technical Introduction to OpenEXR", section "Data Compression" (openexr.com).
#include "filament_core/assets/image/ExrWriter.h"

#include "base/Assert.h"
#include "filament_core/assets/image/Zlib.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

namespace filament_core::assets {
namespace {

constexpr uint32_t kRowsOfZip = 16;
constexpr int kExrZlibLevel = 6; // zlib's default

// Red, green, blue, white: ITU-R BT.709-6, item 1.
constexpr std::array kRec709{ 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f };

/// A file that grows. Little-endian, like all supported machines.
class ExrOutput {
public:
    size_t size() const { return mBytes.size(); }
    std::vector<std::byte> take() { return std::move(mBytes); }

    void add(std::span<const std::byte> bytes) { mBytes.insert(mBytes.end(), bytes.begin(), bytes.end()); }
    template <class T>
    void addValue(T const& value) {
        static_assert(std::has_unique_object_representations_v<T> && std::endian::native == std::endian::little);
        add(std::as_bytes(std::span(&value, 1)));
    }
    void addText(std::string_view text) {
        add(std::as_bytes(std::span(text)));
        addValue('\0');
    }
    void addAttribute(std::string_view name, std::string_view type, std::span<const std::byte> value) {
        addText(name);
        addText(type);
        addValue(static_cast<uint32_t>(value.size()));
        add(value);
    }
    template <class T, size_t N>
    void addAttribute(std::string_view name, std::string_view type, std::array<T, N> const& values) {
        addAttribute(name, type, std::as_bytes(std::span(values)));
    }
    /// Overwrites what was added before.
    void set(size_t at, uint64_t value) { std::memcpy(&mBytes[at], &value, sizeof(value)); }

private:
    std::vector<std::byte> mBytes;
};

using Channels = std::vector<ExrSource>; // as files require: sorted by name

size_t bytesOf(ExrType type) { return type == ExrType::Half ? 2 : 4; }

std::vector<std::byte> channelList(Channels const& channels) {
    ExrOutput list;
    for (ExrSource const& channel : channels) {
        list.addText(channel.name);
        list.addValue(channel.type);
        list.addValue(uint32_t{ 0 });      // not perceptual, and three bytes of nothing
        list.addValue(std::array{ 1, 1 }); // every column and row has a sample
    }
    list.addValue('\0');
    return list.take();
}

void addHeader(ExrOutput& file, uint32_t width, uint32_t height, Channels const& channels) {
    constexpr std::array kZip{ ExrCompression::Zip };
    constexpr std::array<uint8_t, 1> kIncreasingY{ 0 };
    const std::array window{ 0, 0, static_cast<int32_t>(width - 1), static_cast<int32_t>(height - 1) };
    file.addValue(std::array<uint8_t, 4>{ 0x76, 0x2F, 0x31, 0x01 });
    file.addValue(uint32_t{ 2 }); // version 2: one part of scan lines, names of up to 31 letters
    file.addAttribute("channels", "chlist", channelList(channels));
    file.addAttribute("compression", "compression", kZip);
    file.addAttribute("dataWindow", "box2i", window);
    file.addAttribute("displayWindow", "box2i", window);
    file.addAttribute("lineOrder", "lineOrder", kIncreasingY);
    file.addAttribute("pixelAspectRatio", "float", std::array{ 1.0f });
    file.addAttribute("screenWindowCenter", "v2f", std::array{ 0.0f, 0.0f });
    file.addAttribute("screenWindowWidth", "float", std::array{ 1.0f });
    file.addAttribute("chromaticities", "chromaticities", kRec709);
    file.addValue('\0');
}

template <size_t Bytes>
std::byte* gather(ExrSource const& channel, size_t firstPixel, uint32_t count, std::byte* to) {
    const std::byte* from = channel.samples + firstPixel * channel.pitch;
    for (uint32_t x = 0; x < count; ++x, from += channel.pitch, to += Bytes) std::memcpy(to, from, Bytes);
    return to;
}

/// Rows as in files: all samples of the first channel, then all of the second, ...
void gatherRows(Channels const& channels, uint32_t width, size_t firstRow, std::span<std::byte> rows) {
    std::byte* to = rows.data();
    for (size_t y = firstRow; to != rows.data() + rows.size(); ++y) {
        for (ExrSource const& channel : channels) {
            to = bytesOf(channel.type) == 2 ? gather<2>(channel, y * width, width, to)
                                            : gather<4>(channel, y * width, width, to);
        }
    }
}

/// What undoPredictor() undoes: even bytes before odd ones, then differences to the byte before.
std::vector<std::byte> predicted(std::span<const std::byte> rows) {
    std::vector<std::byte> bytes(rows.size());
    const size_t half = (rows.size() + 1) / 2;
    for (size_t i = 0; i < rows.size(); ++i) bytes[(i & 1) ? half + i / 2 : i / 2] = rows[i];
    for (size_t i = bytes.size() - 1; i > 0; --i) {
        const int difference = std::to_integer<int>(bytes[i]) - std::to_integer<int>(bytes[i - 1]) + 128;
        bytes[i] = static_cast<std::byte>(difference & 0xFF);
    }
    return bytes;
}

/// Its first row, its size, its rows.
void addBlock(ExrOutput& file, uint32_t firstRow, std::span<const std::byte> rows) {
    const std::vector<std::byte> packed = deflateZlib(predicted(rows), kExrZlibLevel);
    const std::span<const std::byte> smaller = packed.size() < rows.size() ? packed : rows;
    file.addValue(firstRow);
    file.addValue(static_cast<uint32_t>(smaller.size()));
    file.add(smaller);
}

Channels sorted(std::span<const ExrSource> channels) {
    Channels all(channels.begin(), channels.end());
    std::ranges::sort(all, {}, &ExrSource::name);
    return all;
}

} // namespace

std::vector<std::byte> encodeExr(uint32_t width, uint32_t height, std::span<const ExrSource> sources) {
    FILAMENT_ASSERT(width > 0 && height > 0 && width <= kMaxExrSide && height <= kMaxExrSide,
                    "encodeExr takes 1 to kMaxExrSide pixels per side");
    const Channels channels = sorted(sources);
    size_t pixelBytes = 0;
    for (ExrSource const& channel : channels) pixelBytes += bytesOf(channel.type);
    const size_t rowBytes = width * pixelBytes;
    ExrOutput file;
    addHeader(file, width, height, channels);
    size_t offset = file.size(); // of the next entry in the table of offsets
    const uint32_t blocks = (height - 1) / kRowsOfZip + 1;
    file.add(std::vector<std::byte>(blocks * sizeof(uint64_t)));
    std::vector<std::byte> rows;
    for (uint32_t y = 0; y < height; y += kRowsOfZip, offset += sizeof(uint64_t)) {
        rows.resize(rowBytes * std::min(kRowsOfZip, height - y));
        gatherRows(channels, width, y, rows);
        file.set(offset, file.size());
        addBlock(file, y, rows);
    }
    return file.take();
}

std::vector<std::byte> encodeExr(ExrPixels const& pixels) {
    const size_t sampleBytes = bytesOf(pixels.type), pitch = pixels.channels.size() * sampleBytes;
    FILAMENT_ASSERT(pixels.samples.size() == pitch * pixels.width * pixels.height,
                    "encodeExr takes all samples of all pixels");
    Channels channels;
    for (size_t i = 0; i < pixels.channels.size(); ++i)
        channels.push_back(
                { std::string(1, pixels.channels[i]), pixels.type, pixels.samples.data() + i * sampleBytes, pitch });
    return encodeExr(pixels.width, pixels.height, channels);
}

} // namespace filament_core::assets
