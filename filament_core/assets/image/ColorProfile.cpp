// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ColorProfile.h"

#include "base/math/ColorSpaces.h"
#include "filament_core/assets/image/ImageDecoder.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

namespace filament_core::assets {
namespace {

using Bytes = std::span<const std::byte>;

constexpr size_t kMaxProfile = size_t{ 4 } << 20;

uint32_t bigEndian(Bytes bytes, size_t at, size_t count) {
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    return value;
}

std::string_view textAt(Bytes bytes, size_t at, size_t count) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).substr(at, count);
}

/// The chunks of a PNG that say something of its colours.
struct PngColors {
    bool isSrgb = false;
    std::optional<double> gamma;
    std::optional<Chromaticities> chromaticities;
    std::optional<std::array<uint32_t, 2>> cicp;
    std::vector<std::byte> profile;
};

/// Name, a zero byte, a method, and a zlib stream.
std::vector<std::byte> unpackedProfile(Bytes chunk) {
    const size_t name = textAt(chunk, 0, 80).find('\0');
    if (name == std::string_view::npos || name + 2 > chunk.size()) return {};
    const Bytes packed = chunk.subspan(name + 2);
    std::vector<std::byte> profile(std::min(kMaxProfile, packed.size() * 1032 + 64)); // deflate's largest ratio
    auto length = static_cast<uLongf>(profile.size());
    const int status = uncompress(reinterpret_cast<Bytef*>(profile.data()), &length,
                                  reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    profile.resize(status == Z_OK ? length : 0);
    return profile;
}

void readPngChunk(std::string_view name, Bytes data, PngColors& colors) {
    if (name == "sRGB") colors.isSrgb = true;
    if (name == "gAMA" && data.size() == 4) colors.gamma = bigEndian(data, 0, 4) / 1e5;
    if (name == "cICP" && data.size() == 4) colors.cicp = { bigEndian(data, 0, 1), bigEndian(data, 1, 1) };
    if (name == "iCCP") colors.profile = unpackedProfile(data);
    if (name != "cHRM" || data.size() != 32) return;
    const auto at = [&](size_t i) { return double2(bigEndian(data, 8 * i, 4), bigEndian(data, 8 * i + 4, 4)) / 1e5; };
    colors.chromaticities = { .red = at(1), .green = at(2), .blue = at(3), .white = at(0) };
}

/// Codes of H.273 whose colours are taken as those of sRGB: AVIF files have them, too.
std::optional<std::string> foreignCicp(uint32_t primaries, uint32_t transfer) {
    if ((primaries == 1 || primaries == 2) && (transfer == 13 || transfer == 1 || transfer == 2)) return std::nullopt;
    return fmt::format("CICP primaries {} and transfer characteristics {}", primaries, transfer);
}

std::optional<std::string> foreignPng(Bytes file) {
    PngColors colors;
    for (size_t at = 8; at + 12 <= file.size();) {
        const size_t size = bigEndian(file, at, 4);
        const std::string_view name = textAt(file, at + 4, 4);
        if (name == "IDAT" || size > file.size() - at - 12) break;
        readPngChunk(name, file.subspan(at + 8, size), colors);
        at += size + 12;
    }
    if (colors.cicp) return foreignCicp((*colors.cicp)[0], (*colors.cicp)[1]);
    if (!colors.profile.empty()) return foreignIccProfile(colors.profile);
    if (colors.isSrgb) return std::nullopt;
    if (colors.chromaticities && !isRec709(*colors.chromaticities, 0.01)) {
        auto const& [red, green, blue, white] = *colors.chromaticities;
        return fmt::format("the primaries {} {}, {} {}, {} {} and the white {} {} of cHRM", red.x, red.y, green.x,
                           green.y, blue.x, blue.y, white.x, white.y);
    }
    if (colors.gamma && std::abs(*colors.gamma * 2.2 - 1) > 0.02)
        return fmt::format("the gamma {} of gAMA", *colors.gamma);
    return std::nullopt;
}

/// Segments APP2 with a part of the profile each, numbered from 1.
std::optional<std::string> foreignJpeg(Bytes file) {
    constexpr std::string_view kIcc("ICC_PROFILE\0", 12);
    std::map<uint32_t, Bytes> parts;
    for (size_t at = 2; at + 4 <= file.size() && file[at] == std::byte{ 0xFF };) {
        const uint32_t marker = bigEndian(file, at + 1, 1);
        if (marker == 0xFF) { // filling
            ++at;
            continue;
        }
        const size_t size = bigEndian(file, at + 2, 2);
        if (marker == 0xDA || size < 2 || size > file.size() - at - 2) break;
        if (marker == 0xE2 && size >= 16 && textAt(file, at + 4, 12) == kIcc)
            parts.try_emplace(bigEndian(file, at + 16, 1), file.subspan(at + 18, size - 16));
        at += 2 + size;
    }
    std::vector<std::byte> profile;
    for (auto const& [number, part] : parts) {
        if (profile.size() + part.size() > kMaxProfile) return std::nullopt;
        profile.insert(profile.end(), part.begin(), part.end());
    }
    return foreignIccProfile(profile);
}

std::optional<std::string> foreignWebp(Bytes file) {
    for (size_t at = 12; at + 8 <= file.size();) {
        size_t size = 0; // lowest byte first
        for (size_t i = 4; i > 0; --i) size = size << 8 | std::to_integer<size_t>(file[at + 3 + i]);
        const std::string_view name = textAt(file, at, 4);
        if (size > file.size() - at - 8 || name.starts_with("VP8 ") || name == "VP8L") break;
        if (name == "ICCP") return foreignIccProfile(file.subspan(at + 8, size));
        at += 8 + size + size % 2;
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> foreignColorSpace(std::span<const std::byte> file) {
    if (isAvif(file)) return foreignIccProfile(avifProfile(file));
    if (isWebp(file)) return foreignWebp(file);
    if (!isPngOrJpeg(file)) return std::nullopt;
    return file[0] == std::byte{ 0xFF } ? foreignJpeg(file) : foreignPng(file);
}

} // namespace filament_core::assets
