// SPDX-License-Identifier: Apache-2.0
/// DisplayTransform: how scene-referred light becomes the values of a display, as a plain value; part of View.
/// docs/finish.md has the formulas. ColorGrading of Effects.h comes before it.
///   Names    each field but `look` is an option (Options.h): "toneCurve.contrast".
///   Thread   any.
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/OutputSpace.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

namespace filament_core {

struct Look; // Look.h

enum class ToneMapper : uint8_t {
    Linear,        ///< clamp to [0, 1]
    Aces,          ///< Hill's fit of the ACES transforms: highlights desaturate
    Filmic,        ///< Narkowicz 2015, the ACES curve per component
    Mobile,        ///< x / (x + 0.155) * 1.019: includes the transfer function
    Agx,           ///< Sobotka's AgX: bright colours fade to white without a shift of hue; agxLook
    PbrNeutral,    ///< Khronos PBR Neutral: base colours stay as authored, only highlights are compressed
    AcesReference, ///< the ACES 1.x transforms themselves, for a Rec. 709 display of 100 cd/m^2; always by a table
    Generic,       ///< a curve per component: toneCurve
    DisplayRange,  ///< false colours: how many stops a pixel is from middle grey, for judging exposure
};
template <>
struct EnumNames<ToneMapper> {
    static constexpr std::array<std::string_view, 9> values{ "linear",        "aces",    "filmic",
                                                             "mobile",        "agx",     "pbrNeutral",
                                                             "acesReference", "generic", "displayRange" };
};

/// What AgX ends with.
enum class AgxLook : uint8_t {
    Base,
    Golden, ///< warmer and paler
    Punchy, ///< more contrast and chroma
};
template <>
struct EnumNames<AgxLook> {
    static constexpr std::array<std::string_view, 3> values{ "base", "golden", "punchy" };
};

/// ToneMapper::Generic: a x^c / (x^c + b), where c is the contrast, middle grey goes from `midGreyIn` to `midGreyOut`
/// and `maximum` becomes white. Where no such curve exists (a low contrast with a low maximum), middle grey is darker.
struct ToneCurve {
    float contrast = 1.55f;    ///< exponent, [0.1, 5]
    float midGreyIn = 0.18f;   ///< light, [0.001, 1]
    float midGreyOut = 0.215f; ///< light of the display, [0.001, 0.99]
    float maximum = 10;        ///< light, [1, 256]
    friend bool operator==(ToneCurve const&, ToneCurve const&) = default;
};

struct DisplayTransform {
    ToneMapper toneMapper = ToneMapper::Aces;
    bool dither = false; ///< adds interleaved gradient noise of one least significant bit before rounding to 8 bits
    AgxLook agxLook = AgxLook::Base;
    ToneCurve toneCurve{};
    OutputSpace outputSpace = OutputSpace::Srgb;
    float whiteNits = 203;            ///< cd/m^2 of white with Rec2020Pq, [80, 10 000]; 203 is that of ITU-R BT.2408
    std::shared_ptr<const Look> look; ///< applied to sRGB display values, after the tone mapper; null: none
    friend bool operator==(DisplayTransform const&, DisplayTransform const&) = default;
};

} // namespace filament_core
