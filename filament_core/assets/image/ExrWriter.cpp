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

std::vector<std::byte> channelList(std::string_view sorted, ExrType type) {
    ExrOutput list;
    for (const char name : sorted) {
        list.addText({ &name, 1 });
        list.addValue(type);
        list.addValue(uint32_t{ 0 });      // not perceptual, and three bytes of nothing
        list.addValue(std::array{ 1, 1 }); // every column and row has a sample
    }
    list.addValue('\0');
    return list.take();
}

void addHeader(ExrOutput& file, ExrPixels const& pixels, std::string_view sorted) {
    constexpr std::array kZip{ ExrCompression::Zip };
    constexpr std::array<uint8_t, 1> kIncreasingY{ 0 };
    const std::array window{ 0, 0, static_cast<int32_t>(pixels.width - 1), static_cast<int32_t>(pixels.height - 1) };
    file.addValue(std::array<uint8_t, 4>{ 0x76, 0x2F, 0x31, 0x01 });
    file.addValue(uint32_t{ 2 }); // version 2: one part of scan lines, names of up to 31 letters
    file.addAttribute("channels", "chlist", channelList(sorted, pixels.type));
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

/// Rows as in files: all samples of the first channel, then all of the second, ...
template <class Sample>
void gatherRows(ExrPixels const& pixels, std::string_view sorted, size_t firstRow, std::span<std::byte> rows) {
    const size_t pitch = pixels.channels.size() * sizeof(Sample);
    std::byte* to = rows.data();
    for (size_t y = firstRow; to != rows.data() + rows.size(); ++y) {
        for (const char name : sorted) {
            const std::byte* from = pixels.samples.data() + y * pixels.width * pitch;
            from += pixels.channels.find(name) * sizeof(Sample);
            for (size_t x = 0; x < pixels.width; ++x, from += pitch, to += sizeof(Sample))
                std::memcpy(to, from, sizeof(Sample));
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

} // namespace

std::vector<std::byte> encodeExr(ExrPixels const& pixels) {
    FILAMENT_ASSERT(pixels.width > 0 && pixels.height > 0 && pixels.width <= kMaxExrSide &&
                            pixels.height <= kMaxExrSide,
                    "encodeExr takes 1 to kMaxExrSide pixels per side");
    const size_t sampleBytes = pixels.type == ExrType::Half ? 2 : 4;
    const size_t rowBytes = pixels.width * pixels.channels.size() * sampleBytes;
    FILAMENT_ASSERT(pixels.samples.size() == rowBytes * pixels.height, "encodeExr takes all samples of all pixels");
    std::string sorted(pixels.channels); // as files require
    std::ranges::sort(sorted);
    ExrOutput file;
    addHeader(file, pixels, sorted);
    size_t offset = file.size(); // of the next entry in the table of offsets
    const uint32_t blocks = (pixels.height - 1) / kRowsOfZip + 1;
    file.add(std::vector<std::byte>(blocks * sizeof(uint64_t)));
    std::vector<std::byte> rows;
    for (uint32_t y = 0; y < pixels.height; y += kRowsOfZip, offset += sizeof(uint64_t)) {
        rows.resize(rowBytes * std::min(kRowsOfZip, pixels.height - y));
        if (sampleBytes == 2)
            gatherRows<uint16_t>(pixels, sorted, y, rows);
        else
            gatherRows<uint32_t>(pixels, sorted, y, rows);
        file.set(offset, file.size());
        addBlock(file, y, rows);
    }
    return file.take();
}

} // namespace filament_core::assets
