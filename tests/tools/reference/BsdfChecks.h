// SPDX-License-Identifier: Apache-2.0
/// Surfaces in a frame aligned with no axis, integrals over all directions, and tests that samples follow their
/// density.
#pragma once

#include "shaders/lib/LibCppDouble.h"
#include "tests/tools/reference/TestScenes.h"
#include "tools/reference/Bsdf.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <random>

namespace filament_core::reference {

inline double3 directionAt(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return { sine * std::cos(azimuth), sine * std::sin(azimuth), cosine };
}

/// A frame aligned with no axis.
inline const double3 kNormal = glm::normalize(double3(0.3, -0.5, 0.8));

inline double3 inFrame(double3 local) {
    const double3 tangent = glm::normalize(glm::cross(double3(0, 1, 0), kNormal));
    return tangent * local.x + glm::cross(kNormal, tangent) * local.y + kNormal * local.z;
}

inline SurfaceSample surfaceOf(double roughness, double metallic, double3 baseColor, double3 localView) {
    namespace lib = shader::lib64;
    SurfaceSample surface;
    surface.normal = surface.geometricNormal = kNormal;
    surface.view = inFrame(localView);
    surface.perceptualRoughness = lib::clampPerceptualRoughness(roughness);
    surface.metallic = metallic;
    surface.diffuse = lib::diffuseColor(baseColor, metallic);
    surface.f0 = lib::f0FromBaseColor(baseColor, metallic, 0.5);
    return surface;
}

/// Integral over the sphere by midpoints; cosine = 1 - 2 t^4 from the mirror direction of a view at azimuth 0, where
/// lobes are concentrated.
template <class F>
auto integrate(double viewCosine, F const& f, int polarSteps = 160, int azimuthSteps = 160) {
    const double3 axis = inFrame(directionAt(viewCosine, kPiExact));
    const double3 tangent = glm::normalize(glm::cross(double3(0.1, 1, 0.2), axis)), other = glm::cross(axis, tangent);
    decltype(f(double3())) sum{ 0.0 };
    for (int i = 0; i < polarSteps; ++i) {
        const double t = (i + 0.5) / polarSteps, cosine = 1 - 2 * std::pow(t, 4);
        for (int j = 0; j < azimuthSteps; ++j) {
            const double3 local = directionAt(cosine, 2 * kPiExact * (j + 0.5) / azimuthSteps);
            sum += f(tangent * local.x + other * local.y + axis * local.z) * (8 * t * t * t);
        }
    }
    return sum * (2 * kPiExact / (double(polarSteps) * azimuthSteps));
}

/// How often sample() returns no direction.
inline double shareWithoutDirection(Bsdf const& bsdf) {
    constexpr uint32_t kCount = 1u << 14;
    uint32_t lost = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const SampleStream numbers(9, i);
        lost += bsdf.sample(numbers.pair(0), numbers.pair(1).x).pdf == 0;
    }
    return double(lost) / kCount;
}

/// Pearson's chi-square over 32 x 32 cells of the sphere, expected counts by quadrature of the density; in deviations
/// of its cube root, which is nearly normal (Wilson and Hilferty 1931).
inline double chiSquareDeviations(Bsdf const& bsdf) {
    constexpr int kRows = 32, kColumns = 32, kInside = 12;
    constexpr uint32_t kCount = 40000;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::array<double, kRows * kColumns> expected{};
    std::array<int, kRows * kColumns> counts{};
    for (int row = 0; row < kRows * kInside; ++row) {
        for (int column = 0; column < kColumns * kInside; ++column) {
            const double z = 2 * (row + 0.5) / (kRows * kInside) - 1;
            const double azimuth = 2 * kPiExact * (column + 0.5) / (kColumns * kInside);
            expected[static_cast<size_t>(row / kInside * kColumns + column / kInside)] +=
                    bsdf.pdf(inFrame(directionAt(z, azimuth)));
        }
    }
    const double3 tangent = glm::normalize(glm::cross(double3(0, 1, 0), kNormal));
    for (uint32_t i = 0; i < kCount; ++i) {
        const BsdfSample sample = bsdf.sample({ unit(random), unit(random) }, unit(random));
        if (sample.pdf == 0) continue;
        const double x = glm::dot(sample.direction, tangent),
                     y = glm::dot(sample.direction, glm::cross(kNormal, tangent));
        const double azimuth = std::atan2(y, x);
        const double turn = azimuth / (2 * kPiExact) + (azimuth < 0 ? 1 : 0);
        const double height = 0.5 * (1 + glm::dot(sample.direction, kNormal));
        const int row = std::clamp(int(height * kRows), 0, kRows - 1);
        const int column = std::min(int(turn * kColumns), kColumns - 1);
        ++counts[static_cast<size_t>(row * kColumns + column)];
    }
    double statistic = 0, rareExpected = 0, rareCount = 0;
    int cells = 0;
    for (size_t i = 0; i < counts.size(); ++i) {
        const double mean = expected[i] * 4 * kPiExact / (kRows * kColumns * kInside * kInside) * kCount;
        if (mean < 8) {
            rareExpected += mean;
            rareCount += counts[i];
            continue;
        }
        statistic += (counts[i] - mean) * (counts[i] - mean) / mean;
        ++cells;
    }
    statistic += (rareCount - rareExpected) * (rareCount - rareExpected) / std::max(rareExpected, 1.0);
    const double degrees = std::max(cells, 1);
    return (std::cbrt(statistic / degrees) - (1 - 2 / (9 * degrees))) / std::sqrt(2 / (9 * degrees));
}

} // namespace filament_core::reference
