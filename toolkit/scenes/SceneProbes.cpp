// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneProbes.h"

#include "toolkit/scenes/BoxFields.h"

#include <algorithm>

namespace filament_core::tools {

void readProbe(JsonReader& reader, ProbeSpec& probe) {
    ReflectionProbeDesc& place = probe.place;
    readBox(reader, place);
    reader.read("capture", place.captureInBoxMeters);
    reader.read("intensity", place.intensity, 0, 1e9);
    reader.read("diffuse", place.lightsDiffuse);
    reader.read("name", place.name);
    reader.read("file", probe.file);
    const float3 half = place.halfExtentMeters, capture = glm::abs(place.captureInBoxMeters);
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
