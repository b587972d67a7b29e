// SPDX-License-Identifier: Apache-2.0
// The position and size of the scene must not be visible: cameras and transforms are double, and shaders receive
// positions relative to the camera.
#include "tests/numerics/scenes/HardCase.h"

#include <fmt/format.h>

namespace filament_core::hard {
namespace {

struct Placed {
    double3 origin{ 0 };
    double scale = 1;
    bool lamp = true;
};

/// Two spheres, one metallic, one bumpy, and a floor; sun, sky and a lamp. All lengths follow `placed`.
void portrait(Stage& stage, Placed placed, Node node = {}) {
    const auto at = [&](double3 p, double size) {
        const double3 base = node ? double3(0) : placed.origin;
        return translation(base + p * placed.scale) * scaling(double3(size * placed.scale));
    };
    const auto put = [&](Mesh const& mesh, double4x4 const& local, Look const& look) {
        const Node own = node ? stage.scene.add(NodeDesc{ .parent = node, .parentFromNode = local }) : Node{};
        stage.add(mesh, own ? double4x4(1.0) : local, look, own);
    };
    put(sphereMesh(), at({ -0.7, 0, 0 }, 0.8), { .baseColor = { 0.8f, 0.2f, 0.1f, 1 }, .bumpy = true });
    put(sphereMesh(), at({ 0.9, -0.1, 0.3 }, 0.6), { .metallic = 1, .roughness = 0.25f });
    put(quadMesh(), at({ 0, 0, -1.5 }, 2), { .baseColor = { 0.2f, 0.3f, 0.6f, 1 }, .roughness = 0.9f });
    stage.scene.add(SunLight{ .directionWorld = { -0.4f, -0.7f, -1 } });
    const auto squared = static_cast<float>(placed.scale * placed.scale);
    if (placed.lamp)
        stage.scene.add(PointLight{ .positionWorld = placed.origin + double3(0.2, 1.2, 1.5) * placed.scale,
                                    .intensity = Candela{ 60'000 * squared },
                                    .rangeMeters = static_cast<float>(9 * placed.scale) });
    stage.addConstantSky(Lux{ 8'000 });
    stage.view.quality.shadows = ShadowFilter::Off; // widths of maps are rounded: their texels do not scale
    stage.view.camera =
            Camera::lookAt(placed.origin + double3(0.3, 0.6, 4) * placed.scale, placed.origin,
                           { .verticalFovDegrees = 45, .nearMeters = static_cast<float>(0.01 * placed.scale) });
}

HardCase farAway(double distance) {
    const double3 origin = double3(1, -0.5, 0.75) * distance + double3(0.37, 0.11, 0.73);
    return { .name = fmt::format("A scene {:.0e} m from the origin looks like the one there", distance),
             .scene = [=](Stage& stage) { portrait(stage, { .origin = origin }); },
             .twin = [](Stage& stage) { portrait(stage, {}); } };
}

// A chain of nodes that goes far away and half-way back: the object at its end is composed in double.
HardCase nodesFarAway() {
    const double3 away(1e7, -2e7, 3e7);
    return { .name = "Nodes that hang far from the origin look like renderables there",
             .scene =
                     [=](Stage& stage) {
                         const Node far = stage.scene.add(NodeDesc{ .parentFromNode = translation(away) });
                         const Node back =
                                 stage.scene.add(NodeDesc{ .parent = far, .parentFromNode = translation(-0.5 * away) });
                         portrait(stage, { .origin = 0.5 * away }, back);
                     },
             .twin = [](Stage& stage) { portrait(stage, {}); } };
}

HardCase scaled(double scale) {
    const bool lamp = scale > 0.01; // a lamp nearer than a centimetre shines as from a centimetre: light.glsl
    return { .name = fmt::format("A scene of scale {:.0e} looks like the one of scale 1", scale),
             .scene = [=](Stage& stage) { portrait(stage, { .scale = scale, .lamp = lamp }); },
             .twin = [=](Stage& stage) { portrait(stage, { .lamp = lamp }); } };
}

HardCase scaledFarAway() {
    return { .name = "A small scene far from the origin looks like the one there",
             .scene =
                     [](Stage& stage) {
                         portrait(stage, { .origin = { 1e5, 2e5, -1e5 }, .scale = 0.125 });
                     },
             .twin = [](Stage& stage) { portrait(stage, { .scale = 0.125 }); } };
}

} // namespace

std::vector<HardCase> distanceRows() {
    std::vector<HardCase> rows;
    for (double distance : { 0.0, 1e3, 1e5, 1e7 }) rows.push_back(farAway(distance));
    rows.push_back(nodesFarAway());
    rows.push_back(scaledFarAway());
    for (double scale : { 1e-6, 1e-3, 1e-1, 1e1, 1e3, 1e6 }) rows.push_back(scaled(scale));
    return rows;
}

} // namespace filament_core::hard
