// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/LightImageTable.h"

#include "base/math/Elementary.h"
#include "base/math/Half.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/image/ChannelTransfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

namespace filament_core::assets {
namespace {

float sound(float value) { return value > 0 ? std::min(value, kMaxRgb9E5) : 0.0f; }

template <class T, class Decode>
void decodeChannels(LightPixels& image, std::span<const std::byte> pixels, Decode const& decode) {
    for (size_t i = 0; i < image.colors.size(); ++i) {
        std::array<T, 4> channels;
        std::memcpy(channels.data(), pixels.data() + i * sizeof(channels), sizeof(channels));
        for (int c = 0; c < 3; ++c) image.colors[i][c] = sound(decode(channels[static_cast<size_t>(c)]));
    }
}

/// Halves of a row or a column: the means over `count` equal parts of `size` entries, `step` apart.
void average(float3 const* from, size_t size, size_t step, float3* to, size_t count, size_t toStep) {
    const double width = static_cast<double>(size) / static_cast<double>(count);
    for (size_t i = 0; i < count; ++i) {
        const double begin = static_cast<double>(i) * width, end = begin + width;
        double3 sum(0.0);
        for (auto at = static_cast<size_t>(begin); at < size && static_cast<double>(at) < end; ++at) {
            const double share = std::min(end, static_cast<double>(at + 1)) - std::max(begin, static_cast<double>(at));
            sum += double3(from[at * step]) * std::max(share, 0.0);
        }
        to[i * toStep] = float3(sum / width);
    }
}

/// Means weighted by a Gaussian around the middle of each of `count` parts, within the row: what lies beyond counts for
/// nothing. `deviation`: entries.
void blur(float3 const* from, size_t size, size_t step, float3* to, size_t count, size_t toStep, double deviation) {
    const double width = static_cast<double>(size) / static_cast<double>(count);
    for (size_t i = 0; i < count; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * width - 0.5, reach = 3 * deviation;
        const auto begin = static_cast<size_t>(std::max(std::ceil(middle - reach), 0.0));
        const auto last = static_cast<size_t>(std::min(std::floor(middle + reach), static_cast<double>(size - 1)));
        double3 sum(0.0);
        double weights = 0;
        for (size_t at = begin; at <= last; ++at) {
            const double away = (static_cast<double>(at) - middle) / deviation;
            const double weight = elementary::exp(-0.5 * away * away);
            sum += double3(from[at * step]) * weight;
            weights += weight;
        }
        to[i * toStep] = float3(sum / weights);
    }
}

/// Of kDeviation * 2^level texels of the image.
LightPixels blurred(LightPixels const& image, uint32_t width, uint32_t height, uint32_t level) {
    constexpr double kDeviation = 1;
    const double deviation = std::ldexp(kDeviation, static_cast<int>(level));
    LightPixels rows{ width, image.height, std::vector<float3>(size_t{ width } * image.height) };
    for (size_t y = 0; y < image.height; ++y)
        blur(image.colors.data() + y * image.width, image.width, 1, rows.colors.data() + y * width, width, 1,
             deviation);
    LightPixels both{ width, height, std::vector<float3>(size_t{ width } * height) };
    for (size_t x = 0; x < width; ++x)
        blur(rows.colors.data() + x, image.height, width, both.colors.data() + x, height, width, deviation);
    return both;
}

/// The texel at a place that may be one beyond an edge.
float3 withBorder(LightPixels const& image, int x, int y, LightImageShape shape) {
    const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    if (shape == LightImageShape::Tiled) {
        x = (x + width) % width, y = (y + height) % height;
    } else if (shape == LightImageShape::Octahedron) {
        // Beyond an edge lies the same edge, from its other end.
        const bool beyondX = x < 0 || x >= width, beyondY = y < 0 || y >= height;
        x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
        if (beyondX) y = height - 1 - y;
        if (beyondY) x = width - 1 - x;
    } else {
        x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
    }
    return image.colors[static_cast<size_t>(y) * image.width + static_cast<size_t>(x)];
}

void appendLevel(std::vector<uint32_t>& words, LightPixels const& level, LightImageShape shape) {
    for (int y = -1; y <= static_cast<int>(level.height); ++y) {
        for (int x = -1; x <= static_cast<int>(level.width); ++x)
            words.push_back(packRgb9E5(withBorder(level, x, y, shape)));
    }
}

/// Unit or not: the direction of a place of an octahedral map in [-1, 1], around +z.
double3 octahedralDirection(double2 at) {
    const double2 beside = glm::abs(at);
    const double z = 1 - beside.x - beside.y;
    if (z < 0) at = { (1 - beside.y) * (at.x < 0 ? -1 : 1), (1 - beside.x) * (at.y < 0 ? -1 : 1) };
    return { at.x, at.y, z };
}

} // namespace

LightPixels lightPixels(LightImageDesc const& desc) {
    LightPixels image{ desc.width, desc.height, std::vector<float3>(size_t{ desc.width } * desc.height) };
    if (desc.format == Format::RGBA32F) {
        decodeChannels<float>(image, desc.pixels, [](float value) { return value; });
    } else if (desc.format == Format::RGBA16F) {
        decodeChannels<uint16_t>(image, desc.pixels, floatFromHalf);
    } else {
        std::array<float, 256> values{};
        for (size_t code = 0; code < values.size(); ++code) {
            const double value = static_cast<double>(code) / 255;
            values[code] = static_cast<float>(desc.format == Format::RGBA8Srgb ? linearFromSrgb(value) : value);
        }
        decodeChannels<uint8_t>(image, desc.pixels, [&](uint8_t code) { return values[code]; });
    }
    return image;
}

// OpenGL 4.6, table 8.19: the face of the longest component, and s and t on it.
float3 colorOfCube(LightPixels const& faces, double3 direction) {
    const bool isRow = faces.width > faces.height;
    const uint32_t size = isRow ? faces.height : faces.width;
    const double3 away = glm::abs(direction);
    const int axis = away.x >= away.y && away.x >= away.z ? 0 : away.y >= away.z ? 1 : 2;
    const bool isNegative = direction[axis] < 0;
    const double sign = isNegative ? -1 : 1;
    double2 at;
    if (axis == 0)
        at = { -sign * direction.z, -direction.y };
    else if (axis == 1)
        at = { direction.x, sign * direction.z };
    else
        at = { sign * direction.x, -direction.y };
    at = (at / away[axis] * 0.5 + 0.5) * double(size) - 0.5;
    const uint32_t face = static_cast<uint32_t>(2 * axis + (isNegative ? 1 : 0));
    const double2 whole = glm::floor(at), part = at - whole;
    const auto texel = [&](double x, double y) {
        const auto column = static_cast<uint32_t>(std::clamp(x, 0.0, double(size - 1)));
        const auto row = static_cast<uint32_t>(std::clamp(y, 0.0, double(size - 1)));
        const size_t first = isRow ? size_t{ face } * size : size_t{ face } * size * size;
        return double3(faces.colors[first + size_t{ row } * faces.width + column]);
    };
    const double3 above = glm::mix(texel(whole.x, whole.y), texel(whole.x + 1, whole.y), part.x);
    const double3 below = glm::mix(texel(whole.x, whole.y + 1), texel(whole.x + 1, whole.y + 1), part.x);
    return float3(glm::mix(above, below, part.y));
}

LightPixels octahedronOfCube(LightPixels const& faces) {
    const uint32_t size = std::min(2 * std::min(faces.width, faces.height), kMaxLightImageSize);
    constexpr int kSamples = 4; // a side
    LightPixels image{ size, size, {} };
    image.colors.reserve(size_t{ size } * size);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            double3 sum(0.0);
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const double2 within((i % kSamples + 0.5) / kSamples, (i / kSamples + 0.5) / kSamples);
                const double3 v = octahedralDirection((double2(x, y) + within) * (2.0 / size) - 1.0);
                sum += double3(colorOfCube(faces, { v.x, -v.y, -v.z })); // down the image is -Y, its middle -Z
            }
            image.colors.push_back(float3(sum / double{ kSamples * kSamples }));
        }
    }
    return image;
}

LightPixels averaged(LightPixels const& image, uint32_t width, uint32_t height) {
    LightPixels rows{ width, image.height, std::vector<float3>(size_t{ width } * image.height) };
    for (size_t y = 0; y < image.height; ++y)
        average(image.colors.data() + y * image.width, image.width, 1, rows.colors.data() + y * width, width, 1);
    LightPixels both{ width, height, std::vector<float3>(size_t{ width } * height) };
    for (size_t x = 0; x < width; ++x)
        average(rows.colors.data() + x, image.height, width, both.colors.data() + x, height, width);
    return both;
}

std::vector<uint32_t> lightImageTable(LightPixels const& image, LightImageShape shape, uint32_t number) {
    const uint32_t width = std::min(image.width, kMaxLightImageSize);
    const uint32_t height = std::min(image.height, kMaxLightImageSize);
    std::vector<LightPixels> levels{ image.width == width && image.height == height ? image
                                                                                    : averaged(image, width, height) };
    while (levels.back().width > 1 || levels.back().height > 1) {
        const uint32_t halfWidth = std::max(levels.back().width / 2, 1u);
        const uint32_t halfHeight = std::max(levels.back().height / 2, 1u);
        const auto level = static_cast<uint32_t>(levels.size());
        levels.push_back(shape == LightImageShape::Emitted ? blurred(levels.front(), halfWidth, halfHeight, level)
                                                           : averaged(levels.back(), halfWidth, halfHeight));
    }
    std::vector<uint32_t> words(kLightImageHeaderWords + levels.size());
    words[0] = width, words[1] = height, words[2] = static_cast<uint32_t>(levels.size() - 1), words[3] = number;
    for (size_t i = 0; i < levels.size(); ++i) {
        words[kLightImageHeaderWords + i] = static_cast<uint32_t>(words.size());
        appendLevel(words, levels[i], shape);
    }
    return words;
}

} // namespace filament_core::assets
