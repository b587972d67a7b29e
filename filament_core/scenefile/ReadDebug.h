// SPDX-License-Identifier: Apache-2.0
/// "debug" of a scene file: what View::debugDraw shows. lines (from, to), boxes (min, max), spheres (at, radius), axes
/// (at, length), frustums (eye, at, fovDegrees, aspect, far), texts (at, text), and with "screen": true lines and texts
/// in pixels. Each has color, and width or pixels; "through": true shows it through surfaces.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/DebugDraw.h>

namespace filament_core::scenefile {

void readDebugDraw(JsonReader& reader, DebugDraw& draw);

} // namespace filament_core::scenefile
