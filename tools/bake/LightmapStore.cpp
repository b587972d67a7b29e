// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/LightmapStore.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "filament_core/assets/image/TexturePacking.h"
#include "tools/bake/Bc6Encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::bake {
namespace {

using backend::Format;

/// One level of a page, decoded halves.
struct PageLevel {
    std::span<const std::byte> halves;
    uint32_t width = 0, height = 0;
};

std::vector<std::byte> sharedExponents(PageLevel const& level) {
    std::vector<std::byte> texels(level.halves.size() / 2);
    for (size_t i = 0; i < texels.size(); i += 4) {
        std::array<uint16_t, 4> codes;
        std::memcpy(codes.data(), &level.halves[2 * i], sizeof(codes));
        const uint32_t packed =
                packRgb9E5({ floatFromHalf(codes[0]), floatFromHalf(codes[1]), floatFromHalf(codes[2]) });
        std::memcpy(&texels[i], &packed, sizeof(packed));
    }
    return texels;
}

std::vector<std::byte> opennessCodes(PageLevel const& level) {
    std::vector<std::byte> codes(level.halves.size() / 8);
    for (size_t i = 0; i < codes.size(); ++i) {
        uint16_t half;
        std::memcpy(&half, &level.halves[8 * i + 6], sizeof(half));
        codes[i] = static_cast<std::byte>(std::lround(std::clamp(floatFromHalf(half), 0.0f, 1.0f) * 255));
    }
    return codes;
}

/// Another format of the same page, level by level.
template <class Encode>
std::vector<std::byte> encodedPage(assets::Image const& halves, Format format, Encode const& encode) {
    assets::Image image{ halves.width, halves.height, 1, halves.levels, format, {} };
    for (uint32_t level = 0; level < halves.levels; ++level) {
        const PageLevel from{ std::span(halves.data).subspan(halves.levelOffset(level), halves.levelBytes(level)),
                              std::max(1u, halves.width >> level), std::max(1u, halves.height >> level) };
        const std::vector<std::byte> texels = encode(from);
        image.data.insert(image.data.end(), texels.begin(), texels.end());
    }
    return assets::encodeKtx2(image);
}

struct StoredPage {
    std::vector<std::byte> light, openness;
    assets::Image read; // with all levels
};

assets::Image readBack(std::span<const std::byte> file) {
    Result<assets::Ktx2Texture> texture = assets::decodeKtx2(file, "lightmap");
    FILAMENT_ASSERT(texture, "what the encoder writes can be read");
    return std::move(texture->image);
}

void dropAlpha(assets::Image& halves) {
    const uint16_t one = halfFromFloat(1);
    for (size_t i = 0; i < halves.data.size(); i += 8) std::memcpy(&halves.data[i + 6], &one, sizeof(one));
}

StoredPage storePage(assets::Image halves, StorageChoice const& choice) {
    StoredPage page;
    const bool isBlocks = choice.format == LightmapFormat::Bc6h;
    if (choice.format == LightmapFormat::Half) {
        if (!choice.hasOpenness) dropAlpha(halves);
        page.light = assets::encodeKtx2(halves);
        page.read = std::move(halves);
        return page;
    }
    page.light = isBlocks ? encodedPage(halves, Format::BC6HUfloat,
                                        [](PageLevel const& level) {
                                            return encodeBc6(level.halves, level.width, level.height);
                                        })
                          : encodedPage(halves, Format::RGB9E5, sharedExponents);
    page.read = readBack(page.light);
    if (!choice.hasOpenness) return page;
    page.openness = isBlocks ? encodedPage(halves, Format::BC4,
                                           [](PageLevel const& level) {
                                               return encodeBc4(opennessCodes(level), level.width, level.height);
                                           })
                             : encodedPage(halves, Format::R8, opennessCodes);
    page.read = assets::withAlphaOf(std::move(page.read), readBack(page.openness));
    return page;
}

double4 texelOf(assets::Image const& halves, size_t index) {
    std::array<uint16_t, 4> codes;
    std::memcpy(codes.data(), &halves.data[index * 8], sizeof(codes));
    double4 value;
    for (size_t c = 0; c < 4; ++c) value[static_cast<int>(c)] = double(floatFromHalf(codes[c]));
    return value;
}

StorageError errorOf(LightmapImage const& image, assets::Image const& read, std::span<const AtlasTexel> texels,
                     std::span<const TexelLight> lights, bool hasOpenness) {
    StorageError error;
    double squares = 0, relative = 0, openness = 0;
    uint64_t seen = 0, lit = 0;
    for (size_t i = 0; i < texels.size(); ++i) {
        if (lights[i].backs > kMostBacks) continue;
        const size_t index = size_t(texels[i].y) * image.side + texels[i].x;
        const double4 exact = image.texels[index], stored = texelOf(read, index);
        const double lux = luminanceOf(double3(exact));
        const double off = std::abs(luminanceOf(double3(stored) * image.intensity) - lux);
        squares += off * off, ++seen;
        error.worstLux = std::max(error.worstLux, off);
        if (lux > 0) relative += off * off / (lux * lux), ++lit;
        openness += (stored.w - exact.w) * (stored.w - exact.w);
    }
    if (seen > 0) error.rmsLux = std::sqrt(squares / double(seen));
    if (lit > 0) error.meanRelative = std::sqrt(relative / double(lit));
    if (seen > 0 && hasOpenness) error.opennessRms = std::sqrt(openness / double(seen));
    return error;
}

} // namespace

StoredLightmap storeLightmap(LightmapImage const& image, std::span<const AtlasTexel> texels,
                             std::span<const TexelLight> lights, StorageChoice const& choice, jobs::JobSystem& jobs) {
    const assets::Image halves = halvesOf(image);
    std::vector<StoredPage> pages(image.pages);
    jobs::parallelFor<"store">(jobs, pages.size(), 1, [&](size_t begin, size_t end) {
        for (size_t page = begin; page < end; ++page)
            pages[page] = storePage(onePage(halves, static_cast<uint32_t>(page)), choice);
    });
    StoredLightmap stored{ .read = { image.side, image.side * image.pages, 1, 1, Format::RGBA16F, {} } };
    for (StoredPage& page : pages) {
        const auto first = std::span(page.read.data).first(page.read.levelBytes(0));
        stored.read.data.insert(stored.read.data.end(), first.begin(), first.end());
        stored.bytes += page.light.size() + page.openness.size();
        stored.pages.push_back(std::move(page.light));
        if (!page.openness.empty()) stored.openness.push_back(std::move(page.openness));
    }
    stored.error = errorOf(image, stored.read, texels, lights, choice.hasOpenness);
    return stored;
}

} // namespace filament_core::bake
