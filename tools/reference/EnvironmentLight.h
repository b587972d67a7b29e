// SPDX-License-Identifier: Apache-2.0
/// EnvironmentLight: radiance from every direction, and sampling of directions in proportion to radiance.
///   In      an equirectangular image, interpolated bilinearly; columns wrap around, rows end at the poles.
///   Method  cells of equal azimuth and polar angle. The probability of a cell is proportional to the exact integral of
///           the bilinear image over it (in u, v) times its solid angle; directions within a cell are uniform in
///           solid angle. Every cell with light can be picked: estimates are unbiased.
///   Source  Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", section 12.5 (with uniform cells in cos
///           theta).
///   Limits  4096 x 2048 cells: larger images share cells, which adds noise, but no bias.
///   Memory  8 bytes per cell and the image, shared.
///   Thread  read-only after construction.
#pragma once

#include "base/math/Math.h"
#include "filament_core/assets/image/HdrImage.h"
#include "tools/reference/Distribution.h"
#include "tools/reference/Prefiltered.h"

#include <memory>

namespace filament_core::reference {

struct EnvironmentSample {
    double3 direction; ///< world, unit
    double3 radiance;
    double pdf = 0; ///< per steradian
};

class EnvironmentLight {
public:
    EnvironmentLight() = default; ///< black
    EnvironmentLight(std::shared_ptr<const assets::HdrImage> image, double factor, double rotationRadians);

    bool isBlack() const { return !mImage; }
    /// `direction` is a unit vector of the world. The image's radiance times `factor`.
    double3 radiance(double3 direction) const;
    /// u in [0, 1)^2. Must not be called if isBlack().
    EnvironmentSample sample(double2 u) const;
    /// Density of sample(), per steradian.
    double pdf(double3 direction) const;
    /// Irradiance / pi around a unit vector of the world, by three bands of harmonics.
    double3 harmonicIrradiance(double3 normal) const;

private:
    double3 skyFromWorld(double3 direction) const;     ///< the inverse rotation
    double2 pictureFromWorld(double3 direction) const; ///< (u, v) in [0, 1)^2
    double3 texel(int x, int y) const;
    double cellWeight(uint32_t column, uint32_t row) const;
    double cellSolidAngle(uint32_t row) const;

    std::shared_ptr<const assets::HdrImage> mImage;
    double mFactor = 0;
    double mCosine = 1, mSine = 0; // of the rotation
    uint32_t mColumns = 0, mRows = 0;
    Distribution mRowChoice;
    std::vector<Distribution> mColumnChoice; // by row
    SkyHarmonics mHarmonics;                 // without the factor
};

} // namespace filament_core::reference
