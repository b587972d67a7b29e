// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadProbe.h"

#include "filament_core/scenefile/BoxFields.h"

namespace filament_core::scenefile {

void readProbe(JsonReader& reader, SceneFileProbe& probe) {
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

} // namespace filament_core::scenefile
