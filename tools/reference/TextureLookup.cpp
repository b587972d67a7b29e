// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/TextureLookup.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::reference {
namespace {

std::array<double, 256> makeCodes(bool isSrgb) {
    std::array<double, 256> values{};
    for (size_t code = 0; code < values.size(); ++code) {
        const double value = static_cast<double>(code) / 255;
        values[code] = isSrgb ? shader::lib64::linearFromSrgb(value) : value;
    }
    return values;
}

class Texels {
public:
    Texels(assets::Image const& image, Sampler const& sampler)
            : mImage(image), mSampler(sampler), mWidth(static_cast<int>(image.width)),
              mHeight(static_cast<int>(image.height)) {}

    int width() const { return mWidth; }
    int height() const { return mHeight; }

    double4 at(int x, int y) const {
        static const std::array<double, 256> sPlain = makeCodes(false), sSrgb = makeCodes(true);
        auto const& color = mImage.format == backend::Format::RGBA8Srgb ? sSrgb : sPlain;
        const auto column = static_cast<size_t>(wrapped(x, mWidth, mSampler.wrapU));
        const auto row = static_cast<size_t>(wrapped(y, mHeight, mSampler.wrapV));
        const std::byte* const texel = &mImage.data[(row * mImage.width + column) * 4];
        const auto code = [texel](size_t i) { return std::to_integer<size_t>(texel[i]); };
        return { color[code(0)], color[code(1)], color[code(2)], sPlain[code(3)] };
    }

private:
    assets::Image const& mImage;
    Sampler const& mSampler;
    int mWidth, mHeight;
};

} // namespace

int wrapped(int coordinate, int size, backend::WrapMode mode) {
    const auto positive = [](int value, int period) { return ((value % period) + period) % period; };
    switch (mode) {
    case backend::WrapMode::Repeat:
        return positive(coordinate, size);
    case backend::WrapMode::MirroredRepeat: {
        const int inPeriod = positive(coordinate, 2 * size);
        return inPeriod < size ? inPeriod : 2 * size - 1 - inPeriod;
    }
    case backend::WrapMode::ClampToEdge:
        break;
    }
    return std::clamp(coordinate, 0, size - 1);
}

double4 lookUp(assets::Image const& image, Sampler const& sampler, double2 uv) {
    const Texels texels(image, sampler);
    // Coordinates far outside, as in damaged files, show nothing meaningful.
    constexpr double kFarthest = 1e8;
    const double x = std::clamp(uv.x * texels.width(), -kFarthest, kFarthest);
    const double y = std::clamp(uv.y * texels.height(), -kFarthest, kFarthest);
    if (!(x == x) || !(y == y)) return texels.at(0, 0);
    if (sampler.magFilter == Filter::Nearest) {
        return texels.at(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    }
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double fx = x - 0.5 - left, fy = y - 0.5 - top;
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const double4 upper = texels.at(column, row) * (1 - fx) + texels.at(column + 1, row) * fx;
    const double4 lower = texels.at(column, row + 1) * (1 - fx) + texels.at(column + 1, row + 1) * fx;
    return upper * (1 - fy) + lower * fy;
}

} // namespace filament_core::reference
