// SPDX-License-Identifier: Apache-2.0
/// readBox: the box of a reflection probe or of an irradiance grid in a JSON file.
///   Fields  "at": its centre, "halfExtent": half of each side, "blend": the blend distance, in metres; "degrees": how
///           it is turned, as copies of models are.
///   Fails   as JsonReader; sides that are not in (0, 2e9] m.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace filament_core::scenefile {

/// Box: ReflectionProbeDesc or IrradianceGridDesc.
template <class Box>
void readBox(JsonReader& reader, Box& box) {
    reader.read("at", box.centerWorld);
    reader.read("halfExtent", box.halfExtentMeters);
    double3 degrees(0.0);
    reader.read("degrees", degrees);
    double4x4 world(1.0);
    world = glm::rotate(world, glm::radians(degrees.y), double3(0, 1, 0));
    world = glm::rotate(world, glm::radians(degrees.x), double3(1, 0, 0));
    world = glm::rotate(world, glm::radians(degrees.z), double3(0, 0, 1));
    box.worldFromBox = float3x3(double3x3(world));
    reader.read("blend", box.blendMeters, 0, 1e9);
    const float3 half = box.halfExtentMeters;
    if (!(half.x > 0 && half.y > 0 && half.z > 0) || std::max({ half.x, half.y, half.z }) > 1e9f)
        reader.complain("halfExtent", "expected three numbers of (0, 1e9]");
}

} // namespace filament_core::scenefile
