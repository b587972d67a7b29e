// SPDX-License-Identifier: Apache-2.0
/// The objects that every engine has: white texture, black cube, split-sum table, instance indices.
#pragma once

#include "filament_core/engine/EngineImpl.h"

namespace filament {

void createDefaultObjects(Engine::Impl& engine);
/// Also the engine's own materials. Afterwards only what the user forgot is left.
void destroyDefaultObjects(Engine::Impl& engine);

} // namespace filament
