// SPDX-License-Identifier: Apache-2.0
#include <filament_core/DisplayTransform.h>

#include "filament_core/values/OptionRows.h"

#include <span>
#include <vector>

namespace filament_core {
namespace {

std::vector<Option> toneCurveRows() {
    using C = ToneCurve;
    return { option("toneCurve.contrast", &C::contrast, { 0.1, 5 }, "Exponent of the `generic` tone mapper."),
             option("toneCurve.midGreyIn", &C::midGreyIn, { 0.001, 1 }, "Scene light that becomes `midGreyOut`."),
             option("toneCurve.midGreyOut", &C::midGreyOut, { 0.001, 0.99 }, "Display light of middle grey."),
             option("toneCurve.maximum", &C::maximum, { 1, 256 }, "Scene light that becomes white.") };
}

} // namespace

template <>
std::span<const Option> optionsOf<DisplayTransform>() {
    static const std::vector<Option> kOptions = [] {
        using G = DisplayTransform;
        std::vector<Option> all{ option("toneMapper", &G::toneMapper, "Maps scene light to display light."),
                                 option("dither", &G::dither, "Adds noise of one bit before rounding to 8 bits."),
                                 option("agxLook", &G::agxLook, "Look of the `agx` tone mapper.") };
        append(all, &G::toneCurve, toneCurveRows());
        all.push_back(option("outputSpace", &G::outputSpace, "Colour space of display values."));
        all.push_back(option("whiteNits", &G::whiteNits, { 80, 10'000, "cd/m^2" }, "White of `rec2020Pq`."));
        return all;
    }();
    return kOptions;
}

} // namespace filament_core
