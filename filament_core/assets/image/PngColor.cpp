// SPDX-License-Identifier: Apache-2.0
// W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", section 11.3.2: colour space information.
#include "filament_core/assets/image/PngColor.h"

#include "filament_core/assets/image/PngChunks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core::assets {
namespace {

using PngBytes = std::vector<std::byte>;

constexpr size_t kSignature = 8, kFrame = 12; // a chunk's length, name and checksum

uint32_t pngWordAt(std::span<const std::byte> bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint32_t>(bytes[at + i]);
    return value;
}

/// Code points of ITU-T H.273: primaries, transfer function, no matrix, full range.
void appendCicp(PngBytes& bytes, uint8_t primaries, uint8_t transfer) {
    const std::array data{ std::byte{ primaries }, std::byte{ transfer }, std::byte{ 0 }, std::byte{ 1 } };
    appendPngChunk(bytes, "cICP", data);
}

/// The encoding exponent times 100 000.
void appendGamma(PngBytes& bytes, uint32_t gamma) {
    PngBytes data;
    appendPngWord(data, gamma);
    appendPngChunk(bytes, "gAMA", data);
}

/// x and y of D65 and of the primaries, times 100 000.
void appendChromaticities(PngBytes& bytes, std::array<uint32_t, 6> const& primaries) {
    PngBytes data;
    for (const uint32_t value : { 31270u, 32900u }) appendPngWord(data, value);
    for (const uint32_t value : primaries) appendPngWord(data, value);
    appendPngChunk(bytes, "cHRM", data);
}

/// cICP first; the others are for decoders that do not know it. PQ has no gamma.
void appendColor(PngBytes& bytes, OutputSpace space) {
    constexpr uint8_t kPrimaries709 = 1, kRec2020 = 9, kP3 = 12, kLinear = 8, kSrgb = 13, kPq = 16;
    switch (space) {
    case OutputSpace::Srgb:
        return;
    case OutputSpace::LinearRec709:
        appendCicp(bytes, kPrimaries709, kLinear);
        appendGamma(bytes, 100'000);
        return appendChromaticities(bytes, { 64000, 33000, 30000, 60000, 15000, 6000 });
    case OutputSpace::DisplayP3:
        appendCicp(bytes, kP3, kSrgb);
        appendGamma(bytes, 45'455);
        return appendChromaticities(bytes, { 68000, 32000, 26500, 69000, 15000, 6000 });
    case OutputSpace::Rec2020Pq:
        appendCicp(bytes, kRec2020, kPq);
        return appendChromaticities(bytes, { 70800, 29200, 17000, 79700, 13100, 4600 });
    }
}

} // namespace

std::vector<std::byte> withColorSpace(std::vector<std::byte> png, OutputSpace space) {
    if (space == OutputSpace::Srgb) return png;
    constexpr std::array<std::string_view, 5> kReplaced{ "sRGB", "gAMA", "cHRM", "iCCP", "cICP" };
    PngBytes result(png.begin(), png.begin() + kSignature);
    for (size_t at = kSignature; at + kFrame <= png.size();) {
        const size_t size = pngWordAt(png, at) + kFrame;
        const std::string_view name(reinterpret_cast<const char*>(png.data() + at + 4), 4);
        if (std::ranges::find(kReplaced, name) == kReplaced.end()) {
            const auto first = png.begin() + static_cast<std::ptrdiff_t>(at);
            result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(size));
        }
        if (name == "IHDR") appendColor(result, space);
        at += size;
    }
    return result;
}

} // namespace filament_core::assets
