// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Light.h>

#include "filament_core/values/OptionRows.h"

#include <numbers>
#include <span>
#include <vector>

namespace filament_core {
namespace {

using Rows = std::vector<Option>;

constexpr double kBrightest = 1e12, kLargestColor = 1e9, kLargestSize = 1e9, kFarthest = 3e38;
constexpr std::string_view kDirection = "X,Y,Z";

/// What all lights have.
template <class L>
Rows sharedRows() {
    return { option("color", &L::color, { 0, kLargestColor, "R,G,B" }, "Linear colour."),
             option("castsShadows", &L::castsShadows, "Casts shadows."),
             option("lightChannels", &L::lightChannels, { 0, 255 }, "Bits of the channels that it lights.") };
}

/// Where a light is, and how far it reaches.
template <class L>
void addPlace(Rows& rows) {
    rows.push_back(option("positionWorld", &L::positionWorld, { -kUnlimited, kUnlimited, kDirection }, "Position."));
    rows.push_back(option("rangeMeters", &L::rangeMeters, { 0, kFarthest, "metres" },
                          "The light is zero beyond; 0: unlimited."));
}

template <class L>
void addDirection(Rows& rows) {
    rows.push_back(option("directionWorld", &L::directionWorld, { -kFarthest, kFarthest, kDirection },
                          "Direction in which the light travels; not zero."));
}

/// Of points and spots.
template <class L>
Rows punctualRows() {
    Rows rows = sharedRows<L>();
    addPlace<L>(rows);
    addDirection<L>(rows);
    rows.push_back(option("intensity", &L::intensity, { 0, kBrightest, "cd" }, "Luminous intensity."));
    rows.push_back(option("sourceRadiusMeters", &L::sourceRadiusMeters, { 0, kFarthest, "metres" },
                          "Radius of the source, for soft shadows."));
    rows.push_back(option("contactShadows", &L::contactShadows, "Casts contact shadows."));
    rows.push_back(option("upWorld", &L::upWorld, { -kFarthest, kFarthest, kDirection }, "Turns a light profile."));
    return rows;
}

/// Of rectangles, discs and tubes.
template <class L>
Rows areaRows() {
    Rows rows = sharedRows<L>();
    addPlace<L>(rows);
    rows.push_back(option("luminance", &L::luminance, { 0, kBrightest, "cd/m^2" }, "Luminance of the surface."));
    rows.push_back(option("isVisible", &L::isVisible, "Draws the light itself."));
    return rows;
}

template <class L>
Option size(std::string_view name, float L::*member, std::string_view description) {
    return option(name, member, { 0, kLargestSize, "metres" }, description);
}

} // namespace

template <>
std::span<const Option> optionsOf<SunLight>() {
    static const Rows kOptions = [] {
        using L = SunLight;
        Rows rows = sharedRows<L>();
        addDirection<L>(rows);
        rows.push_back(option("illuminance", &L::illuminance, { 0, kBrightest, "lx" },
                              "Illuminance of a surface that faces the sun."));
        rows.push_back(option("angularRadiusDegrees", &L::angularRadiusDegrees, { 0, 20, "degrees" },
                              "Half of its diameter in the sky: softness of shadows, size of the disc."));
        rows.push_back(option("showsDisc", &L::showsDisc, "Draws its disc and halo in the sky."));
        rows.push_back(option("haloSize", &L::haloSize, { 1, 1000 }, "Radius of the halo, of that of the disc."));
        rows.push_back(option("haloFalloff", &L::haloFalloff, { 0, 1e4 }, "Exponent by which the halo fades."));
        rows.push_back(
                option("contactShadows", &L::contactShadows, "Casts [contact shadows](shadows.md#contact-shadows)."));
        return rows;
    }();
    return kOptions;
}

template <>
std::span<const Option> optionsOf<PointLight>() {
    static const Rows kOptions = punctualRows<PointLight>();
    return kOptions;
}

template <>
std::span<const Option> optionsOf<SpotLight>() {
    static const Rows kOptions = [] {
        using L = SpotLight;
        Rows rows = punctualRows<L>();
        const OptionRange cone{ 0, std::numbers::pi / 2, "radians" };
        rows.push_back(option("innerConeRadians", &L::innerConeRadians, cone, "Half angle of full intensity."));
        rows.push_back(option("outerConeRadians", &L::outerConeRadians, cone, "Half angle where the light ends."));
        return rows;
    }();
    return kOptions;
}

template <>
std::span<const Option> optionsOf<RectLight>() {
    static const Rows kOptions = [] {
        using L = RectLight;
        Rows rows = areaRows<L>();
        addDirection<L>(rows);
        rows.push_back(option("upWorld", &L::upWorld, { -kFarthest, kFarthest, kDirection }, "Along its height."));
        rows.push_back(size("widthMeters", &L::widthMeters, "Width."));
        rows.push_back(size("heightMeters", &L::heightMeters, "Height."));
        rows.push_back(option("isTwoSided", &L::isTwoSided, "Also shines against its direction."));
        return rows;
    }();
    return kOptions;
}

template <>
std::span<const Option> optionsOf<DiscLight>() {
    static const Rows kOptions = [] {
        using L = DiscLight;
        Rows rows = areaRows<L>();
        addDirection<L>(rows);
        rows.push_back(size("radiusMeters", &L::radiusMeters, "Radius."));
        rows.push_back(option("isTwoSided", &L::isTwoSided, "Also shines against its direction."));
        return rows;
    }();
    return kOptions;
}

template <>
std::span<const Option> optionsOf<TubeLight>() {
    static const Rows kOptions = [] {
        using L = TubeLight;
        Rows rows = areaRows<L>();
        rows.push_back(option("axisWorld", &L::axisWorld, { -kFarthest, kFarthest, kDirection },
                              "Direction of its axis; not zero."));
        rows.push_back(size("lengthMeters", &L::lengthMeters, "Length."));
        rows.push_back(size("radiusMeters", &L::radiusMeters, "Radius."));
        return rows;
    }();
    return kOptions;
}

} // namespace filament_core
