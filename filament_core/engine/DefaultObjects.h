// SPDX-License-Identifier: Apache-2.0
/// Objects of every engine: white texture, black cube, split-sum table, instance indices.
#pragma once

#include "filament_core/engine/EngineImpl.h"

namespace filament_core {

void createDefaultObjects(Engine::Impl& engine);
/// Also the engine's own materials. Afterwards only objects remain that the user did not destroy.
void destroyDefaultObjects(Engine::Impl& engine);

} // namespace filament_core
