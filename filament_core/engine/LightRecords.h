// SPDX-License-Identifier: Apache-2.0
/// LightRecords: lights as apps describe them -> as scenes keep them. Directions and axes become unit vectors.
///   Fails   a value out of the range that <filament_core/Light.h> gives ends the process.
///   Thread  the app thread.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <filament_core/Light.h>

namespace filament_core::engine {

scene::LightRecord recordOf(Engine::Impl const& engine, LightDesc const& light);

} // namespace filament_core::engine
