// SPDX-License-Identifier: Apache-2.0
/// The engine's look-ups in place of integrals: the lobe of the split sum and the harmonics of the sky, without the
/// texels and levels that the engine stores them in. They replace the exact integrals one at a time (BsdfModel.h).
///   Source  Karis 2013, "Real Shading in Unreal Engine 4": the sky weighted by D and n.l, as if seen along the normal;
///           Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps".
///   Thread  values. Memory: none.
#pragma once

#include "base/math/Math.h"
#include "filament_core/assets/image/HdrImage.h"

#include <array>

namespace filament_core::reference {

/// A GGX lobe around an axis (0, 0, 1), seen along it; its integral over the sphere is 1.
class PrefilteredLobe {
public:
    explicit PrefilteredLobe(double alpha);

    /// Per steradian; 0 behind the axis.
    double value(double3 light) const;
    /// Half vectors distributed by D; the direction may lie behind the axis, where value() and pdf() are 0. u in (0,
    /// 1)^2.
    double3 sample(double2 u) const;
    double pdf(double3 light) const;

private:
    double density(double cosine) const; ///< of sample(), for the cosine of light and axis

    double mAlpha;
    double mInverseWeight;
};

/// The engine's look-up for a roughness: a lobe of that roughness, or with `levels` > 1 an interpolation between the
/// two nearest roughnesses stored in the levels of a cube (shaders/lib/ibl.glsl), as trilinear filtering does.
class SplitSumLobe {
public:
    /// perceptualRoughness in [0.045, 1].
    SplitSumLobe(double perceptualRoughness, uint32_t levels);

    double value(double3 light) const { return glm::mix(mLower.value(light), mUpper.value(light), mShare); }
    double pdf(double3 light) const { return glm::mix(mLower.pdf(light), mUpper.pdf(light), mShare); }
    double3 sample(double2 u) const;

private:
    PrefilteredLobe mLower, mUpper;
    double mShare = 0; // of the upper level
};

/// The mean of n.l over PrefilteredLobe::sample(), 0 for directions behind the axis.
double meanCosineOfLobe(double alpha);

/// Irradiance / pi of a sky with three bands of harmonics, at least 0.
class SkyHarmonics {
public:
    SkyHarmonics() = default;
    explicit SkyHarmonics(assets::HdrImage const& image);

    /// `normal` is a unit vector in the image's space.
    double3 irradiance(double3 normal) const;

private:
    std::array<double3, 9> mCoefficients{};
};

} // namespace filament_core::reference
