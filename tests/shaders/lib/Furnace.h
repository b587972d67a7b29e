// SPDX-License-Identifier: Apache-2.0
/// Integrals over directions in double precision with the shader library in double (LibCppDouble.h): the reference for
/// every lobe and every stack of layers. Midpoints in both angles; the polar one may be concentrated at the pole or the
/// horizon.
#pragma once

#include "shaders/lib/LibCppDouble.h"

#include <cmath>
#include <numbers>

namespace filament_core::shader::lib64 {

inline constexpr double kPiOfTests = std::numbers::pi;
/// Allowance for rounding and quadrature above an albedo of 1.
inline constexpr double kNoGain = 1.005;

inline vec3 viewAt(double nov) { return { std::sqrt(1 - nov * nov), 0, nov }; }

struct Quadrature {
    int polar = 400, azimuth = 128;
    double polePower = 1;    ///< cosine = 1 - t^power: above 1 concentrates points at the normal
    double horizonPower = 2; ///< cosine = t^power, if polePower is 1: above 1 concentrates points at the horizon
};

/// Integral of f(unit vector with z > 0) over solid angle. f returns double or vec3.
template <class F>
auto integrateUpper(F&& f, Quadrature q = {}) {
    decltype(f(vec3())) sum(0.0);
    for (int i = 0; i < q.polar; ++i) {
        const double t = (i + 0.5) / q.polar;
        const bool pole = q.polePower > 1;
        const double power = pole ? q.polePower : q.horizonPower;
        const double c = pole ? 1 - std::pow(t, power) : std::pow(t, power);
        const double s = std::sqrt((1 - c) * (1 + c)), measure = power * std::pow(t, power - 1) / q.polar;
        for (int j = 0; j < q.azimuth; ++j) {
            const double phi = 2 * kPiOfTests * (j + 0.5) / q.azimuth;
            sum += f(vec3(s * std::cos(phi), s * std::sin(phi), c)) * measure;
        }
    }
    return sum * (2 * kPiOfTests / q.azimuth);
}

/// The same over half vectors for a narrow lobe: f(l, h) is the light from l to v, cosine included, and dl = 4 voh dh.
template <class F>
auto integrateHalf(vec3 v, F&& f, Quadrature q) {
    return integrateUpper(
            [&](vec3 h) {
                const double voh = dot(v, h);
                const vec3 l = 2 * voh * h - v;
                decltype(f(v, v)) nothing(0.0);
                return voh > 0 && l.z > 0 ? f(l, h) * (4 * voh) : nothing;
            },
            q);
}

/// Mean of g(h) over samples of a half vector's distribution.
template <class Sampler, class G>
double meanOverSamples(Sampler&& sampler, G&& g, uint count = 1 << 14) {
    double sum = 0;
    for (uint i = 0; i < count; ++i) sum += g(sampler(hammersley(i, 1.0 / count) + vec2(0.5 / count)));
    return sum / count;
}

} // namespace filament_core::shader::lib64
