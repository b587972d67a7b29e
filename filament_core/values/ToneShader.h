// SPDX-License-Identifier: Apache-2.0
/// A ColorGrading as shaders/lib/tone.glsl reads it, and how exposure comes before vision at night. Values within their
/// ranges: clamped().
#pragma once

#include <filament/ColorGrading.h>
#include <filament/Effects.h>
#include <filament/Math.h>

#include <algorithm>
#include <cmath>

namespace filament {

/// kToneMap... of tone.glsl.
inline int32_t shaderToneMapper(ColorGrading const& grading) {
    constexpr int32_t kGolden = 9, kPunchy = 10;
    if (grading.toneMapper == ToneMapper::Agx && grading.agxLook == AgxLook::Golden) return kGolden;
    if (grading.toneMapper == ToneMapper::Agx && grading.agxLook == AgxLook::Punchy) return kPunchy;
    return static_cast<int32_t>(grading.toneMapper);
}

/// kOutput... of tone.glsl.
inline int32_t shaderOutputSpace(ColorGrading const& grading) { return static_cast<int32_t>(grading.outputSpace); }

/// White as a share of what PQ encodes.
inline float whiteShareOf(ColorGrading const& grading) { return grading.whiteNits / 10'000; }

/// Of toneMapGeneric(): c, a, b and the light that is white, so that f(midGreyIn) = midGreyOut and f(maximum) = 1.
inline float4 shaderToneCurve(ToneCurve const& curve) {
    const double c = static_cast<double>(curve.contrast), out = static_cast<double>(curve.midGreyOut);
    const double grey = std::pow(static_cast<double>(curve.midGreyIn), c);
    const double white = std::pow(static_cast<double>(curve.maximum), c);
    // b = white grey (1 - out) / (white out - grey); where that is no curve, nearly a power
    const double b = white * grey * (1 - out) / std::max(white * out - grey, 1e-3 * grey * (1 - out));
    return { c, 1 + b / white, b, static_cast<double>(curve.maximum) };
}

/// The factor of light before nightVision(): rods see what is exposed. Without them exposure is part of the matrix.
inline float exposureBeforeNight(Grading const& grading) {
    return grading.nightAdaptation > 0 ? std::exp2(grading.exposure) : 1;
}

/// gradingMatrix() of what comes after exposureBeforeNight().
inline double3x3 matrixAfterNight(Grading const& grading) {
    Grading rest = grading;
    if (grading.nightAdaptation > 0) rest.exposure = 0;
    return gradingMatrix(rest);
}

} // namespace filament
