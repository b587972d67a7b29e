// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/BuiltLight.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace filament_core::tools {
namespace {

using assets::CubeLight;
using assets::IblCubeLevel;

constexpr uint32_t kPieces = 128;

/// Radiance of the room: walls are lighter at the top, lamps are 8 to 28 times as bright as they.
float3 roomTowards(float3 direction) {
    constexpr std::array<float3, 6> kWalls{ float3(0.50f, 0.14f, 0.10f), float3(0.10f, 0.36f, 0.42f),
                                            float3(0.55f, 0.62f, 0.80f), float3(0.20f, 0.14f, 0.09f),
                                            float3(0.18f, 0.40f, 0.14f), float3(0.34f, 0.16f, 0.44f) };
    constexpr std::array<float3, 6> kLamps{ float3(14, 12, 9), float3(6, 8, 10), float3(10, 10, 10),
                                            float3(3, 2, 1),   float3(9, 7, 4),  float3(7, 7, 9) };
    const assets::CubePoint point = assets::cubeFromDirection(direction);
    const float sink = 0.06f * static_cast<float>(point.face);
    const bool isLamp = point.s > -0.6f && point.s < -0.2f && point.t > -0.5f + sink && point.t < 0.1f + sink;
    return isLamp ? kLamps[point.face] : kWalls[point.face] * (1 - 0.4f * point.t);
}

/// In the extension's cube, whose z is glTF's turned round.
IblCubeLevel roomOf(uint32_t size) {
    IblCubeLevel level(size);
    for (uint32_t i = 0; i < 6 * size * size; ++i) {
        const uint32_t face = i / (size * size);
        const int x = static_cast<int>(i % size), y = static_cast<int>(i / size % size);
        const float3 inCube =
                assets::directionFromCube({ face, assets::faceCoordinate(x, size), assets::faceCoordinate(y, size) });
        const float3 light = roomTowards({ inCube.x, inCube.y, -inCube.z });
        level.at(face, x, y) = assets::Texel{ light.x, light.y, light.z, 0 };
    }
    level.fillBorder();
    return level;
}

CubeLight filtered(IblCubeLevel const& room, uint32_t levels) {
    jobs::JobSystem jobs({ .workers = 0 });
    CubeLight light{ .irradianceSh = assets::irradianceSh(room, jobs) };
    assets::IblCube cube{ room };
    while (cube.back().size() > 1) cube.push_back(assets::halved(cube.back(), jobs));
    light.levels = levels == 1
                           ? std::vector{ room }
                           : assets::prefilterSpecular(cube, room.size(), kPieces, jobs, {}, RoughnessMapping::Linear);
    return light;
}

} // namespace

void addBuiltLight(JsonReader& reader, assets::GlbScene& scene) {
    uint32_t size = 64;
    reader.read("size", size, 4, 256);
    if (!std::has_single_bit(size)) {
        reader.complain("size", "expected a power of two");
        size = 64;
    }
    const uint32_t all = assets::specularLevelCount(size);
    uint32_t levels = all;
    reader.read("levels", levels, 1, all);
    if (levels != 1 && levels != all) reader.complain("levels", "expected 1 or all");
    double3 degrees(0.0);
    reader.read("degrees", degrees);
    float intensity = 1;
    reader.read("intensity", intensity, 0, 1e6);

    CubeLight light = filtered(roomOf(size), levels);
    double4x4 turn = glm::rotate(double4x4(1.0), glm::radians(degrees.y), double3(0, 1, 0));
    turn = glm::rotate(turn, glm::radians(degrees.x), double3(1, 0, 0));
    turn = glm::rotate(turn, glm::radians(degrees.z), double3(0, 0, 1));
    light.worldFromCube = float3x3(double3x3(turn) * double3x3(double3(1, 0, 0), double3(0, 1, 0), double3(0, 0, -1)));
    auto written = assets::glbImageBasedLight(light, scene.images);
    if (!written) return reader.complain("size", written.error().message);
    written->name = "room";
    written->intensity = intensity;
    scene.imageBasedLight = std::move(*written);
}

} // namespace filament_core::tools
