// SPDX-License-Identifier: Apache-2.0
/// What a display shows of light: grading, tone mapper, look and transfer function on the CPU, by the shaders' own code
/// where they have a formula. For tone tables, looks and tools.
///   Thread  any; pure.   Fails: never.
#pragma once

#include <filament/ColorGrading.h>
#include <filament/Effects.h>
#include <filament/Math.h>

namespace filament::assets {

/// Of one ColorGrading and one Grading, whose fields may be out of range.
class DisplayColor {
public:
    /// `grading`: null: none.
    explicit DisplayColor(ColorGrading const& colorGrading, Grading const* grading = nullptr);

    /// Linear Rec. 709 -> the values of the output space, which may leave [0, 1] with a look alone.
    float3 operator()(float3 light) const;

private:
    float3 mapped(float3 light) const;

    ColorGrading mColorGrading;
    Grading mGrading;
    double3x3 mMix;
    bool mIsGraded;
};

} // namespace filament::assets
