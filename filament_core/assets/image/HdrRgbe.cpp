// SPDX-License-Identifier: Apache-2.0
// Radiance RGBE: three mantissas of 8 bits with one exponent. Ward 1991, "Real Pixels" (Graphics Gems II), and the
// format description in Radiance's ray/doc/filefmts.
#include "filament_core/assets/image/HdrDecoders.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr size_t kMaxHeaderLine = 4096;
constexpr size_t kMaxHeaderLines = 1024;

using Rgbe = std::array<uint8_t, 4>;

struct RgbeHeader {
    uint32_t width = 0, height = 0;
    bool bottomUp = false, rightToLeft = false;
    float scale = 1; // 1 / product of the EXPOSURE lines
};

Error truncated() { return fail(ErrorCode::Corrupt, "it ends in the middle of the pixels"); }

bool parseFloat(std::string_view text, float& value) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

std::string_view nextWord(std::string_view& line) {
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(word.size());
    return word;
}

// "-Y 512 +X 1024": rows from the top, pixels from the left. The format allows column-major orders, but no
// program writes them.
Result<RgbeHeader> parseResolution(std::string_view line, RgbeHeader header) {
    const std::string_view rows = nextWord(line), height = nextWord(line);
    const std::string_view columns = nextWord(line), width = nextWord(line);
    int64_t w = 0, h = 0;
    std::from_chars(width.data(), width.data() + width.size(), w);
    std::from_chars(height.data(), height.data() + height.size(), h);
    if ((rows != "-Y" && rows != "+Y") || (columns != "+X" && columns != "-X")) {
        return fail(ErrorCode::Unsupported, "its size line is not of the form '-Y height +X width'");
    }
    if (auto error = checkHdrSize(w, h)) return *error;
    header.width = static_cast<uint32_t>(w);
    header.height = static_cast<uint32_t>(h);
    header.bottomUp = rows == "+Y";
    header.rightToLeft = columns == "-X";
    return header;
}

Result<RgbeHeader> parseRgbeHeader(ByteCursor& cursor) {
    RgbeHeader header;
    for (size_t i = 0; i < kMaxHeaderLines; ++i) {
        const auto line = cursor.readUntil('\n', kMaxHeaderLine);
        if (!line) break;
        if (line->empty()) {
            const auto resolution = cursor.readUntil('\n', kMaxHeaderLine);
            if (!resolution) break;
            return parseResolution(*resolution, header);
        }
        if (line->starts_with("FORMAT=") && *line != "FORMAT=32-bit_rle_rgbe") {
            return fail(ErrorCode::Unsupported, "its pixels are '{}', not 32-bit_rle_rgbe", line->substr(7));
        }
        float exposure = 0;
        if (line->starts_with("EXPOSURE=") && parseFloat(line->substr(9), exposure) && exposure > 0) {
            header.scale /= exposure;
        }
    }
    return fail(ErrorCode::Corrupt, "its header has no end");
}

// One component of a scan line in the run-length encoding of 1991: a count above 128 repeats, a smaller one copies.
bool readComponent(ByteCursor& cursor, std::vector<Rgbe>& row, size_t component) {
    for (size_t x = 0; x < row.size();) {
        const auto code = cursor.read<uint8_t>();
        if (!code || *code == 0) return false;
        const size_t count = *code > 128 ? *code - 128u : *code;
        if (count > row.size() - x) return false;
        if (*code > 128) {
            const auto value = cursor.read<uint8_t>();
            if (!value) return false;
            for (size_t i = 0; i < count; ++i) row[x++][component] = *value;
        } else {
            const auto values = cursor.take(count);
            if (!values) return false;
            for (const std::byte value : *values) row[x++][component] = static_cast<uint8_t>(value);
        }
    }
    return true;
}

// Flat pixels; (1, 1, 1, n) repeats the previous pixel, and consecutive repeats shift n by 8 bits each.
bool readFlatRow(ByteCursor& cursor, std::vector<Rgbe>& row) {
    uint32_t shift = 0;
    for (size_t x = 0; x < row.size();) {
        const auto pixel = cursor.read<Rgbe>();
        if (!pixel) return false;
        const bool repeats = (*pixel)[0] == 1 && (*pixel)[1] == 1 && (*pixel)[2] == 1;
        if (!repeats) {
            row[x++] = *pixel;
            shift = 0;
            continue;
        }
        const size_t count = static_cast<size_t>((*pixel)[3]) << shift;
        if (x == 0 || shift > 16 || count > row.size() - x) return false;
        for (size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
        shift += 8;
    }
    return true;
}

bool readRow(ByteCursor& cursor, std::vector<Rgbe>& row) {
    const auto rest = cursor.rest();
    const bool newForm = row.size() >= 8 && row.size() < 32768 && rest.size() >= 4 && rest[0] == std::byte{ 2 } &&
                         rest[1] == std::byte{ 2 } && (rest[2] & std::byte{ 0x80 }) == std::byte{ 0 };
    if (!newForm) return readFlatRow(cursor, row);
    const size_t length = static_cast<size_t>(rest[2]) << 8 | static_cast<size_t>(rest[3]);
    cursor.take(4);
    if (length != row.size()) return false;
    for (size_t component = 0; component < 4; ++component) {
        if (!readComponent(cursor, row, component)) return false;
    }
    return true;
}

// Exponents are biased by 128 and mantissas are 8-bit fractions; exponent 0 is black.
float3 radianceOf(Rgbe const& pixel, float scale) {
    if (pixel[3] == 0) return float3(0.0f);
    const float factor = std::ldexp(scale, static_cast<int>(pixel[3]) - (128 + 8));
    return float3(pixel[0], pixel[1], pixel[2]) * factor;
}

void flipRows(HdrImage& image) {
    for (uint32_t y = 0; y < image.height / 2; ++y) {
        float3* const upper = &image.at(0, y);
        std::swap_ranges(upper, upper + image.width, &image.at(0, image.height - 1 - y));
    }
}

} // namespace

bool isRgbe(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{ '#' } && bytes[1] == std::byte{ '?' };
}

Result<HdrImage> decodeRgbe(std::span<const std::byte> bytes) {
    ByteCursor cursor(bytes);
    const Result<RgbeHeader> header = parseRgbeHeader(cursor);
    if (!header) return header.error();
    HdrImage image{ .width = header->width, .height = header->height, .pixels = {}, .repairs = {} };
    std::vector<Rgbe> row(image.width);
    for (uint32_t y = 0; y < image.height; ++y) { // memory grows only with the rows that exist
        if (!readRow(cursor, row)) {
            if (cursor.remaining() == 0) return truncated();
            return fail(ErrorCode::Corrupt, "the run lengths of row {} do not fit its width", y);
        }
        if (header->rightToLeft) std::reverse(row.begin(), row.end());
        for (Rgbe const& pixel : row) image.pixels.push_back(radianceOf(pixel, header->scale));
    }
    if (header->bottomUp) flipRows(image);
    return image;
}

} // namespace filament_core::assets
