// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/LightmapImage.h"

#include "base/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::bake {
namespace {

/// Fills the texels of a chart's box that have no light; returns how many it filled.
class Filler {
public:
    Filler(LightmapImage& image, std::vector<bool>& has) : mImage(image), mHas(has) {}

    uint64_t fill(AtlasChart const& chart) {
        std::vector<uint2> empty;
        for (uint32_t y = 0; y < chart.size.y; ++y) {
            for (uint32_t x = 0; x < chart.size.x; ++x) {
                if (!mHas[indexOf(chart.place + uint2(x, y))]) empty.push_back(chart.place + uint2(x, y));
            }
        }
        uint64_t filled = 0;
        while (!empty.empty()) {
            const size_t before = empty.size();
            std::vector<uint2> left, done;
            std::vector<double4> values;
            for (const uint2 at : empty) {
                const double4 mean = meanAround(at, chart);
                if (mean.w < 0) {
                    left.push_back(at);
                } else {
                    done.push_back(at), values.push_back(mean);
                }
            }
            // All of a ring at once: a result must not depend on the order within it.
            for (size_t i = 0; i < done.size(); ++i) {
                mImage.texels[indexOf(done[i])] = values[i];
                mHas[indexOf(done[i])] = true;
            }
            filled += done.size();
            empty = std::move(left);
            if (empty.size() == before) break; // the chart has no light at all
        }
        return filled;
    }

private:
    size_t indexOf(uint2 at) const { return size_t(at.y) * mImage.side + at.x; }

    /// w < 0: no neighbour has light.
    double4 meanAround(uint2 at, AtlasChart const& chart) const {
        double4 sum(0.0);
        double count = 0;
        const uint2 low = glm::max(at, chart.place + 1u) - 1u, high = glm::min(at + 1u, chart.place + chart.size - 1u);
        for (uint32_t y = low.y; y <= high.y; ++y) {
            for (uint32_t x = low.x; x <= high.x; ++x) {
                if (!mHas[indexOf({ x, y })]) continue;
                sum += mImage.texels[indexOf({ x, y })];
                count += 1;
            }
        }
        return count > 0 ? sum / count : double4(0, 0, 0, -1);
    }

    LightmapImage& mImage;
    std::vector<bool>& mHas;
};

/// A level, and how much of the surface each of its texels covers, in texels of level 0.
struct CoveredLevel {
    uint32_t width = 0;
    std::vector<double4> texels;
    std::vector<uint32_t> covered;
};

/// The next smaller level: boxes of charts begin and end at whole texels of it.
CoveredLevel halved(CoveredLevel const& from) {
    CoveredLevel level{ .width = from.width / 2, .texels = {}, .covered = {} };
    const size_t height = from.texels.size() / from.width / 2;
    for (size_t y = 0; y < height; ++y) {
        for (size_t x = 0; x < level.width; ++x) {
            const size_t first = 2 * y * from.width + 2 * x;
            double4 seen(0.0), all(0.0);
            uint32_t covered = 0;
            for (const size_t i : { first, first + 1, first + from.width, first + from.width + 1 }) {
                seen += double(from.covered[i]) * from.texels[i];
                all += from.texels[i];
                covered += from.covered[i];
            }
            level.texels.push_back(covered > 0 ? seen / double(covered) : all / 4.0);
            level.covered.push_back(covered);
        }
    }
    return level;
}

std::vector<std::vector<double4>> smallerLevels(CoveredLevel level, uint32_t count) {
    std::vector<std::vector<double4>> levels;
    for (; count > 0; --count) {
        level = halved(level);
        levels.push_back(level.texels);
    }
    return levels;
}

} // namespace

LightmapImage makeImage(Atlas const& atlas, std::span<const AtlasTexel> texels, std::span<const TexelLight> lights) {
    LightmapImage image{ .side = atlas.side, .pages = atlas.pages };
    image.texels.assign(size_t(atlas.side) * atlas.side * atlas.pages, double4(0.0));
    std::vector<bool> has(image.texels.size(), false);
    std::vector<uint32_t> covered(image.texels.size(), 0);
    double brightest = 0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const bool isHidden = lights[i].backs > kMostBacks;
        image.hidden += isHidden;
        if (isHidden) continue;
        const size_t at = size_t(texels[i].y) * atlas.side + texels[i].x;
        image.texels[at] = double4(lights[i].irradiance, lights[i].openness);
        has[at] = true;
        covered[at] = texels[i].distance == 0 ? 1 : 0;
        brightest = std::max({ brightest, lights[i].irradiance.x, lights[i].irradiance.y, lights[i].irradiance.z });
    }
    Filler filler(image, has);
    for (AtlasChart const& chart : atlas.charts) image.filled += filler.fill(chart);
    if (brightest > 0) image.intensity = std::ldexp(1.0, std::ilogb(brightest) + 1 - kTopExponent);
    image.smaller = smallerLevels({ image.side, image.texels, std::move(covered) }, atlas.levels - 1);
    return image;
}

LightmapImage makeChartImage(Atlas const& atlas, double lux) {
    LightmapImage image{ .side = atlas.side, .pages = atlas.pages };
    image.texels.assign(size_t(atlas.side) * atlas.side * atlas.pages, double4(0, 0, 0, 1));
    for (uint32_t i = 0; i < atlas.charts.size(); ++i) {
        AtlasChart const& chart = atlas.charts[i];
        const double hue = 6 * std::fmod(i * 0.618033988749895, 1.0); // neighbours differ: the golden ratio
        const double3 color =
                glm::clamp(double3(std::abs(hue - 3) - 1, 2 - std::abs(hue - 2), 2 - std::abs(hue - 4)), 0.2, 1.0);
        for (uint32_t y = 0; y < chart.size.y; ++y) {
            for (uint32_t x = 0; x < chart.size.x; ++x) {
                const uint2 inner = uint2(x, y) - chart.padding; // wraps around below 0
                const bool isInside = inner.x < chart.inner.x && inner.y < chart.inner.y;
                const double shade = isInside ? ((x + y) % 2 == 0 ? 2.0 : 1.0) : 0.25;
                const size_t at = size_t(chart.place.y + y) * atlas.side + chart.place.x + x;
                image.texels[at] = double4(lux * shade * color, 1.0);
            }
        }
    }
    constexpr double3 kLevels[kMostLevels - 1] = { { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 2, 2, 0 }, { 2, 0, 2 } };
    for (uint32_t level = 1; level < atlas.levels; ++level)
        image.smaller.emplace_back(image.texels.size() >> (2 * level), double4(lux * kLevels[level - 1], 1.0));
    image.intensity = std::ldexp(1.0, std::ilogb(std::max(2 * lux, 1e-30)) + 1 - kTopExponent);
    return image;
}

assets::Image halvesOf(LightmapImage const& image) {
    assets::Image halves{ .width = image.side,
                          .height = image.side * image.pages,
                          .levels = static_cast<uint32_t>(image.smaller.size()) + 1,
                          .format = backend::Format::RGBA16F };
    halves.data.reserve(halves.levelOffset(halves.levels));
    const auto add = [&](std::vector<double4> const& texels) {
        for (double4 const& lux : texels) {
            const double4 texel = lux / double4(double3(image.intensity), 1.0);
            uint16_t codes[4];
            for (int c = 0; c < 4; ++c) codes[c] = halfFromFloat(static_cast<float>(texel[c]));
            const auto bytes = std::as_bytes(std::span(codes));
            halves.data.insert(halves.data.end(), bytes.begin(), bytes.end());
        }
    };
    add(image.texels);
    for (std::vector<double4> const& level : image.smaller) add(level);
    return halves;
}

assets::Image onePage(assets::Image const& all, uint32_t page) {
    assets::Image image = all;
    image.height = all.width;
    image.data.clear();
    for (uint32_t level = 0; level < all.levels; ++level) {
        const uint64_t bytes = all.levelBytes(level) / (all.height / all.width);
        const auto from = std::span(all.data).subspan(all.levelOffset(level) + page * bytes, bytes);
        image.data.insert(image.data.end(), from.begin(), from.end());
    }
    return image;
}

double4 lookUp(assets::Image const& halves, double2 place) {
    const auto texel = [&](double2 at) {
        const auto last = double2(halves.width, halves.height) - 1.0;
        const auto clamped = uint2(glm::clamp(at, double2(0.0), last));
        uint16_t codes[4];
        std::memcpy(codes, &halves.data[(size_t(clamped.y) * halves.width + clamped.x) * 8], sizeof(codes));
        double4 value;
        for (int c = 0; c < 4; ++c) value[c] = double(floatFromHalf(codes[c]));
        return value;
    };
    const double2 corner = glm::floor(place - 0.5), share = place - 0.5 - corner;
    const double4 low = glm::mix(texel(corner), texel(corner + double2(1, 0)), share.x);
    const double4 high = glm::mix(texel(corner + double2(0, 1)), texel(corner + 1.0), share.x);
    return glm::mix(low, high, share.y);
}

std::vector<std::byte> previewOf(LightmapImage const& image) {
    double sum = 0;
    uint64_t count = 0;
    for (double4 const& texel : image.texels) {
        const double mean = (texel.x + texel.y + texel.z) / 3;
        if (mean > 0) sum += mean, ++count;
    }
    const double scale = count > 0 ? 0.4 / (sum / double(count)) : 1; // the mean becomes a middle grey
    std::vector<std::byte> pixels(image.texels.size() * 4, std::byte{ 255 });
    for (size_t i = 0; i < image.texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double value = std::clamp(image.texels[i][c] * scale, 0.0, 1.0);
            const double code = value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
            pixels[i * 4 + static_cast<size_t>(c)] = static_cast<std::byte>(std::lround(code * 255));
        }
    }
    return pixels;
}

} // namespace filament_core::bake
