// SPDX-License-Identifier: Apache-2.0
/// SceneProbes: the reflection probes of a scene file, and what they see.
///   Fields  "at", "halfExtent", "degrees" of the box; "blend" in metres; "capture": where in the box the cube was
///           captured; "intensity", "diffuse", "name" (ReflectionProbe.h); "file": named as an environment's, along the
///           axes of the box. Without a file the engine captures the scene, without its probes.
///   Fails   as JsonReader; errors of loading and capturing.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filament_core/Environment.h>
#include <filament_core/ProbeCapture.h>

#include <memory>
#include <string>

namespace filament_core::tools {

struct ProbeSpec {
    ReflectionProbeDesc place{}; ///< without its light
    std::string file;            ///< empty: captured
};

void readProbe(JsonReader& reader, ProbeSpec& probe);

/// What the engine sees from the place of a probe, filtered. `view`: as it is drawn; multiplies the place's intensity.
Result<std::shared_ptr<Environment>> capturedLight(Engine& engine, Scene const& scene, ProbeSpec& probe,
                                                   View const& view, EnvironmentLoadOptions const& options);

} // namespace filament_core::tools
