// SPDX-License-Identifier: Apache-2.0
/// A DisplayTransform as shaders/lib/tone.glsl reads it, and how exposure comes before vision at night. Values within
/// their ranges: clamped().
#pragma once

#include "base/math/Elementary.h"

#include <filament_core/DisplayTransform.h>
#include <filament_core/Effects.h>
#include <filament_core/Math.h>

#include <algorithm>
#include <cmath>

namespace filament_core {

/// kToneMap... of tone.glsl; DisplayColor.cpp checks the numbers. The look is that of AgX alone.
constexpr int32_t shaderToneMapper(ToneMapper mapper, AgxLook look) {
    if (mapper == ToneMapper::Agx && look == AgxLook::Golden) return 9;
    if (mapper == ToneMapper::Agx && look == AgxLook::Punchy) return 10;
    return static_cast<int32_t>(mapper);
}
inline int32_t shaderToneMapper(DisplayTransform const& display) {
    return shaderToneMapper(display.toneMapper, display.agxLook);
}

/// kOutput... of tone.glsl.
inline int32_t shaderOutputSpace(DisplayTransform const& display) { return static_cast<int32_t>(display.outputSpace); }

/// White as a share of what PQ encodes.
inline float whiteShareOf(DisplayTransform const& display) { return display.whiteNits / 10'000; }

/// Of toneMapGeneric(): c, a, b and the light that is white, so that f(midGreyIn) = midGreyOut and f(maximum) = 1.
inline float4 shaderToneCurve(ToneCurve const& curve) {
    const double c = static_cast<double>(curve.contrast), out = static_cast<double>(curve.midGreyOut);
    const double grey = elementary::pow(static_cast<double>(curve.midGreyIn), c);
    const double white = elementary::pow(static_cast<double>(curve.maximum), c);
    // b = white grey (1 - out) / (white out - grey); where that is no curve, nearly a power
    const double b = white * grey * (1 - out) / std::max(white * out - grey, 1e-3 * grey * (1 - out));
    return { c, 1 + b / white, b, static_cast<double>(curve.maximum) };
}

/// The light that the tone mapper displays at half of white, of grey: where displayWeight() of tone.glsl bends. False
/// colours have none; middle grey is in their middle.
inline float halfWhiteLight(DisplayTransform const& display) {
    switch (display.toneMapper) {
    case ToneMapper::Linear:
        return 0.5f;
    case ToneMapper::Aces:
        return 0.7085f;
    case ToneMapper::Filmic:
        return 0.356f;
    case ToneMapper::Mobile:
        return 0.402f;
    case ToneMapper::Agx:
        return display.agxLook == AgxLook::Base ? 0.686f : display.agxLook == AgxLook::Golden ? 0.681f : 1.036f;
    case ToneMapper::PbrNeutral:
        return 0.54f;
    case ToneMapper::AcesReference:
        return 0.691f;
    case ToneMapper::Generic: {
        const float4 curve = shaderToneCurve(display.toneCurve);
        return elementary::pow(0.5f * curve.z / (curve.y - 0.5f), 1 / curve.x);
    }
    case ToneMapper::DisplayRange:
        return 0.18f;
    }
    return 0.5f;
}

/// The factor of light before nightVision(): rods see what is exposed. Without them exposure is part of the matrix.
inline float exposureBeforeNight(ColorGrading const& grading) {
    return grading.nightAdaptation > 0 ? elementary::exp2(grading.exposure) : 1;
}

/// A row of a matrix, as dot products in shaders take it.
inline float3 shaderRow(double3x3 const& matrix, int i) { return float3(glm::transpose(matrix)[i]); }

/// gradingMatrix() of what comes after exposureBeforeNight().
inline double3x3 matrixAfterNight(ColorGrading const& grading) {
    ColorGrading rest = grading;
    if (grading.nightAdaptation > 0) rest.exposure = 0;
    return gradingMatrix(rest);
}

} // namespace filament_core
