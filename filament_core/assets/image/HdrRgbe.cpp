// SPDX-License-Identifier: Apache-2.0
// Radiance RGBE: three mantissas of 8 bits with one exponent. Ward 1991, "Real Pixels" (Graphics Gems II), and the
// format description in Radiance's ray/doc/filefmts. Header lines are those of its programs, and the spellings of
// others.
#include "base/AsciiText.h"
#include "filament_core/assets/image/HdrDecoders.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace filament_core::assets {
namespace {

constexpr size_t kMaxHeaderLine = 65536; // programs write the commands that made the picture
constexpr std::string_view kBlanks = " \t\r\f\v";
constexpr size_t kMaxHeaderLines = 1024;

using Rgbe = std::array<uint8_t, 4>;

struct RgbeHeader {
    uint32_t width = 0, height = 0;
    bool bottomUp = false, rightToLeft = false;
    float scale = 1;             // 1 / product of the EXPOSURE lines
    float3 colorCorrection{ 1 }; // product of the COLORCORR lines
    std::optional<Chromaticities> primaries{};
    std::vector<std::string> warnings{}, panoramaWarnings{};
};

Error truncated() { return fail(ErrorCode::Corrupt, "it ends in the middle of the pixels"); }

std::string_view nextWord(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    line.remove_prefix(word.size());
    return word;
}

/// The numbers that a line starts with, as many as there are.
std::vector<float> numbersOf(std::string_view text, size_t most) {
    std::vector<float> numbers;
    while (numbers.size() < most) {
        const std::string_view word = nextWord(text);
        float value = 0;
        if (word.empty() || std::from_chars(word.data(), word.data() + word.size(), value).ec != std::errc()) break;
        numbers.push_back(value);
    }
    return numbers;
}

std::string shownText(std::string_view text) {
    std::string shown(text.substr(0, 80));
    for (char& c : shown) c = c >= ' ' && c < 127 ? c : '?';
    return shown;
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

void parseColorCorrection(std::string_view value, RgbeHeader& header) {
    const std::vector<float> factors = numbersOf(value, 3);
    const bool isUsable = factors.size() == 3 && std::ranges::all_of(factors, [](float factor) {
                              return factor > 0 && factor <= std::numeric_limits<float>::max();
                          });
    if (isUsable)
        header.colorCorrection *= float3(factors[0], factors[1], factors[2]);
    else
        header.warnings.push_back(
                fmt::format("its COLORCORR= {} is not three numbers above zero and is left out", shownText(value)));
}

void parsePrimaries(std::string_view value, RgbeHeader& header) {
    const std::vector<float> xy = numbersOf(value, 8);
    if (xy.size() == 8)
        header.primaries = { { xy[0], xy[1] }, { xy[2], xy[3] }, { xy[4], xy[5] }, { xy[6], xy[7] } };
    else
        header.warnings.push_back(
                fmt::format("its PRIMARIES= {} is not eight numbers and is left out", shownText(value)));
}

/// What rpict and its like write: of these no picture is a panorama of 360 by 180 degrees.
void parseView(std::string_view value, RgbeHeader& header) {
    header.panoramaWarnings.push_back(
            fmt::format("its header has the camera of a picture (VIEW= {}), but lights as a panorama of 360 by 180 "
                        "degrees; render or export one",
                        shownText(value)));
}

Result<void> parseRgbeLine(std::string_view line, RgbeHeader& header) {
    const size_t equals = std::min(line.find('='), line.size());
    const std::string_view key = line.substr(0, line.substr(0, equals).find_last_not_of(kBlanks) + 1);
    const std::string_view value = withoutBlanks(line.substr(std::min(equals + 1, line.size())), kBlanks);
    const std::vector<float> numbers = numbersOf(value, 1);
    const float number = numbers.empty() ? 0 : numbers[0];
    if (key == "FORMAT" && value != "32-bit_rle_rgbe")
        return fail(ErrorCode::Unsupported, "its pixels are '{}', not 32-bit_rle_rgbe", shownText(value));
    if (key == "EXPOSURE" && number > 0) header.scale /= number;
    if (key == "COLORCORR") parseColorCorrection(value, header);
    if (key == "PRIMARIES") parsePrimaries(value, header);
    if (key == "VIEW") parseView(value, header);
    if (key == "PIXASPECT" && number != 1)
        header.panoramaWarnings.push_back(fmt::format(
                "its PIXASPECT= {} is left out: a panorama covers 360 by 180 degrees in any size", shownText(value)));
    if (key == "GAMMA" && number != 1 && number > 0)
        header.warnings.push_back(fmt::format("its GAMMA= {} is left out: light is linear; export it with a gamma of 1",
                                              shownText(value)));
    return {};
}

/// Lines that begin with a blank describe the pictures of which Radiance's programs made this one.
Result<RgbeHeader> parseRgbeHeader(ByteCursor& cursor) {
    RgbeHeader header;
    for (size_t i = 0; i < kMaxHeaderLines; ++i) {
        const auto line = cursor.readUntil('\n', kMaxHeaderLine);
        if (!line) break;
        if (line->starts_with("-Y ") || line->starts_with("+Y ")) return parseResolution(*line, header);
        if (withoutBlanks(*line, kBlanks).empty()) {
            const auto resolution = cursor.readUntil('\n', kMaxHeaderLine);
            if (!resolution) break;
            return parseResolution(*resolution, header);
        }
        if (const Result<void> parsed = parseRgbeLine(*line, header); !parsed) return parsed.error();
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
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?") || text.starts_with("FORMAT=32-bit_rle_"); // some files have no first line
}

Result<DecodedHdr> decodeRgbe(std::span<const std::byte> bytes, HdrPart part) {
    ByteCursor cursor(bytes);
    Result<RgbeHeader> header = parseRgbeHeader(cursor);
    if (!header) return header.error();
    DecodedHdr decoded{ { .width = header->width, .height = header->height, .pixels = {}, .repairs = {} },
                        header->primaries };
    HdrImage& image = decoded.image;
    image.warnings = std::move(header->warnings);
    image.panoramaWarnings = std::move(header->panoramaWarnings);
    if (part == HdrPart::Header) return decoded;
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
    if (header->colorCorrection != float3(1)) {
        for (float3& pixel : image.pixels) pixel /= header->colorCorrection;
    }
    return decoded;
}

} // namespace filament_core::assets
