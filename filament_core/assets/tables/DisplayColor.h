// SPDX-License-Identifier: Apache-2.0
/// What a display shows of light: grading, tone mapper, look and transfer function on the CPU, by the shaders' own code
/// where they have a formula. For tone tables, looks and tools.
///   Thread  any; pure.   Fails: never.
#pragma once

#include <filament_core/DisplayTransform.h>
#include <filament_core/Effects.h>
#include <filament_core/Math.h>

namespace filament_core::assets {

/// Of one DisplayTransform and one ColorGrading, whose fields may be out of range.
class DisplayColor {
public:
    /// `grading`: null: none.
    explicit DisplayColor(DisplayTransform const& display, ColorGrading const* grading = nullptr);

    /// Linear Rec. 709 -> the values of the output space, which may leave [0, 1] with a look alone.
    float3 operator()(float3 light) const;

private:
    float3 mapped(float3 light) const;

    DisplayTransform mDisplay;
    ColorGrading mGrading;
    double3x3 mMix;
    bool mIsGraded;
};

} // namespace filament_core::assets
