// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Prefiltered.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

using std::numbers::pi;

/// Real spherical harmonics up to band 2, normalised. Ramamoorthi and Hanrahan 2001, eq. 3.
std::array<double, 9> harmonicsAt(double3 n) {
    return { 0.5 * std::sqrt(1 / pi),
             std::sqrt(3 / (4 * pi)) * n.y,
             std::sqrt(3 / (4 * pi)) * n.z,
             std::sqrt(3 / (4 * pi)) * n.x,
             std::sqrt(15 / (4 * pi)) * n.x * n.y,
             std::sqrt(15 / (4 * pi)) * n.y * n.z,
             std::sqrt(5 / (16 * pi)) * (3 * n.z * n.z - 1),
             std::sqrt(15 / (4 * pi)) * n.x * n.z,
             std::sqrt(15 / (16 * pi)) * (n.x * n.x - n.y * n.y) };
}

// A clamped cosine's band factors over pi. Ibid., eq. 8.
constexpr double kBandFactors[9] = { 1, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25 };

} // namespace

// With u = cos of light and axis, cos^2 of half vector and axis is (1 + u) / 2, and D / 4 = alpha^2 / (4 pi (a + b
// u)^2) is the density of the light's direction. The mean of u is alpha^2 / 2 times the integral of u / (a + b u)^2.
double meanCosineOfLobe(double alpha) {
    const double a2 = alpha * alpha, a = 0.5 * (1 + a2), b = 0.5 * (a2 - 1);
    if (std::abs(b) < 1e-4) return 0.5 * a2 * (0.5 / (a * a) - 2.0 / 3 * b / (a * a * a)); // series: b^2 would cancel
    return 0.5 * a2 / (b * b) * (std::log(a2 / a) + a / a2 - 1);
}

PrefilteredLobe::PrefilteredLobe(double alpha) : mAlpha(alpha), mInverseWeight(1 / meanCosineOfLobe(alpha)) {}

double PrefilteredLobe::density(double cosine) const {
    const double3 halfway(std::sqrt(std::max(0.0, 0.5 * (1 - cosine))), 0, std::sqrt(0.5 * (1 + cosine)));
    return 0.25 * lib::ndfGgxFromVectors({ 0, 0, 1 }, halfway, mAlpha);
}

double PrefilteredLobe::value(double3 light) const {
    return light.z > 0 ? density(std::min(light.z, 1.0)) * light.z * mInverseWeight : 0;
}

double PrefilteredLobe::pdf(double3 light) const { return light.z > 0 ? density(std::min(light.z, 1.0)) : 0; }

// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eqs. 35 and 36.
double3 PrefilteredLobe::sample(double2 u) const {
    const double tangent2 = mAlpha * mAlpha * u.x / (1 - u.x), z2 = 1 / (1 + tangent2);
    const double z = std::sqrt(z2), radius = std::sqrt(std::max(0.0, 1 - z2)), azimuth = lib::kTwoPi * u.y;
    const double3 halfway(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
    return { 2 * z * halfway.x, 2 * z * halfway.y, 2 * z2 - 1 };
}

SplitSumLobe::SplitSumLobe(double perceptualRoughness, uint32_t levels)
        : mLower(lib::alphaFromPerceptual(perceptualRoughness)), mUpper(mLower) {
    if (levels < 2) return;
    const double last = levels - 1, level = lib::levelFromPerceptualRoughness(perceptualRoughness, last);
    const double lower = std::min(std::floor(level), last - 1);
    const auto lobeOf = [last](double of) {
        const double roughness = lib::perceptualRoughnessFromLevel(of, last);
        return PrefilteredLobe(lib::alphaFromPerceptual(lib::clampPerceptualRoughness(roughness)));
    };
    mLower = lobeOf(lower);
    mUpper = lobeOf(lower + 1);
    mShare = level - lower;
}

double3 SplitSumLobe::sample(double2 u) const {
    if (u.x < mShare) return mUpper.sample({ u.x / mShare, u.y });
    return mLower.sample({ (u.x - mShare) / (1 - mShare), u.y });
}

SkyHarmonics::SkyHarmonics(assets::HdrImage const& image) {
    for (uint32_t y = 0; y < image.height; ++y) {
        const double top = pi * y / image.height, bottom = pi * (y + 1) / image.height;
        const double solidAngle = 2 * pi / image.width * (std::cos(top) - std::cos(bottom));
        const double polar = 0.5 * (top + bottom);
        for (uint32_t x = 0; x < image.width; ++x) {
            const double azimuth = (0.5 - (x + 0.5) / image.width) * 2 * pi;
            const double3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                    std::sin(polar) * std::cos(azimuth));
            const std::array<double, 9> basis = harmonicsAt(direction);
            const double3 light = double3(image.at(x, y)) * solidAngle;
            for (size_t i = 0; i < 9; ++i) mCoefficients[i] += light * (basis[i] * kBandFactors[i]);
        }
    }
}

double3 SkyHarmonics::irradiance(double3 normal) const {
    const std::array<double, 9> basis = harmonicsAt(normal);
    double3 sum(0.0);
    for (size_t i = 0; i < 9; ++i) sum += mCoefficients[i] * basis[i];
    return glm::max(sum, 0.0);
}

} // namespace filament_core::reference
