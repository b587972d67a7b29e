// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/SkyGrid.h"

#include "base/Assert.h"
#include "filament_core/assets/environment/IblCube.h"
#include "filament_core/assets/environment/IblDirections.h"

#include <cmath>

namespace filament_core::assets {
namespace {

using std::numbers::pi;

double2 sineAndCosine(double radians) { return { elementary::sin(radians), elementary::cos(radians) }; }

} // namespace

SkyGrid::SkyGrid(HdrImage& image, SkyLayout layout) : mImage(image), mLayout(layout) {
    FILAMENT_ASSERT(image.width > 0 && image.height > 0 && image.pixels.size() == size_t(image.width) * image.height,
                    "a sky has width * height pixels, more than none");
    FILAMENT_ASSERT(layout == SkyLayout::Panorama || image.height == 6 * image.width, "a cube has six square faces");
    if (layout == SkyLayout::Cube) {
        mTexelSolidAngles = texelSolidAngles(image.width);
        return;
    }
    for (uint32_t row = 0; row < image.height; ++row) {
        mRowPolar.push_back(sineAndCosine(pi * (row + 0.5) / image.height));
        // cos a - cos b, without cancellation.
        mRowSolidAngles.push_back(4 * pi / image.width * mRowPolar.back().x * elementary::sin(pi / 2 / image.height));
    }
    for (uint32_t column = 0; column < image.width; ++column)
        mColumnAzimuth.push_back(sineAndCosine((0.5 - (column + 0.5) / image.width) * 2 * pi));
}

double3 SkyGrid::cubeDirection(uint32_t column, uint32_t row) const {
    const uint32_t size = mImage.width;
    const CubePoint point{ row / size, faceCoordinate(static_cast<int>(column), size),
                           faceCoordinate(static_cast<int>(row % size), size) };
    return glm::normalize(double3(directionFromCube(point)));
}

double SkyGrid::cubeSolidAngle(uint32_t column, uint32_t row) const {
    return static_cast<double>(mTexelSolidAngles[size_t(row % mImage.width) * mImage.width + column]);
}

double SkyGrid::pixelSize(double3 direction) const {
    if (mLayout == SkyLayout::Cube) return 2.0 / mImage.width; // in the middle of a face
    const double sine = std::sqrt(std::max(0.0, 1 - direction.y * direction.y));
    return std::max(pi / mImage.height, std::min(sine, 1.0) * 2 * pi / mImage.width);
}

SkyGrid::Span SkyGrid::rowsOfCap(double3 centre, double radius) const {
    if (mLayout == SkyLayout::Cube) return { 0, mImage.height };
    const double polar = elementary::acos(std::clamp(centre.y, -1.0, 1.0)), height = mImage.height;
    const double first = std::floor((polar - radius) / pi * height - 1),
                 last = std::ceil((polar + radius) / pi * height);
    const auto begin = static_cast<uint32_t>(std::clamp(first, 0.0, height - 1));
    const auto end = static_cast<uint32_t>(std::clamp(last + 1, 1.0, height));
    return { begin, end - begin };
}

// A cap around polar angle t reaches asin(sin r / sin t) to each side, unless a pole lies in it.
SkyGrid::Span SkyGrid::columnsOfCap(double3 centre, double radius) const {
    const Span all{ 0, mImage.width };
    if (mLayout == SkyLayout::Cube || radius >= pi / 2) return all;
    const double sine = std::sqrt(std::max(0.0, 1 - centre.y * centre.y)), reach = elementary::sin(radius);
    if (reach >= sine) return all;
    const double columns = elementary::asin(reach / sine) / (2 * pi) * mImage.width;
    const double middle = (0.5 - elementary::atan2(centre.x, centre.z) / (2 * pi)) * mImage.width;
    const double first = std::floor(middle - columns - 1), count = std::ceil(2 * columns) + 3;
    if (count >= mImage.width) return all;
    const double wrapped = first < 0 ? first + mImage.width : first;
    return { static_cast<uint32_t>(wrapped), static_cast<uint32_t>(count) };
}

} // namespace filament_core::assets
