// SPDX-License-Identifier: Apache-2.0
#include <filament_core/View.h>

#include "filament_core/values/OptionRows.h"

#include <span>
#include <vector>

namespace filament_core {

namespace {

Option lodPixels() {
    static constexpr std::array<std::string_view, 5> kPixels{ "0", "0.5", "1", "2", "4" };
    Option pixels = option("lod.pixels", &LevelsOfDetail::pixels,
                           { 0, static_cast<double>(LevelsOfDetail::kMostPixels), "pixels", kPixels },
                           "Largest error of [levels of detail](levels-of-detail.md) in the image; 0: the finest.");
    pixels.offset += offsetOf(&View::lod);
    return pixels;
}

} // namespace

template <>
std::span<const Option> optionsOf<View>() {
    static const std::vector<Option> kOptions = [] {
        static constexpr std::array<std::string_view, 2> kSamples{ "1", "4" };
        std::vector<Option> all{ option("samples", &View::samples, { 1, 4, {}, kSamples, true },
                                        "Samples a pixel: multisample anti-aliasing."),
                                 option("occlusionCulling", &View::occlusionCulling,
                                        "Leaves out opaque objects behind occluders; the image has the same bits."),
                                 lodPixels(),
                                 option("debugView", &View::debugView,
                                        "Shows one ingredient of the image: [debug views](debug-views.md).") };
        append(all, &View::display, optionsOf<DisplayTransform>());
        append(all, &View::quality, optionsOf<Quality>());
        append(all, &View::effects, optionsOf<Effects>());
        return all;
    }();
    return kOptions;
}

} // namespace filament_core
