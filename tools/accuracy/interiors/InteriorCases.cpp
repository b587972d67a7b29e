// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/interiors/InteriorCases.h"

#include <array>

namespace filament_core::accuracy {
namespace {

constexpr std::array<const char*, kLightTechniques> kNames{ "environment",     "probes",   "grid",
                                                            "grid and probes", "lightmap", "lightmap and probes" };

InteriorCase cornell() {
    InteriorCase made{ .name = "cornell", .title = "Cornell box", .room = interiors::cornellBox() };
    made.cameras = made.room->cameras;
    made.grid = { { 0, 1, 0 }, float3(1.05f) };
    made.probes = { { { 0, 1, 0 }, float3(1.02f) } };
    made.texelsPerMeter = 24;
    made.gridSpacing = 0.5;
    return made;
}

InteriorCase gallery() {
    InteriorCase made{ .name = "gallery", .title = "Gallery", .room = interiors::gallery() };
    made.cameras = made.room->cameras;
    made.exposure = { .aperture = 5.6f, .shutterSeconds = 1.0f / 60, .iso = 200 };
    made.grid = { made.room->center, float3(made.room->halfExtent) + 0.1f };
    made.probes = { { made.room->center, float3(made.room->halfExtent) + 0.1f } };
    made.texelsPerMeter = 8;
    return made;
}

/// The same room with walls in panels of a metre, each with a field of light of its own.
InteriorCase galleryInPanels() {
    InteriorCase made = gallery();
    made.name = "gallery-panels";
    made.title = "Gallery, walls in panels of 1 m";
    made.room = interiors::gallery({ .panelMeters = 1 });
    made.room->model.name = made.name;
    return made;
}

/// Its rooms are painted boxes, so cameras stand below its awnings. A unit is about 2 cm.
InteriorCase tokyo() {
    InteriorCase made{ .name = "tokyo", .title = "LittlestTokyo, below its awnings" };
    made.asset = "models/LittlestTokyo/LittlestTokyo.glb";
    made.environment = "environments/spiaggia_di_mondello_1k.hdr";
    made.without = "outline";
    made.cameras = { { { -20, -150, 180 }, { -140, -160, 0 }, 60 },
                     { { -60, -150, 190 }, { -140, -150, 20 }, 60 },
                     { { -40, -160, 100 }, { 20, -150, -100 }, 60 },
                     { { -30, -130, 150 }, { -30, -160, 20 }, 60 },
                     { { -100, -160, 200 }, { 0, -150, 40 }, 60 } };
    made.exposure = { .aperture = 8, .shutterSeconds = 1.0f / 125, .iso = 100 };
    made.grid = { { -85, 0, -25 }, { 280, 230, 280 } };
    made.probes = { { { -20, -120, 130 }, { 120, 90, 90 } } };
    made.texelsPerMeter = 0.8;
    made.texelSamples = 32;
    made.gridSpacing = 50;
    return made;
}

} // namespace

const char* toString(LightTechnique technique) { return kNames[static_cast<size_t>(technique)]; }

std::vector<InteriorCase> interiorCases() { return { cornell(), gallery(), galleryInPanels(), tokyo() }; }

} // namespace filament_core::accuracy
