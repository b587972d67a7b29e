// SPDX-License-Identifier: Apache-2.0
/// Brute-force integration and edge grids for the tests of shaders/lib: slow, simple, in double precision.
#pragma once

#include "shaders/lib/LibCpp.h"

#include <array>
#include <cmath>
#include <numbers>

namespace filament_core::shader::lib {

inline constexpr double kPiExact = std::numbers::pi;

/// Cosines, roughnesses and visibilities that shading must support, including zero and one.
inline constexpr std::array<float, 13> kEdges{ 0.0f, 1e-30f, 1e-10f, 1e-6f,     1e-4f,       0.01f, 0.1f,
                                               0.5f, 0.9f,   0.999f, 0.999999f, 0.99999994f, 1.0f };

/// Integral of f(direction) over the upper hemisphere: midpoints in azimuth and in t, cosine = 1 - t^power, which
/// concentrates points at the pole for narrow lobes.
template <class F>
double integrateHemisphere(F&& f, int polarSteps = 512, int azimuthSteps = 64, double power = 2) {
    double sum = 0;
    for (int i = 0; i < polarSteps; ++i) {
        const double t = (i + 0.5) / polarSteps;
        const double cosTheta = 1 - std::pow(t, power), measure = power * std::pow(t, power - 1) / polarSteps;
        const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
        for (int j = 0; j < azimuthSteps; ++j) {
            const double phi = 2 * kPiExact * (j + 0.5) / azimuthSteps;
            const vec3 d(static_cast<float>(std::cos(phi) * sinTheta), static_cast<float>(std::sin(phi) * sinTheta),
                         static_cast<float>(cosTheta));
            sum += static_cast<double>(f(d)) * measure;
        }
    }
    return sum * 2 * kPiExact / azimuthSteps;
}

/// Mean over the sphere times 4 pi.
template <class F>
double integrateSphere(F&& f, int polarSteps = 200, int azimuthSteps = 200) {
    double sum = 0;
    for (int i = 0; i < polarSteps; ++i) {
        const double cosTheta = 1 - 2 * (i + 0.5) / polarSteps, sinTheta = std::sqrt(1 - cosTheta * cosTheta);
        for (int j = 0; j < azimuthSteps; ++j) {
            const double phi = 2 * kPiExact * (j + 0.5) / azimuthSteps;
            sum += static_cast<double>(f(vec3(std::cos(phi) * sinTheta, std::sin(phi) * sinTheta, cosTheta)));
        }
    }
    return sum * 4 * kPiExact / (polarSteps * azimuthSteps);
}

inline bool isFinite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace filament_core::shader::lib
