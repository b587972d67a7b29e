// SPDX-License-Identifier: Apache-2.0
// S-2014-013 (ACES version 1.0) and the CTL of release 1.0.3: RRT.ctl, ODT.Academy.Rec709_100nits_dim.ctl and the
// libraries that they import.
#include "filament_core/values/AcesReference.h"

#include "base/math/ColorSpaces.h"
#include "base/math/Elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace filament_core {
namespace {

constexpr Chromaticities kAp0{ { 0.7347, 0.2653 }, { 0, 1 }, { 0.0001, -0.077 }, { 0.32168, 0.33767 } };
constexpr Chromaticities kAp1{ { 0.713, 0.293 }, { 0.165, 0.83 }, { 0.128, 0.044 }, { 0.32168, 0.33767 } };
constexpr Chromaticities const& kRec709 = kRec709Chromaticities;

/// All colours towards the grey of their luminance; `toY` are the weights of luminance.
double3x3 saturationMatrix(double saturation, double3 toY) {
    const double3x3 grey = glm::transpose(double3x3(toY, toY, toY));
    return grey * (1 - saturation) + double3x3(1.0) * saturation;
}

double3 luminanceWeights(double3x3 const& xyz) { return glm::transpose(xyz)[1]; }

constexpr double kLargestHalf = 65504, kLeastHalf = 5.9604644775390625e-8;
constexpr double kRrtSaturation = 0.96, kOdtSaturation = 0.93, kDimSurroundGamma = 0.9811;
constexpr double kCinemaWhite = 48, kCinemaBlack = 0.02;

struct Matrices {
    double3x3 xyzFromAp1 = xyzFromRgb(kAp1);
    double3x3 ap1FromXyz = glm::inverse(xyzFromAp1);
    double3x3 ap0FromRec709 =
            glm::inverse(xyzFromRgb(kAp0)) * whiteAdaptation(kRec709.white, kAp0.white) * xyzFromRgb(kRec709);
    double3x3 ap1FromAp0 = ap1FromXyz * xyzFromRgb(kAp0);
    double3x3 rec709FromAp1 =
            glm::inverse(xyzFromRgb(kRec709)) * whiteAdaptation(kAp1.white, kRec709.white) * xyzFromAp1;
    double3x3 rrtSaturation = saturationMatrix(kRrtSaturation, luminanceWeights(xyzFromAp1));
    double3x3 odtSaturation = saturationMatrix(kOdtSaturation, luminanceWeights(xyzFromAp1));
};

Matrices const& matrices() {
    static const Matrices kMatrices;
    return kMatrices;
}

/// Quadratic B-splines on logarithms to base 10, below and above a middle point; straight lines beyond.
template <size_t N>
struct Spline {
    std::array<double, N> low, high; ///< coefficients
    double2 least, middle, most;     ///< light in and out
    double slopeLow = 0, slopeHigh = 0;

    double operator()(double x) const {
        const double logX = elementary::log10(std::max(x, kLeastHalf));
        const double2 first = log10Of(least), mid = log10Of(middle), last = log10Of(most);
        if (logX <= first.x) return elementary::pow(10.0, logX * slopeLow + first.y - slopeLow * first.x);
        if (logX < mid.x) return elementary::pow(10.0, between(low, (logX - first.x) / (mid.x - first.x)));
        if (logX < last.x) return elementary::pow(10.0, between(high, (logX - mid.x) / (last.x - mid.x)));
        return elementary::pow(10.0, logX * slopeHigh + last.y - slopeHigh * last.x);
    }

private:
    static double2 log10Of(double2 v) { return { elementary::log10(v.x), elementary::log10(v.y) }; }

    static double between(std::array<double, N> const& c, double share) {
        constexpr size_t kCells = N - 3; // the last coefficient is there twice
        const double place = share * static_cast<double>(kCells);
        const size_t j = std::min(static_cast<size_t>(place), kCells - 1);
        const double t = place - static_cast<double>(j);
        return 0.5 * (t * t * (c[j] - 2 * c[j + 1] + c[j + 2]) + c[j] + c[j + 1]) + t * (c[j + 1] - c[j]);
    }
};

Spline<6> const& rrtCurve() {
    static const Spline<6> kCurve{ { -4, -4, -3.1573765773, -0.4852499958, 1.8477324706, 1.8477324706 },
                                   { -0.7185482425, 2.0810307172, 3.6681241237, 4, 4, 4 },
                                   { 0.18 * elementary::exp2(-15.0), 0.0001 },
                                   { 0.18, 4.8 },
                                   { 0.18 * elementary::exp2(18.0), 10'000 } };
    return kCurve;
}

Spline<10> const& odtCurve() { // for 48 cd/m^2
    static const Spline<10> kCurve{ { -1.6989700043, -1.6989700043, -1.4779, -1.2291, -0.8648, -0.448, 0.00518,
                                      0.4511080334, 0.9113744414, 0.9113744414 },
                                    { 0.5154386965, 0.8470437783, 1.1358, 1.3802, 1.5197, 1.5985, 1.6467, 1.6746091357,
                                      1.687873339, 1.687873339 },
                                    { rrtCurve()(0.18 * elementary::exp2(-6.5)), 0.02 },
                                    { rrtCurve()(0.18), 4.8 },
                                    { rrtCurve()(0.18 * elementary::exp2(6.5)), 48 },
                                    0,
                                    0.04 };
    return kCurve;
}

double saturationOf(double3 rgb) {
    const double least = std::min({ rgb.x, rgb.y, rgb.z }), most = std::max({ rgb.x, rgb.y, rgb.z });
    return (std::max(most, 1e-10) - std::max(least, 1e-10)) / std::max(most, 1e-2);
}

/// A luminance to which chroma adds.
double brightnessOf(double3 rgb) {
    const double squares = rgb.z * (rgb.z - rgb.y) + rgb.y * (rgb.y - rgb.x) + rgb.x * (rgb.x - rgb.z);
    return (rgb.x + rgb.y + rgb.z + 1.75 * std::sqrt(std::max(squares, 0.0))) / 3;
}

/// Degrees in (-180, 180], of which red is 0.
double hueOf(double3 rgb) {
    if (rgb.x == rgb.y && rgb.y == rgb.z) return 0;
    return elementary::atan2(std::sqrt(3.0) * (rgb.y - rgb.z), 2 * rgb.x - rgb.y - rgb.z) * 180 / std::numbers::pi;
}

/// From 0 to 1 where x goes from -2 to 2.
double sigmoid(double x) {
    const double t = std::max(1 - std::abs(x / 2), 0.0);
    return (1 + std::copysign(1 - t * t, x)) / 2;
}

/// Dark saturated colours get brighter.
double3 withGlow(double3 aces) {
    constexpr double kMiddle = 0.08;
    const double gain = 0.05 * sigmoid((saturationOf(aces) - 0.4) / 0.2), y = brightnessOf(aces);
    if (y >= 2 * kMiddle) return aces;
    return aces * (1 + (y <= kMiddle * 2 / 3 ? gain : gain * (kMiddle / y - 0.5)));
}

/// A cubic B-spline, `width` wide, whose peak is 1.
double bump(double x, double width) {
    const double t = std::abs(x) / (width / 4);
    if (t >= 2) return 0;
    return t >= 1 ? (2 - t) * (2 - t) * (2 - t) / 4 : (4 - 6 * t * t + 3 * t * t * t) / 4;
}

/// Saturated reds lose some of their red.
double3 withLessRed(double3 aces) {
    constexpr double kPivot = 0.03, kScale = 0.82, kWidth = 135;
    aces.x += bump(hueOf(aces), kWidth) * saturationOf(aces) * (kPivot - aces.x) * (1 - kScale);
    return aces;
}

template <class F>
double3 each(double3 v, F&& function) {
    return { function(v.x), function(v.y), function(v.z) };
}

double3 clampedTo(double3 v, double most) {
    return each(v, [&](double x) { return std::clamp(x, 0.0, most); });
}

/// RRT: AP0 -> AP1, cd/m^2 of an ideal display.
double3 rendered(double3 ap0) {
    Matrices const& m = matrices();
    const double3 aces = clampedTo(withLessRed(withGlow(ap0)), kLargestHalf);
    const double3 rgb = m.rrtSaturation * clampedTo(m.ap1FromAp0 * aces, kLargestHalf);
    return each(rgb, rrtCurve());
}

/// In a dim surround instead of a dark one, luminance has less contrast.
double3 inDimSurround(double3 ap1) {
    Matrices const& m = matrices();
    const double3 xyz = m.xyzFromAp1 * ap1;
    const double y = std::clamp(xyz.y, 0.0, kLargestHalf);
    if (y == 0) return double3(0);
    return m.ap1FromXyz * (xyz * (elementary::pow(y, kDimSurroundGamma) / y));
}

/// ODT: AP1 -> Rec. 709.
double3 shown(double3 rendered) {
    Matrices const& m = matrices();
    const double3 display =
            each(rendered, [](double x) { return (odtCurve()(x) - kCinemaBlack) / (kCinemaWhite - kCinemaBlack); });
    return clampedTo(m.rec709FromAp1 * (m.odtSaturation * inDimSurround(display)), 1);
}

} // namespace

double3 acesReference(double3 light) { return shown(rendered(matrices().ap0FromRec709 * light)); }

} // namespace filament_core
