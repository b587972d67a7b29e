// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneProbes.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace filament_core::tools {

void readProbe(JsonReader& reader, ProbeSpec& probe) {
    ReflectionProbeDesc& place = probe.place;
    reader.read("at", place.centerWorld);
    reader.read("halfExtent", place.halfExtentMeters);
    double3 degrees(0.0);
    reader.read("degrees", degrees);
    double4x4 world(1.0); // as copies of the model turn
    world = glm::rotate(world, glm::radians(degrees.y), double3(0, 1, 0));
    world = glm::rotate(world, glm::radians(degrees.x), double3(1, 0, 0));
    world = glm::rotate(world, glm::radians(degrees.z), double3(0, 0, 1));
    place.worldFromBox = float3x3(double3x3(world));
    reader.read("blend", place.blendMeters, 0, 1e9);
    reader.read("capture", place.captureInBoxMeters);
    reader.read("intensity", place.intensity, 0, 1e9);
    reader.read("diffuse", place.lightsDiffuse);
    reader.read("name", place.name);
    reader.read("file", probe.file);
    const float3 half = place.halfExtentMeters, capture = glm::abs(place.captureInBoxMeters);
    if (!(half.x > 0 && half.y > 0 && half.z > 0) || std::max({ half.x, half.y, half.z }) > 1e9f)
        reader.complain("halfExtent", "expected three numbers of (0, 1e9]");
    if (!(capture.x < half.x && capture.y < half.y && capture.z < half.z))
        reader.complain("capture", "expected a place inside of the box");
}

Result<std::shared_ptr<Environment>> capturedLight(Engine& engine, Scene const& scene, ProbeSpec& probe,
                                                   View const& view, EnvironmentLoadOptions const& options) {
    ProbeCaptureOptions how{ .faceSize = std::max(64u, options.faceSize), .view = view };
    Result<ProbeCapture> captured = captureProbe(engine, scene, probe.place, how);
    if (!captured) return captured.error();
    probe.place.intensity *= captured->intensity;
    Result<Environment> light = loadEnvironment(engine, captured->ktx2, "captured probe", options);
    if (!light) return light.error();
    return std::make_shared<Environment>(std::move(*light));
}

} // namespace filament_core::tools
