// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/Picture.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "toolkit/pictures/Flip.h"
#include "toolkit/pictures/Pixels.h"

#include <filament_core/Color.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::tools {
namespace {

constexpr double kFloorOfMean = 0.01;

bool isBackground(float3 const& pixel) { return pixel == float3(0.0f); }

double lengthOf(float3 const& v) { return glm::length(double3(v)); }

/// Whether the pixel or one of its eight neighbours is background.
bool touchesBackground(Picture const& picture, uint32_t x, uint32_t y) {
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, picture.height - 1); ++j) {
        for (uint32_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, picture.width - 1); ++i)
            if (isBackground(picture.pixels[size_t(j) * picture.width + i])) return true;
    }
    return false;
}

Image halfImage(Picture const& picture) {
    Image image{ .width = picture.width, .height = picture.height, .format = Format::RGBA16F };
    image.pixels.resize(picture.pixels.size() * 8);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        float3 const& p = picture.pixels[i];
        const uint16_t halves[4] = { halfFromFloat(p.x), halfFromFloat(p.y), halfFromFloat(p.z), halfFromFloat(1) };
        std::memcpy(image.pixels.data() + i * 8, halves, 8);
    }
    return image;
}

double meanLength(Picture const& picture) {
    double sum = 0;
    size_t count = 0;
    for (float3 const& pixel : picture.pixels) {
        sum += lengthOf(pixel);
        count += !isBackground(pixel);
    }
    return count ? sum / static_cast<double>(count) : 0;
}

} // namespace

Picture pictureOf(Image const& image) {
    Picture picture{ image.width, image.height, {} };
    picture.pixels.reserve(pixelCount(image));
    for (size_t i = 0; i < pixelCount(image); ++i) {
        const std::array<float, 4> value = pixelAt(image, i);
        const float3 rgb(value[0], value[1], value[2]);
        picture.pixels.push_back(image.format == Format::RGBA16F ? rgb : color::linearFromSrgb(rgb));
    }
    return picture;
}

Image displayImage(Picture const& picture) {
    Image image{ .width = picture.width, .height = picture.height, .format = Format::RGBA8 };
    image.pixels.reserve(picture.pixels.size() * 4);
    for (float3 const& pixel : picture.pixels) {
        const float3 codes = color::srgbFromLinear(glm::clamp(pixel, float3(0.0f), float3(1.0f)));
        for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<std::byte>(std::lround(codes[c] * 255)));
        image.pixels.push_back(std::byte{ 255 });
    }
    return image;
}

Picture boxFiltered(Picture const& picture, uint32_t factor) {
    FILAMENT_ASSERT(factor > 0 && picture.width % factor == 0 && picture.height % factor == 0,
                    "a picture is filtered by a divisor of its sides");
    Picture small{ picture.width / factor, picture.height / factor, {} };
    small.pixels.reserve(size_t(small.width) * small.height);
    for (uint32_t y = 0; y < small.height; ++y) {
        for (uint32_t x = 0; x < small.width; ++x) {
            double3 sum(0.0);
            for (uint32_t j = 0; j < factor; ++j) {
                const size_t row = (size_t(y) * factor + j) * picture.width + size_t(x) * factor;
                for (uint32_t i = 0; i < factor; ++i) sum += double3(picture.pixels[row + i]);
            }
            small.pixels.emplace_back(sum / (double(factor) * factor));
        }
    }
    return small;
}

ErrorFigures compare(Picture const& reference, Picture const& test, Edges edges) {
    FILAMENT_ASSERT(reference.width == test.width && reference.height == test.height, "pictures of one size compare");
    const double floor = std::max(kFloorOfMean * meanLength(reference), 1e-30);
    ErrorFigures figures;
    double sum = 0;
    size_t count = 0;
    for (uint32_t y = 0; y < reference.height; ++y) {
        for (uint32_t x = 0; x < reference.width; ++x) {
            const size_t i = size_t(y) * reference.width + x;
            if (isBackground(reference.pixels[i]) && isBackground(test.pixels[i])) continue;
            if (edges == Edges::Skip && (touchesBackground(reference, x, y) || touchesBackground(test, x, y))) continue;
            const double3 truth(reference.pixels[i]), found(test.pixels[i]);
            const double error =
                    glm::length(found - truth) / (std::max(glm::length(truth), glm::length(found)) + floor);
            sum += error * error;
            figures.max = std::max(figures.max, error);
            ++count;
        }
    }
    figures.rms = count ? std::sqrt(sum / static_cast<double>(count)) : 0;
    figures.flip = tools::flip(halfImage(reference), halfImage(test)).mean;
    return figures;
}

} // namespace filament_core::tools
