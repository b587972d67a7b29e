// SPDX-License-Identifier: Apache-2.0
/// SkyGrid: the pixels of a sky with their directions and solid angles, whatever its layout, so that neither the seam
/// and the poles of a panorama nor the edges of a cube are special.
///   In      an equirectangular image, or the six faces of a cube, one below the other (IblDirections.h).
///   Thread  pure, except for pixel() of a changing sky.
///   Memory  64 B per row and column of a panorama, 4 B per texel of a face of a cube; refers to the image.
///   Fails   never.
#pragma once

#include "base/math/Elementary.h"
#include "filament_core/assets/image/HdrImage.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace filament_core::assets {

enum class SkyLayout : uint8_t { Panorama, Cube };

/// Luminance of linear Rec. 709.
inline double skyLuminance(float3 color) {
    return 0.2126 * static_cast<double>(color.x) + 0.7152 * static_cast<double>(color.y) +
           0.0722 * static_cast<double>(color.z);
}

class SkyGrid {
public:
    SkyGrid(HdrImage& image, SkyLayout layout);

    uint32_t rows() const { return mImage.height; }
    uint32_t columns() const { return mImage.width; }
    size_t indexOf(uint32_t column, uint32_t row) const { return size_t(row) * mImage.width + column; }
    float3& pixel(size_t index) const { return mImage.pixels[index]; }
    double3 direction(size_t index) const { return direction(columnOf(index), rowOf(index)); }
    double3 direction(uint32_t column, uint32_t row) const {
        return mLayout == SkyLayout::Panorama ? panoramaDirection(column, row) : cubeDirection(column, row);
    }
    /// In steradians; those of all pixels add up to 4 pi.
    double solidAngle(size_t index) const { return solidAngle(columnOf(index), rowOf(index)); }
    double solidAngle(uint32_t column, uint32_t row) const {
        return mLayout == SkyLayout::Panorama ? mRowSolidAngles[row] : cubeSolidAngle(column, row);
    }
    /// Width or height of the pixels around a direction, the larger one, in radians.
    double pixelSize(double3 direction) const;

    /// Calls visit(index, direction, solidAngle) for every pixel whose centre lies within `radius` radians of a unit
    /// vector, in a fixed order.
    template <class Visit>
    void forCap(double3 centre, double radius, Visit const& visit) const;

private:
    struct Span {
        uint32_t first, count;
    };

    uint32_t columnOf(size_t index) const { return static_cast<uint32_t>(index % mImage.width); }
    uint32_t rowOf(size_t index) const { return static_cast<uint32_t>(index / mImage.width); }
    double3 panoramaDirection(uint32_t column, uint32_t row) const {
        const double2 polar = mRowPolar[row], azimuth = mColumnAzimuth[column];
        return { azimuth.x * polar.x, polar.y, azimuth.y * polar.x };
    }
    double3 cubeDirection(uint32_t column, uint32_t row) const;
    double cubeSolidAngle(uint32_t column, uint32_t row) const;
    Span rowsOfCap(double3 centre, double radius) const;
    Span columnsOfCap(double3 centre, double radius) const; ///< the first may be followed by a wrap

    HdrImage& mImage;
    SkyLayout mLayout;
    std::vector<double2> mRowPolar, mColumnAzimuth; // sine and cosine
    std::vector<double> mRowSolidAngles;
    std::vector<float> mTexelSolidAngles;
};

template <class Visit>
void SkyGrid::forCap(double3 centre, double radius, Visit const& visit) const {
    const Span rows = rowsOfCap(centre, radius), columns = columnsOfCap(centre, radius);
    const double chord = 2 * elementary::sin(std::min(radius, std::numbers::pi) / 2), most = chord * chord;
    for (uint32_t row = rows.first; row < rows.first + rows.count; ++row) {
        for (uint32_t i = 0; i < columns.count; ++i) {
            const uint32_t column = (columns.first + i) % mImage.width;
            const double3 d = direction(column, row), away = d - centre; // near 1 a cosine has no digits left
            if (glm::dot(away, away) <= most) visit(indexOf(column, row), d, solidAngle(column, row));
        }
    }
}

} // namespace filament_core::assets
