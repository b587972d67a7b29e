// SPDX-License-Identifier: Apache-2.0
// OpenEXR, single-part scan lines. "Technical Introduction to OpenEXR" and "OpenEXR File Layout" (openexr.com).
// Nothing is left to libtinyexr, which leaks memory and asserts on damaged files.
#include "base/math/Half.h"
#include "filament_core/assets/image/HdrDecoders.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>

namespace filament::assets {
namespace {

enum class Compression : uint8_t { None, Rle, Zips, Zip, Piz, Count };
enum class PixelType : uint32_t { Uint, Half, Float };

struct Channel {
    std::string name;
    PixelType type = PixelType::Half;
    size_t bytes() const { return type == PixelType::Half ? 2 : 4; }
};

struct ExrHeader {
    std::vector<Channel> channels; // in file order: alphabetical
    Compression compression = Compression::Count;
    int32_t minX = 0, minY = 0;
    uint32_t width = 0, height = 0;
    std::array<size_t, 3> source{}; // channels that provide red, green and blue

    uint32_t rowsPerChunk() const {
        return compression == Compression::Zip ? 16 : compression == Compression::Piz ? 32 : 1;
    }
    size_t rowBytes() const {
        size_t sum = 0;
        for (Channel const& channel : channels) sum += channel.bytes() * width;
        return sum;
    }
};

Error corruptExr(const char* reason) { return fail(ErrorCode::Corrupt, "{}", reason); }
Error unsupported(const char* reason) { return fail(ErrorCode::Unsupported, "{}", reason); }

Result<void> parseChannels(std::span<const std::byte> bytes, ExrHeader& header) {
    constexpr size_t kMaxChannels = 64;
    struct Layout {
        PixelType type;
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
        if (layout->type > PixelType::Float) return corruptExr("a channel has an unknown type");
        if (layout->xSampling != 1 || layout->ySampling != 1) return unsupported("a channel is subsampled");
        if (header.channels.size() == kMaxChannels) return unsupported("it has more than 64 channels");
        header.channels.push_back({ std::string(*name), layout->type });
    }
}

Result<void> parseDataWindow(std::span<const std::byte> bytes, ExrHeader& header) {
    ByteCursor cursor(bytes);
    const auto box = cursor.read<std::array<int32_t, 4>>(); // min x, min y, max x, max y, inclusive
    if (!box) return corruptExr("its data window is cut short");
    const int64_t width = int64_t((*box)[2]) - (*box)[0] + 1, height = int64_t((*box)[3]) - (*box)[1] + 1;
    if (auto error = checkHdrSize(width, height)) return *error;
    header.minX = (*box)[0];
    header.minY = (*box)[1];
    header.width = static_cast<uint32_t>(width);
    header.height = static_cast<uint32_t>(height);
    return {};
}

Result<void> parseAttribute(std::string_view name, std::span<const std::byte> value, ExrHeader& header) {
    if (name == "channels") return parseChannels(value, header);
    if (name == "dataWindow") return parseDataWindow(value, header);
    if (name == "compression") {
        const auto code = value.empty() ? Compression::Count : static_cast<Compression>(value[0]);
        if (code >= Compression::Count) return unsupported("its compression is none of NONE, RLE, ZIPS, ZIP, PIZ");
        header.compression = code;
    }
    return {};
}

// R, G and B, in any position; a lone luminance channel Y serves all three.
Result<void> chooseChannels(ExrHeader& header) {
    constexpr std::array<std::string_view, 3> kNames{ "R", "G", "B" };
    for (size_t i = 0; i < 3; ++i) {
        const auto named = [&](std::string_view name) {
            return std::ranges::find(header.channels, name, &Channel::name);
        };
        auto found = named(kNames[i]);
        if (found == header.channels.end()) found = named("Y");
        if (found == header.channels.end()) return unsupported("it has neither channels R, G, B nor Y");
        if (found->type == PixelType::Uint) return unsupported("its colour channels are integers");
        header.source[i] = static_cast<size_t>(found - header.channels.begin());
    }
    return {};
}

Result<ExrHeader> parseHeader(ByteCursor& cursor) {
    cursor.take(4); // magic
    const auto version = cursor.read<uint32_t>();
    if (!version || (*version & 0xFF) != 2) return unsupported("it is not version 2 of OpenEXR");
    constexpr uint32_t kLongNames = 0x400;
    if ((*version & ~0xFFu & ~kLongNames) != 0) return unsupported("it is tiled, deep or multi-part");
    ExrHeader header;
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
    if (header.compression == Compression::Count) return corruptExr("it does not say how it is compressed");
    if (auto chosen = chooseChannels(header); !chosen) return chosen.error();
    return header;
}

// Signed run lengths: n < 0 copies -n bytes, n >= 0 repeats the next byte n + 1 times.
bool expandRuns(std::span<const std::byte> packed, std::span<std::byte> out) {
    ByteCursor cursor(packed);
    while (!out.empty()) {
        const auto code = cursor.read<int8_t>();
        if (!code) return false;
        const size_t count = *code < 0 ? static_cast<size_t>(-*code) : static_cast<size_t>(*code) + 1;
        if (count > out.size()) return false;
        if (*code < 0) {
            const auto values = cursor.take(count);
            if (!values) return false;
            std::ranges::copy(*values, out.begin());
        } else {
            const auto value = cursor.read<std::byte>();
            if (!value) return false;
            std::ranges::fill(out.first(count), *value);
        }
        out = out.subspan(count);
    }
    return true;
}

bool inflateZlib(std::span<const std::byte> packed, std::span<std::byte> out) {
    uLongf size = out.size();
    return uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                      packed.size()) == Z_OK &&
           size == out.size();
}

// RLE and ZIP store differences between neighbours, even bytes before odd ones.
void undoPredictor(std::span<std::byte> bytes, std::vector<std::byte>& scratch) {
    for (size_t i = 1; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(static_cast<int>(bytes[i - 1]) + static_cast<int>(bytes[i]) - 128);
    }
    scratch.assign(bytes.begin(), bytes.end());
    const size_t half = (bytes.size() + 1) / 2;
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = scratch[(i & 1) ? half + i / 2 : i / 2];
}

bool unpackPiz(ExrHeader const& header, std::span<const std::byte> packed, std::span<std::byte> out) {
    std::vector<size_t> wordsPerSample;
    for (Channel const& channel : header.channels) wordsPerSample.push_back(channel.bytes() / 2);
    return expandPiz(packed, wordsPerSample, header.width, out);
}

// A chunk that compression would not make smaller is stored uncompressed.
bool unpackChunk(ExrHeader const& header, std::span<const std::byte> packed, std::span<std::byte> out,
                 std::vector<std::byte>& scratch) {
    if (packed.size() == out.size()) {
        std::ranges::copy(packed, out.begin());
        return true;
    }
    if (header.compression == Compression::None || packed.size() > out.size()) return false;
    if (header.compression == Compression::Piz) return unpackPiz(header, packed, out);
    const bool expanded = header.compression == Compression::Rle ? expandRuns(packed, out) : inflateZlib(packed, out);
    if (expanded) undoPredictor(out, scratch);
    return expanded;
}

float readSample(const std::byte* at, PixelType type) {
    if (type == PixelType::Half) {
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
        for (size_t i = 0; i < header.source[component]; ++i) offset += header.channels[i].bytes() * header.width;
        Channel const& channel = header.channels[header.source[component]];
        for (uint32_t x = 0; x < header.width; ++x) {
            pixels[x][static_cast<int>(component)] = readSample(row + offset + x * channel.bytes(), channel.type);
        }
    }
}

struct Chunk {
    uint32_t firstRow = 0;
    std::span<const std::byte> packed;
};

// The offset table gives the position of each chunk; each chunk states its first row and its size.
Result<std::vector<Chunk>> findChunks(std::span<const std::byte> file, ByteCursor cursor, ExrHeader const& header) {
    const uint32_t rows = header.rowsPerChunk();
    const uint32_t count = (header.height + rows - 1) / rows;
    if (cursor.remaining() / sizeof(uint64_t) < count) return corruptExr("its offset table is cut short");
    std::vector<Chunk> chunks(count);
    for (Chunk& chunk : chunks) {
        const uint64_t offset = *cursor.read<uint64_t>();
        if (offset >= file.size()) return corruptExr("a block of rows lies outside of the file");
        ByteCursor at(file.subspan(offset));
        const auto row = at.read<int32_t>();
        const auto size = at.read<uint32_t>();
        const auto packed = size ? at.take(*size) : std::nullopt;
        if (!row || !packed) return corruptExr("a block of rows is cut short");
        const int64_t first = int64_t(*row) - header.minY;
        if (first < 0 || first >= header.height || first % rows != 0)
            return corruptExr("a block has rows outside of the image");
        chunk = { static_cast<uint32_t>(first), *packed };
    }
    return chunks;
}

Result<HdrImage> decodeChunks(ExrHeader const& header, std::span<const Chunk> chunks) {
    HdrImage image{ .width = header.width, .height = header.height, .pixels = {}, .repairs = {} };
    image.pixels.resize(size_t(image.width) * image.height);
    const size_t rowBytes = header.rowBytes();
    std::vector<std::byte> unpacked(rowBytes * header.rowsPerChunk()), scratch;
    for (Chunk const& chunk : chunks) {
        const uint32_t rows = std::min(header.rowsPerChunk(), header.height - chunk.firstRow);
        const auto out = std::span(unpacked).first(rowBytes * rows);
        if (!unpackChunk(header, chunk.packed, out, scratch)) {
            return fail(ErrorCode::Corrupt, "the block of row {} cannot be unpacked", chunk.firstRow);
        }
        for (uint32_t y = 0; y < rows; ++y) {
            readRow(header, out.data() + y * rowBytes, { &image.at(0, chunk.firstRow + y), image.width });
        }
    }
    return image;
}

} // namespace

bool isExr(std::span<const std::byte> bytes) {
    constexpr std::array<std::byte, 4> kMagic{ std::byte{ 0x76 }, std::byte{ 0x2F }, std::byte{ 0x31 },
                                               std::byte{ 0x01 } };
    return bytes.size() >= 4 && std::ranges::equal(bytes.first(4), kMagic);
}

Result<HdrImage> decodeExr(std::span<const std::byte> bytes) {
    ByteCursor cursor(bytes);
    const Result<ExrHeader> header = parseHeader(cursor);
    if (!header) return header.error();
    const Result<std::vector<Chunk>> chunks = findChunks(bytes, cursor, *header);
    if (!chunks) return chunks.error();
    return decodeChunks(*header, *chunks);
}

} // namespace filament::assets
