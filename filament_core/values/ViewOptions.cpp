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

std::vector<Option> planes() {
    static constexpr std::array<std::string_view, SectionPlanes::kMost> kNames{ "section.plane1", "section.plane2",
                                                                                "section.plane3", "section.plane4",
                                                                                "section.plane5", "section.plane6" };
    std::vector<Option> all;
    for (std::string_view name : kNames) {
        const auto at = static_cast<uint32_t>(all.size() * sizeof(double4));
        all.push_back({ .name = name,
                        .description = "A [section plane](sections.md): what lies in front of it is kept; X,Y,Z: where "
                                       "its front is, W: metres from it to the origin if these are a unit vector. "
                                       "0: none.",
                        .kind = OptionKind::Number,
                        .components = 4,
                        .least = -kUnlimited,
                        .most = kUnlimited,
                        .unit = "X,Y,Z,W",
                        .storage = Option::Storage::Double,
                        .offset = offsetOf(&SectionPlanes::planes) + at });
    }
    return all;
}

} // namespace

template <>
std::span<const Option> optionsOf<SectionPlanes>() {
    using O = SectionPlanes;
    static const std::vector<Option> kOptions = [] {
        std::vector<Option> all = planes();
        all.push_back(option("section.cut", &O::cut,
                             "Several planes cut off what is behind each of them, or the corner behind all of them."));
        all.push_back(option("section.caps", &O::caps, "Closes solids where they are cut."));
        all.push_back(option("section.capColor", &O::capColor, { 0, 1, "R,G,B,A" },
                             "Base colour of caps; alpha: its share, the rest is that of each material."));
        all.push_back(option("section.hatchMeters", &O::hatchMeters, { 0, 1e6, "metres" },
                             "Distance of hatching lines on caps. 0: none."));
        all.push_back(option("section.hatchWidth", &O::hatchWidth, { 0, 1 }, "Share of a line of that distance."));
        all.push_back(option("section.hatchColor", &O::hatchColor, { 0, 1, "R,G,B" }, "Base colour of the lines."));
        return all;
    }();
    return kOptions;
}

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
        append(all, &View::section, optionsOf<SectionPlanes>());
        append(all, &View::display, optionsOf<DisplayTransform>());
        append(all, &View::quality, optionsOf<Quality>());
        append(all, &View::effects, optionsOf<Effects>());
        return all;
    }();
    return kOptions;
}

} // namespace filament_core
