// SPDX-License-Identifier: Apache-2.0
/// ShadowCounts: what fitting the shadow maps of a frame has found and left out. A plain value.
#pragma once

#include <cstdint>

namespace filament_core::prepare {

struct ShadowCounts {
    bool isOn = false;        ///< Quality::shadows
    uint32_t lights = 0;      ///< that shine into the view and may cast shadows
    uint32_t receivers = 0;   ///< objects in view that shadows can darken
    uint32_t casters = 0;     ///< objects in all maps
    uint32_t maps = 0;        ///< sampled in this frame
    uint32_t mapsDrawn = 0;   ///< of these, drawn in it
    bool isColorOn = false;   ///< Quality::coloredShadows
    uint32_t coloredMaps = 0; ///< of `maps`, those with a channel for each colour
    bool isShapeOn = false;   ///< Quality::areaShadows
    bool hasDepths = true;    ///< maps hold depths, not moments
    uint32_t areaMaps = 0;    ///< of `maps`, those of areas
    uint32_t mapsWithoutCasters = 0;
    uint32_t mapsOverBudget = 0; ///< beyond the atlas or kMaxShadowMaps
    friend bool operator==(ShadowCounts const&, ShadowCounts const&) = default;
};

} // namespace filament_core::prepare
