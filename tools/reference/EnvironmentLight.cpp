// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/EnvironmentLight.h"

#include "base/Assert.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

using std::numbers::pi;
constexpr uint32_t kMaxColumns = 4096, kMaxRows = 2048;

uint32_t below(double unit, uint32_t count) {
    return std::min(static_cast<uint32_t>(std::max(unit, 0.0) * count), count - 1);
}

} // namespace

EnvironmentLight::EnvironmentLight(std::shared_ptr<const assets::HdrImage> image, double factor, double rotationRadians)
        : mImage(std::move(image)), mFactor(factor), mCosine(std::cos(rotationRadians)),
          mSine(std::sin(rotationRadians)), mColumns(std::min(mImage->width, kMaxColumns)),
          mRows(std::min(mImage->height, kMaxRows)) {
    FILAMENT_ASSERT(mImage->width > 0 && mImage->pixels.size() == size_t(mImage->width) * mImage->height,
                    "an environment has width * height pixels, more than none");
    std::vector<double> rows(mRows), columns(mColumns);
    mColumnChoice.reserve(mRows);
    for (uint32_t row = 0; row < mRows; ++row) {
        for (uint32_t column = 0; column < mColumns; ++column) {
            columns[column] = cellWeight(column, row);
            rows[row] += columns[column] * cellSolidAngle(row);
        }
        mColumnChoice.emplace_back(columns);
    }
    mRowChoice = Distribution(rows);
    mHarmonics = SkyHarmonics(*mImage);
}

double3 EnvironmentLight::texel(int x, int y) const {
    const auto width = static_cast<int>(mImage->width), height = static_cast<int>(mImage->height);
    const int column = ((x % width) + width) % width, row = std::clamp(y, 0, height - 1);
    return double3(mImage->at(static_cast<uint32_t>(column), static_cast<uint32_t>(row)));
}

// Mean over the components and over the pixels whose centres are in the cell; a single pixel if cells are pixels.
// Integrating the bilinear image over a pixel gives the weights 1 6 1 (/ 8) for it and its neighbours in either
// direction.
double EnvironmentLight::cellWeight(uint32_t column, uint32_t row) const {
    constexpr double kWeights[3] = { 0.125, 0.75, 0.125 };
    const auto span = [](uint32_t cell, uint32_t cells, uint32_t pixels) {
        const auto begin = static_cast<int>(uint64_t(cell) * pixels / cells);
        const auto end = static_cast<int>((uint64_t(cell + 1) * pixels + cells - 1) / cells);
        return std::pair(begin, end);
    };
    const auto [left, right] = span(column, mColumns, mImage->width);
    const auto [top, bottom] = span(row, mRows, mImage->height);
    double sum = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    const double3 light = texel(x + i, y + j);
                    sum += kWeights[i + 1] * kWeights[j + 1] * (light.x + light.y + light.z);
                }
            }
        }
    }
    return sum / (3.0 * (right - left) * (bottom - top));
}

double EnvironmentLight::cellSolidAngle(uint32_t row) const {
    const double cosTop = std::cos(pi * row / mRows), cosBottom = std::cos(pi * (row + 1) / mRows);
    return 2 * pi / mColumns * (cosTop - cosBottom);
}

double3 EnvironmentLight::skyFromWorld(double3 d) const {
    return { mCosine * d.x - mSine * d.z, d.y, mSine * d.x + mCosine * d.z };
}

// As specified in <filament_core/Environment.h>.
double2 EnvironmentLight::pictureFromWorld(double3 direction) const {
    const double3 d = skyFromWorld(direction);
    const double u = 0.5 - std::atan2(d.x, d.z) / (2 * pi);
    return { u - std::floor(u), std::acos(std::clamp(d.y, -1.0, 1.0)) / pi };
}

double3 EnvironmentLight::radiance(double3 direction) const {
    if (isBlack()) return double3(0.0);
    const double2 uv = pictureFromWorld(direction);
    const double x = uv.x * mImage->width - 0.5, y = uv.y * mImage->height - 0.5;
    const double floorX = std::floor(x), floorY = std::floor(y);
    const double fx = x - floorX, fy = y - floorY;
    const int left = static_cast<int>(floorX), top = static_cast<int>(floorY);
    const double3 upper = texel(left, top) * (1 - fx) + texel(left + 1, top) * fx;
    const double3 lower = texel(left, top + 1) * (1 - fx) + texel(left + 1, top + 1) * fx;
    return (upper * (1 - fy) + lower * fy) * mFactor;
}

EnvironmentSample EnvironmentLight::sample(double2 u) const {
    const Picked row = mRowChoice.pick(u.y);
    const Picked column = mColumnChoice[row.index].pick(u.x);
    const double cosTop = std::cos(pi * row.index / mRows), cosBottom = std::cos(pi * (row.index + 1) / mRows);
    // Uniform in the cosine of the polar angle is uniform in solid angle.
    const double y = cosTop + (cosBottom - cosTop) * row.remainder;
    const double azimuth = (0.5 - (column.index + column.remainder) / mColumns) * 2 * pi;
    const double radius = std::sqrt(std::max(0.0, 1 - y * y));
    const double x = std::sin(azimuth) * radius, z = std::cos(azimuth) * radius;
    const double3 direction(mCosine * x + mSine * z, y, -mSine * x + mCosine * z);
    return { direction, radiance(direction), row.probability * column.probability / cellSolidAngle(row.index) };
}

double3 EnvironmentLight::harmonicIrradiance(double3 normal) const {
    return mHarmonics.irradiance(skyFromWorld(normal)) * mFactor;
}

double EnvironmentLight::pdf(double3 direction) const {
    if (isBlack()) return 0;
    const double2 uv = pictureFromWorld(direction);
    const uint32_t row = below(uv.y, mRows), column = below(uv.x, mColumns);
    return mRowChoice.probability(row) * mColumnChoice[row].probability(column) / cellSolidAngle(row);
}

} // namespace filament_core::reference
