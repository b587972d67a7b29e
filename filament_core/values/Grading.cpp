// SPDX-License-Identifier: Apache-2.0
#include "base/math/Elementary.h"
#include "filament_core/values/Daylight.h"

#include <filament_core/Effects.h>

#include <cmath>

namespace filament_core {
namespace {

double3x3 fromRows(double3 x, double3 y, double3 z) { return glm::transpose(double3x3(x, y, z)); }

double3x3 fromRows(float3 x, float3 y, float3 z) { return fromRows(double3(x), double3(y), double3(z)); }

// ITU-R BT.2087-0, from the primaries of BT.709 and BT.2020 and D65.
const double3x3 kRec2020FromRec709 =
        fromRows(double3(0.627403896, 0.329283038, 0.043313066), double3(0.069097289, 0.919540395, 0.011362316),
                 double3(0.016391439, 0.088013308, 0.895595253));
const double3x3 kXyzFromRec2020 =
        fromRows(double3(0.636958048, 0.144616904, 0.168880975), double3(0.262700212, 0.677998072, 0.059301716),
                 double3(0, 0.028072693, 1.060985058));
// What the three kinds of cones see: CAT16 of Li et al. 2017, "Comprehensive color solutions: CAM16, CAT16, and
// CAM16-UCS".
const double3x3 kConesFromXyz = fromRows(double3(0.401288, 0.650173, -0.051461), double3(-0.250268, 1.204414, 0.045854),
                                         double3(-0.002079, 0.048952, 0.953127));

constexpr double kMired = 1e6 / 6504, kColdestMired = 1e6 / 25'000, kWarmestMired = 1e6 / 4000;
constexpr double kTintOfY = 0.04; // chromaticity for a tint of 1

/// Of the light that becomes white, in cones.
double3 whiteOf(double temperature, double tint) {
    const double mired = kMired - temperature * (temperature > 0 ? kMired - kColdestMired : kWarmestMired - kMired);
    double2 white = color::daylightChromaticity(1e6 / mired);
    white.y += tint * kTintOfY;
    return kConesFromXyz * double3(white.x / white.y, 1, (1 - white.x - white.y) / white.y);
}

/// As if the eye were used to another white. Von Kries' rule, in linear Rec. 2020.
double3x3 whiteBalance(double temperature, double tint) {
    if (temperature == 0 && tint == 0) return double3x3(1.0);
    const double3 scale = whiteOf(0, 0) / whiteOf(temperature, tint);
    const double3x3 cones = kConesFromXyz * kXyzFromRec2020;
    return glm::inverse(cones) * fromRows(double3(scale.x, 0, 0), double3(0, scale.y, 0), double3(0, 0, scale.z)) *
           cones;
}

} // namespace

double3x3 gradingMatrix(ColorGrading const& grading) {
    const double3x3 mixer = fromRows(grading.mixRed, grading.mixGreen, grading.mixBlue);
    return mixer * whiteBalance(static_cast<double>(grading.temperature), static_cast<double>(grading.tint)) *
           kRec2020FromRec709 * elementary::exp2(static_cast<double>(grading.exposure));
}

} // namespace filament_core
