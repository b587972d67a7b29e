// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/comparison/Difference.h"

#include "base/Assert.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"

#include <algorithm>
#include <cmath>

namespace filament_core::accuracy {
namespace {

constexpr double kDifferenceFloorOfMean = 0.01;
constexpr int kMapSteps = 24; // colours on each side of white: few, so that maps compress well

bool isBlack(float3 const& pixel) { return pixel == float3(0.0f); }

bool touchesBlack(Picture const& picture, uint32_t x, uint32_t y) {
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, picture.height - 1); ++j) {
        for (uint32_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, picture.width - 1); ++i)
            if (isBlack(picture.pixels[size_t(j) * picture.width + i])) return true;
    }
    return false;
}

double luminanceOf(double3 color) { return glm::dot(color, double3(0.2126, 0.7152, 0.0722)); }

double3 difference(Picture const& a, Picture const& b, size_t pixel, DifferenceScale const& scale) {
    return (double3(a.pixels[pixel]) - double3(b.pixels[pixel])) * scale.factor(pixel);
}

/// Mean over the pixels that count.
template <class F>
double meanOver(DifferenceScale const& scale, F const& f) {
    double sum = 0;
    for (size_t i = 0; i < scale.size(); ++i) {
        if (scale.counts(i)) sum += f(i);
    }
    return scale.pixels() > 0 ? sum / static_cast<double>(scale.pixels()) : 0;
}

void push(Image& image, double3 color) {
    for (int c = 0; c < 3; ++c)
        image.pixels.push_back(static_cast<std::byte>(std::lround(std::clamp(color[c], 0.0, 1.0) * 255)));
    image.pixels.push_back(std::byte{ 255 });
}

} // namespace

DifferenceScale::DifferenceScale(Picture const& truth, Picture const& engine) : mFactors(truth.pixels.size()) {
    FILAMENT_ASSERT(truth.width == engine.width && truth.height == engine.height, "pictures of one size compare");
    double mean = 0;
    size_t lit = 0;
    for (float3 const& pixel : truth.pixels) {
        mean += glm::length(double3(pixel));
        lit += !isBlack(pixel);
    }
    const double floor = std::max(kDifferenceFloorOfMean * mean / std::max<double>(static_cast<double>(lit), 1), 1e-30);
    for (uint32_t y = 0; y < truth.height; ++y) {
        for (uint32_t x = 0; x < truth.width; ++x) {
            if (touchesBlack(truth, x, y) || touchesBlack(engine, x, y)) continue;
            const size_t i = size_t(y) * truth.width + x;
            const double size = 0.5 * (glm::length(double3(truth.pixels[i])) + glm::length(double3(engine.pixels[i])));
            mFactors[i] = 1 / (size + floor);
            ++mCount;
        }
    }
}

double rms(Picture const& a, Picture const& b, DifferenceScale const& scale) {
    return std::sqrt(product(a, b, a, b, scale));
}

double bias(Picture const& a, Picture const& b, DifferenceScale const& scale) {
    return meanOver(scale, [&](size_t i) { return luminanceOf(difference(a, b, i, scale)); });
}

double product(Picture const& a, Picture const& b, Picture const& c, Picture const& d, DifferenceScale const& scale) {
    return meanOver(scale, [&](size_t i) { return glm::dot(difference(a, b, i, scale), difference(c, d, i, scale)); });
}

double noise(std::vector<float3> const& standardError, DifferenceScale const& scale) {
    FILAMENT_ASSERT(standardError.size() == scale.size(), "an error for every pixel");
    return std::sqrt(meanOver(scale, [&](size_t i) {
        const double3 error = double3(standardError[i]) * scale.factor(i);
        return glm::dot(error, error);
    }));
}

Image differenceMap(Picture const& a, Picture const& b, DifferenceScale const& scale, double full) {
    Image image{ .width = a.width, .height = a.height, .format = Format::RGBA8 };
    image.pixels.reserve(a.pixels.size() * 4);
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        if (!scale.counts(i)) {
            push(image, double3(0.85)); // grey: not compared
            continue;
        }
        const double value = std::clamp(luminanceOf(difference(a, b, i, scale)) / full, -1.0, 1.0);
        const double strength = std::round(std::abs(value) * kMapSteps) / kMapSteps;
        push(image,
             glm::mix(double3(1.0), value > 0 ? double3(0.70, 0.05, 0.12) : double3(0.05, 0.25, 0.65), strength));
    }
    return image;
}

double displayError(Picture const& shown, Picture const& linear, ToneMapper toneMapper) {
    namespace lib = shader::lib;
    const assets::DisplayColor displayColor({ .toneMapper = toneMapper });
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < shown.pixels.size(); ++i) {
        if (isBlack(linear.pixels[i])) continue; // rounding does not affect the background
        const float3 exact = displayColor(linear.pixels[i]);
        const double3 error = double3(lib::srgbFromLinear(shown.pixels[i])) - double3(lib::saturate(exact));
        sum += glm::dot(error, error) / 3;
        ++count;
    }
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

Image tonemapped(Picture const& picture) {
    namespace lib = shader::lib;
    Image image{ .width = picture.width, .height = picture.height, .format = Format::RGBA8 };
    image.pixels.reserve(picture.pixels.size() * 4);
    for (float3 const& pixel : picture.pixels)
        push(image, double3(lib::srgbFromLinear(lib::toneMap(pixel, lib::kToneMapAces))));
    return image;
}

} // namespace filament_core::accuracy
