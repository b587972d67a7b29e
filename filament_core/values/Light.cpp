// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Light.h>

#include <numbers>

namespace filament_core {
namespace {

Nits luminanceOf(Lumen flux, double area) {
    return { area > 0 ? static_cast<float>(double{ flux.value } / (std::numbers::pi * area)) : 0.0f };
}

} // namespace

Nits luminanceFromFlux(Lumen flux, RectLight const& light) {
    return luminanceOf(flux, double{ light.widthMeters } * double{ light.heightMeters } * (light.isTwoSided ? 2 : 1));
}

Nits luminanceFromFlux(Lumen flux, DiscLight const& light) {
    return luminanceOf(flux, std::numbers::pi * double{ light.radiusMeters } * double{ light.radiusMeters } *
                                     (light.isTwoSided ? 2 : 1));
}

Nits luminanceFromFlux(Lumen flux, TubeLight const& light) {
    return luminanceOf(flux, 2 * std::numbers::pi * double{ light.radiusMeters } * double{ light.lengthMeters });
}

} // namespace filament_core
