// SPDX-License-Identifier: Apache-2.0
// OpenEXR, scan lines and tiles of one part. "Technical Introduction to OpenEXR", "OpenEXR File Layout" (openexr.com).
#include "base/math/Half.h"
#include "filament_core/assets/image/ExrBlock.h"
#include "filament_core/assets/image/HdrDecoders.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

namespace filament_core::assets {
namespace {

struct ExrWindow {
    int64_t minX = 0, minY = 0, width = 0, height = 0;
};

struct ExrHeader {
    std::vector<ExrChannel> channels; // in file order: alphabetical
    ExrCompression compression = ExrCompression::Count;
    int32_t minX = 0, minY = 0; // of the data window, as its size
    uint32_t width = 0, height = 0;
    std::optional<ExrWindow> display{};
    std::optional<Chromaticities> primaries{};
    float pixelAspectRatio = 1, whiteLuminance = 0; // in nits; 0: unknown
    bool isCube = false;
    bool isTiled = false;
    uint32_t blockWidth = 0, blockRows = 0; // of a block that is not at an edge
    std::array<size_t, 3> source{};         // channels that provide red, green and blue
};

Error corruptExr(const char* reason) { return fail(ErrorCode::Corrupt, "{}", reason); }
Error unsupported(const char* reason) { return fail(ErrorCode::Unsupported, "{}", reason); }

Result<void> parseChannels(std::span<const std::byte> bytes, ExrHeader& header) {
    constexpr size_t kMaxChannels = 64;
    struct Layout {
        ExrType type;
        uint8_t linear, reserved[3];
        int32_t xSampling, ySampling;
    };
    ByteCursor cursor(bytes);
    for (;;) {
        const auto name = cursor.readUntil('\0', 255);
        if (!name) return corruptExr("its channel list has no end");
        if (name->empty()) return {};
        const auto layout = cursor.read<Layout>();
        if (!layout) return corruptExr("its channel list is cut short");
        if (layout->type > ExrType::Float) return corruptExr("a channel has an unknown type");
        if (layout->xSampling != 1 || layout->ySampling != 1) return unsupported("a channel is subsampled");
        if (header.channels.size() == kMaxChannels) return unsupported("it has more than 64 channels");
        header.channels.push_back({ std::string(*name), layout->type, layout->linear != 0 });
    }
}

Result<ExrWindow> parseWindow(std::string_view name, std::span<const std::byte> bytes) {
    ByteCursor cursor(bytes);
    const auto box = cursor.read<std::array<int32_t, 4>>(); // min x, min y, max x, max y, inclusive
    if (!box) return fail(ErrorCode::Corrupt, "its {} is cut short", name);
    const auto [minX, minY, maxX, maxY] = *box;
    const ExrWindow window{ minX, minY, int64_t{ maxX } - minX + 1, int64_t{ maxY } - minY + 1 };
    if (auto error = checkHdrSize(window.width, window.height))
        return fail(error->code, "of its {}: {}", name, error->message);
    return window;
}

Result<void> parseDataWindow(std::span<const std::byte> bytes, ExrHeader& header) {
    const Result<ExrWindow> window = parseWindow("dataWindow", bytes);
    if (!window) return window.error();
    header.minX = static_cast<int32_t>(window->minX);
    header.minY = static_cast<int32_t>(window->minY);
    header.width = static_cast<uint32_t>(window->width);
    header.height = static_cast<uint32_t>(window->height);
    return {};
}

Result<void> parseDisplayWindow(std::span<const std::byte> bytes, ExrHeader& header) {
    const Result<ExrWindow> window = parseWindow("displayWindow", bytes);
    if (!window) return window.error();
    header.display = *window;
    return {};
}

Result<void> parseChromaticities(std::span<const std::byte> bytes, ExrHeader& header) {
    const auto xy = ByteCursor(bytes).read<std::array<float, 8>>();
    if (!xy) return corruptExr("its chromaticities are cut short");
    const auto at = [&](size_t i) { return double2((*xy)[i], (*xy)[i + 1]); };
    header.primaries = { at(0), at(2), at(4), at(6) };
    return {};
}

Result<void> parseTiles(std::span<const std::byte> bytes, ExrHeader& header) {
    ByteCursor cursor(bytes); // the mode, which follows, says which smaller levels there are
    const auto width = cursor.read<uint32_t>(), height = cursor.read<uint32_t>();
    if (!height || *width == 0 || *height == 0) return corruptExr("its tiles have no size");
    header.blockWidth = *width;
    header.blockRows = *height;
    return {};
}

Result<void> parseAttribute(std::string_view name, std::span<const std::byte> value, ExrHeader& header) {
    if (name == "channels") return parseChannels(value, header);
    if (name == "dataWindow") return parseDataWindow(value, header);
    if (name == "displayWindow") return parseDisplayWindow(value, header);
    if (name == "chromaticities") return parseChromaticities(value, header);
    if (name == "pixelAspectRatio") header.pixelAspectRatio = ByteCursor(value).read<float>().value_or(1.0f);
    if (name == "whiteLuminance") header.whiteLuminance = ByteCursor(value).read<float>().value_or(0.0f);
    if (name == "envmap") header.isCube = !value.empty() && value[0] == std::byte{ 1 };
    if (name == "compression") {
        const auto code = value.empty() ? ExrCompression::Count : static_cast<ExrCompression>(value[0]);
        if (code >= ExrCompression::Count) return unsupported("its compression is unknown");
        header.compression = code;
    }
    return name == "tiles" && header.isTiled ? parseTiles(value, header) : Result<void>{};
}

uint32_t rowsPerBlock(ExrCompression compression) {
    constexpr std::array<uint8_t, static_cast<size_t>(ExrCompression::Dwab)> kRows{ 1, 1, 1, 16, 32, 16, 32, 32, 32 };
    return compression == ExrCompression::Dwab ? 256 : kRows[static_cast<size_t>(compression)];
}

// R, G and B, in any position; a lone luminance channel Y serves all three.
Result<void> chooseChannels(ExrHeader& header) {
    constexpr std::array<std::string_view, 3> kNames{ "R", "G", "B" };
    for (size_t i = 0; i < 3; ++i) {
        const auto named = [&](std::string_view name) {
            return std::ranges::find(header.channels, name, &ExrChannel::name);
        };
        auto found = named(kNames[i]);
        if (found == header.channels.end()) found = named("Y");
        if (found == header.channels.end()) return unsupported("it has neither channels R, G, B nor Y");
        if (found->type == ExrType::Uint) return unsupported("its colour channels are integers");
        header.source[i] = static_cast<size_t>(found - header.channels.begin());
    }
    return {};
}

/// More than any readable image needs; a file of a few bytes could request gigabytes.
constexpr size_t kMaxBlockBytes = size_t{ 1 } << 29;

Result<ExrHeader> parseHeader(ByteCursor& cursor) {
    cursor.take(4); // magic
    const auto version = cursor.read<uint32_t>();
    if (!version || (*version & 0xFF) != 2) return unsupported("it is not version 2 of OpenEXR");
    constexpr uint32_t kTiled = 0x200, kLongNames = 0x400;
    if ((*version & ~0xFFu & ~(kTiled | kLongNames)) != 0) return unsupported("it is deep or has several parts");
    ExrHeader header;
    header.isTiled = (*version & kTiled) != 0;
    for (;;) {
        const auto name = cursor.readUntil('\0', 255);
        if (!name) return corruptExr("its header has no end");
        if (name->empty()) break;
        const auto type = cursor.readUntil('\0', 255);
        const auto size = cursor.read<uint32_t>();
        const auto value = size ? cursor.take(*size) : std::nullopt;
        if (!type || !value) return corruptExr("its header is cut short");
        if (auto parsed = parseAttribute(*name, *value, header); !parsed) return parsed.error();
    }
    if (header.width == 0) return corruptExr("it has no data window");
    if (header.compression == ExrCompression::Count) return corruptExr("it does not say how it is compressed");
    if (header.isTiled && header.blockRows == 0) return corruptExr("it does not say how large its tiles are");
    if (!header.isTiled) {
        header.blockWidth = header.width;
        header.blockRows = rowsPerBlock(header.compression);
    }
    const ExrBlock largest{ header.channels, std::min(header.blockWidth, header.width),
                            std::min(header.blockRows, header.height) };
    if (largest.bytes() > kMaxBlockBytes) return unsupported("its tiles have more than 512 MiB");
    if (auto chosen = chooseChannels(header); !chosen) return chosen.error();
    return header;
}

float readSample(const std::byte* at, ExrType type) {
    if (type == ExrType::Half) {
        uint16_t bits = 0;
        std::memcpy(&bits, at, sizeof(bits));
        return floatFromHalf(bits);
    }
    float value = 0;
    std::memcpy(&value, at, sizeof(value));
    return value;
}

// One row contains all samples of the first channel, then all of the second, ...
void readRow(ExrHeader const& header, const std::byte* row, std::span<float3> pixels) {
    for (size_t component = 0; component < 3; ++component) {
        size_t offset = 0;
        for (size_t i = 0; i < header.source[component]; ++i) offset += header.channels[i].bytes() * pixels.size();
        ExrChannel const& channel = header.channels[header.source[component]];
        for (size_t x = 0; x < pixels.size(); ++x) {
            pixels[x][static_cast<int>(component)] = readSample(row + offset + x * channel.bytes(), channel.type);
        }
    }
}

struct Block {
    uint32_t x = 0, y = 0; // of its upper left pixel
    std::span<const std::byte> packed;
};

/// Blocks say themselves where they belong: scan lines by their first row, tiles by column, row, and level.
Result<Block> readBlock(ByteCursor at, ExrHeader const& header) {
    int64_t x = 0, y = 0;
    if (header.isTiled) {
        const auto tile = at.read<std::array<int32_t, 4>>();
        if (!tile) return corruptExr("a tile is cut short");
        if ((*tile)[2] != 0 || (*tile)[3] != 0) return corruptExr("tiles of the picture are not its first");
        x = int64_t{ (*tile)[0] } * header.blockWidth;
        y = int64_t{ (*tile)[1] } * header.blockRows;
    } else {
        const auto row = at.read<int32_t>();
        if (!row) return corruptExr("a block of rows is cut short");
        y = int64_t{ *row } - header.minY;
    }
    const auto size = at.read<uint32_t>();
    const auto packed = size ? at.take(*size) : std::nullopt;
    if (!packed) return corruptExr("a block of pixels is cut short");
    if (x < 0 || y < 0 || x >= header.width || y >= header.height || y % header.blockRows != 0)
        return corruptExr("a block has pixels outside of the image");
    return Block{ static_cast<uint32_t>(x), static_cast<uint32_t>(y), *packed };
}

// The offset table gives the position of each block; those of smaller levels come last and are left alone.
Result<std::vector<Block>> findBlocks(std::span<const std::byte> file, ByteCursor cursor, ExrHeader const& header) {
    const auto parts = [](uint32_t whole, uint32_t part) { return (whole - 1) / part + 1; };
    const size_t count = size_t{ parts(header.width, header.blockWidth) } * parts(header.height, header.blockRows);
    if (cursor.remaining() / sizeof(uint64_t) < count) return corruptExr("its offset table is cut short");
    std::vector<Block> blocks(count);
    for (Block& block : blocks) {
        const uint64_t offset = *cursor.read<uint64_t>();
        if (offset >= file.size()) return corruptExr("a block of pixels lies outside of the file");
        Result<Block> read = readBlock(ByteCursor(file.subspan(offset)), header);
        if (!read) return read.error();
        block = *read;
    }
    return blocks;
}

Result<HdrImage> decodeBlocks(ExrHeader const& header, std::span<const Block> blocks) {
    HdrImage image{ .width = header.width, .height = header.height, .pixels = {}, .repairs = {} };
    image.pixels.resize(size_t(image.width) * image.height);
    std::vector<std::byte> unpacked;
    for (Block const& block : blocks) {
        const ExrBlock shape{ header.channels, std::min(header.blockWidth, header.width - block.x),
                              std::min(header.blockRows, header.height - block.y) };
        unpacked.resize(shape.bytes());
        if (!unpackExrBlock(header.compression, shape, block.packed, unpacked))
            return fail(ErrorCode::Corrupt, "the block at {}, {} cannot be unpacked", block.x, block.y);
        for (uint32_t y = 0; y < shape.rows; ++y)
            readRow(header, unpacked.data() + y * shape.rowBytes(), { &image.at(block.x, block.y + y), shape.width });
    }
    return image;
}

ExrWindow shownWindow(ExrHeader const& header) {
    return header.display.value_or(
            ExrWindow{ header.minX, header.minY, int64_t{ header.width }, int64_t{ header.height } });
}

/// The pixels of the data window in the place that the display window has for them; black around them.
HdrImage inDisplayWindow(HdrImage data, ExrHeader const& header) {
    const ExrWindow display = shownWindow(header);
    const int64_t left = header.minX - display.minX, top = header.minY - display.minY;
    if (left == 0 && top == 0 && display.width == header.width && display.height == header.height) return data;
    HdrImage image{ .width = static_cast<uint32_t>(display.width),
                    .height = static_cast<uint32_t>(display.height),
                    .pixels = {},
                    .repairs = {} };
    image.pixels.resize(size_t{ image.width } * image.height, float3(0));
    const int64_t firstX = std::max<int64_t>(left, 0), endX = std::min(left + header.width, display.width);
    const int64_t firstY = std::max<int64_t>(top, 0), endY = std::min(top + header.height, display.height);
    if (firstX >= endX) return image;
    for (int64_t y = firstY; y < endY; ++y) {
        const float3* const from = &data.at(static_cast<uint32_t>(firstX - left), static_cast<uint32_t>(y - top));
        std::copy_n(from, endX - firstX, &image.at(static_cast<uint32_t>(firstX), static_cast<uint32_t>(y)));
    }
    return image;
}

void addWarnings(ExrHeader const& header, HdrImage& image) {
    const ExrWindow shown = shownWindow(header);
    const bool isSeen = shown.minX < int64_t{ header.minX } + header.width && header.minX < shown.minX + shown.width &&
                        shown.minY < int64_t{ header.minY } + header.height && header.minY < shown.minY + shown.height;
    if (!isSeen)
        image.warnings.emplace_back(
                "it is black: its dataWindow lies outside of its displayWindow; correct one of them");
    if (header.pixelAspectRatio != 1)
        image.panoramaWarnings.push_back(
                fmt::format("its pixelAspectRatio of {} is left out: a panorama covers 360 by 180 degrees in any size",
                            header.pixelAspectRatio));
    if (header.whiteLuminance > 0 && header.whiteLuminance != 1)
        image.panoramaWarnings.push_back(
                fmt::format("its whiteLuminance of {} cd/m^2 is left out; set the intensity of the environment",
                            header.whiteLuminance));
}

} // namespace

bool isExr(std::span<const std::byte> bytes) {
    constexpr std::array<std::byte, 4> kMagic{ std::byte{ 0x76 }, std::byte{ 0x2F }, std::byte{ 0x31 },
                                               std::byte{ 0x01 } };
    return bytes.size() >= 4 && std::ranges::equal(bytes.first(4), kMagic);
}

Result<DecodedHdr> decodeExr(std::span<const std::byte> bytes, HdrPart part) {
    ByteCursor cursor(bytes);
    const Result<ExrHeader> header = parseHeader(cursor);
    if (!header) return header.error();
    DecodedHdr decoded;
    const ExrWindow window = shownWindow(*header);
    decoded.image.width = static_cast<uint32_t>(window.width);
    decoded.image.height = static_cast<uint32_t>(window.height);
    if (part == HdrPart::All) {
        const Result<std::vector<Block>> blocks = findBlocks(bytes, cursor, *header);
        if (!blocks) return blocks.error();
        Result<HdrImage> image = decodeBlocks(*header, *blocks);
        if (!image) return image.error();
        decoded.image = inDisplayWindow(std::move(*image), *header);
    }
    const bool isGrey = header->source[0] == header->source[1] && header->source[1] == header->source[2];
    if (!isGrey) decoded.primaries = header->primaries; // white stays white
    decoded.image.isCube = header->isCube;
    addWarnings(*header, decoded.image);
    return decoded;
}

} // namespace filament_core::assets
