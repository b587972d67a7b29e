// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/NormalVariance.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/MipMaps.h"
#include "filament_core/assets/image/MipTaps.h"
#include "shaders/lib/LibCpp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr size_t kTexelChannels = 4;
constexpr size_t kVarianceChannel = 3;

/// Means of the unit normals of the first level.
struct NormalMeans {
    uint32_t width = 0, height = 0;
    std::vector<double3> means;
};

/// Like normalFromTexel() with the scale 1.
double3 unitOf(double3 texel) {
    const double3 normal = texel * 2.0 - 1.0;
    const double length2 = glm::dot(normal, normal);
    return length2 > 6.103515625e-5 ? normal / std::sqrt(length2) : double3(0, 0, 1);
}

double3 texelOf(std::byte const* codes) {
    return double3(std::to_integer<int>(codes[0]), std::to_integer<int>(codes[1]), std::to_integer<int>(codes[2])) /
           255.0;
}

double3 texelOfHalves(std::byte const* halves) {
    std::array<uint16_t, 3> bits{};
    std::memcpy(bits.data(), halves, sizeof bits);
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]) };
}

/// `row(y)` returns row y of the source; the last three rows returned stay valid.
template <class Row>
NormalMeans halveNormals(uint32_t sourceWidth, uint32_t sourceHeight, Row const& row) {
    NormalMeans level{ std::max(1u, sourceWidth / 2), std::max(1u, sourceHeight / 2), {} };
    level.means.reserve(size_t{ level.width } * level.height);
    for (uint32_t y = 0; y < level.height; ++y) {
        const MipTaps vertical = mipTapsOf(y, sourceHeight);
        std::array<double3 const*, 3> rows{};
        for (uint32_t i = 0; i < vertical.count; ++i) rows[i] = row(vertical.first + i);
        for (uint32_t x = 0; x < level.width; ++x) {
            const MipTaps horizontal = mipTapsOf(x, sourceWidth);
            double3 mean(0.0);
            for (uint32_t i = 0; i < vertical.count; ++i) {
                double3 ofRow(0.0);
                for (uint32_t j = 0; j < horizontal.count; ++j)
                    ofRow += horizontal.weight<double>(j) * rows[i][horizontal.first + j];
                // Means stay as long as they are. The shorter one is, the more the normals below it differ, so the next
                // level needs the length too.
                mean += vertical.weight<double>(i) * ofRow;
            }
            level.means.push_back(mean);
        }
    }
    return level;
}

/// NormalMeans 1 of the image, whose first level is decoded three rows at a time.
NormalMeans meansOfFirst(Image const& image) {
    const bool isDeep = image.format == backend::Format::RGBA16F;
    const size_t bytes = kTexelChannels * (isDeep ? sizeof(uint16_t) : 1);
    std::array<std::vector<double3>, 3> decoded;
    return halveNormals(image.width, image.height, [&](uint32_t y) {
        std::vector<double3>& row = decoded[y % 3];
        row.resize(image.width);
        std::byte const* texel = &image.data[size_t{ y } * image.width * bytes];
        for (uint32_t x = 0; x < image.width; ++x, texel += bytes)
            row[x] = unitOf(isDeep ? texelOfHalves(texel) : texelOf(texel));
        return row.data();
    });
}

NormalMeans halveMeans(NormalMeans const& level) {
    return halveNormals(level.width, level.height, [&](uint32_t y) { return &level.means[size_t{ y } * level.width]; });
}

void writeVariance(Image& image, uint32_t level, NormalMeans const& normals) {
    const bool isDeep = image.format == backend::Format::RGBA16F;
    std::byte* texel = &image.data[image.levelOffset(level)];
    for (double3 const& mean : normals.means) {
        const float alpha = shader::lib::normalWidth(static_cast<float>(glm::length(mean)));
        const uint16_t half = halfFromFloat(alpha);
        if (isDeep)
            std::memcpy(texel + kVarianceChannel * sizeof half, &half, sizeof half);
        else
            texel[kVarianceChannel] = static_cast<std::byte>(std::lround(alpha * 255));
        texel += kTexelChannels * (isDeep ? sizeof half : 1);
    }
}

void clearVariance(Image& image) {
    const size_t channel = image.format == backend::Format::RGBA16F ? sizeof(uint16_t) : 1;
    for (size_t i = kVarianceChannel * channel; i < image.levelBytes(0); i += kTexelChannels * channel)
        std::fill_n(&image.data[i], channel, std::byte{ 0 });
}

} // namespace

Image withNormalVariance(Image image, uint32_t maxSize) {
    FILAMENT_ASSERT((image.format == backend::Format::RGBA8 || image.format == backend::Format::RGBA16F) &&
                            image.layers == 1 && image.levels == backend::fullMipCount(image.width, image.height),
                    "withNormalVariance takes an image of data with all levels");
    // The first level has one normal a texel. Its variance is 0, whatever the alpha channel of the file holds.
    clearVariance(image);
    NormalMeans normals;
    for (uint32_t i = 1; i < image.levels; ++i) {
        normals = i == 1 ? meansOfFirst(image) : halveMeans(normals);
        writeVariance(image, i, normals);
    }
    dropLargeLevels(image, maxSize);
    return image;
}

} // namespace filament_core::assets
