// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/DisplayColor.h"

#include "filament_core/values/AcesReference.h"
#include "filament_core/values/ToneShader.h"
#include "shaders/lib/LibCpp.h"

#include <filament_core/Look.h>
#include <filament_core/Options.h>

namespace filament_core::assets {

namespace lib = shader::lib;

namespace {

constexpr bool isNumbered(ToneMapper mapper, int inShaders, AgxLook look = AgxLook::Base) {
    return shaderToneMapper(mapper, look) == inShaders;
}

static_assert(isNumbered(ToneMapper::Linear, lib::kToneMapLinear) && isNumbered(ToneMapper::Aces, lib::kToneMapAces) &&
              isNumbered(ToneMapper::Filmic, lib::kToneMapFilmic) &&
              isNumbered(ToneMapper::Mobile, lib::kToneMapMobile) && isNumbered(ToneMapper::Agx, lib::kToneMapAgx) &&
              isNumbered(ToneMapper::Agx, lib::kToneMapAgxGolden, AgxLook::Golden) &&
              isNumbered(ToneMapper::Agx, lib::kToneMapAgxPunchy, AgxLook::Punchy) &&
              isNumbered(ToneMapper::PbrNeutral, lib::kToneMapPbrNeutral) &&
              isNumbered(ToneMapper::AcesReference, lib::kToneMapAcesReference) &&
              isNumbered(ToneMapper::Generic, lib::kToneMapGeneric) &&
              isNumbered(ToneMapper::DisplayRange, lib::kToneMapDisplayRange));
static_assert(static_cast<int>(OutputSpace::Srgb) == lib::kOutputSrgb &&
              static_cast<int>(OutputSpace::LinearRec709) == lib::kOutputLinearRec709 &&
              static_cast<int>(OutputSpace::DisplayP3) == lib::kOutputDisplayP3 &&
              static_cast<int>(OutputSpace::Rec2020Pq) == lib::kOutputRec2020Pq);

lib::Grading asInShaders(ColorGrading const& grading, double3x3 const& mix) {
    lib::Grading values;
    values.nightAdaptation = grading.nightAdaptation;
    values.mixRed = shaderRow(mix, 0), values.mixGreen = shaderRow(mix, 1), values.mixBlue = shaderRow(mix, 2);
    values.shadows = grading.shadows, values.midtones = grading.midtones, values.highlights = grading.highlights;
    values.tonalRanges = grading.tonalRanges;
    values.slope = grading.slope, values.offset = grading.offset, values.power = grading.power;
    values.contrast = grading.contrast, values.saturation = grading.saturation, values.vibrance = grading.vibrance;
    values.shadowGamma = grading.shadowGamma, values.midPoint = grading.midPoint;
    values.highlightScale = grading.highlightScale;
    values.mapsGamut = grading.gamutMapping;
    return values;
}

lib::ToneSettings asInShaders(DisplayTransform const& display) {
    return lib::toneSettings(shaderToneMapper(display), shaderToneCurve(display.toneCurve), shaderOutputSpace(display),
                             whiteShareOf(display));
}

float3 finiteOf(float3 light) { return glm::clamp(light, float3(0), float3(1e4f)); }

} // namespace

DisplayColor::DisplayColor(DisplayTransform const& display, ColorGrading const* grading)
        : mDisplay(clamped(display)), mGrading(grading ? *grading : ColorGrading{}), mMix(matrixAfterNight(mGrading)),
          mIsGraded(grading != nullptr) {}

float3 DisplayColor::operator()(float3 light) const {
    if (!mIsGraded) return mapped(light);
    return mapped(lib::graded(light * exposureBeforeNight(mGrading), asInShaders(mGrading, mMix)));
}

float3 DisplayColor::mapped(float3 light) const {
    lib::ToneSettings tone = asInShaders(mDisplay);
    const bool isReference = mDisplay.toneMapper == ToneMapper::AcesReference;
    if (!isReference && !mDisplay.look) return lib::displayColor(light, tone);
    const int space = tone.space;
    tone.space = lib::kOutputSrgb;
    float3 color = isReference ? lib::srgbFromLinear(float3(acesReference(double3(finiteOf(light)))))
                               : lib::displayColor(light, tone);
    if (mDisplay.look) color = lookedUp(*mDisplay.look, color);
    if (space == lib::kOutputSrgb) return color;
    tone.space = space;
    return lib::encodedForDisplay(lib::linearFromSrgb(lib::saturate(color)), tone);
}

} // namespace filament_core::assets
