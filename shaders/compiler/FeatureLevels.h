// SPDX-License-Identifier: Apache-2.0
/// checkFeatureLevel: checks that the author's code uses only what its featureLevel guarantees (materials guide, table
/// 13).
///   Level 1 is ESSL 3.00: functions that came with ESSL 3.10 need level 2. Samplers are counted by DefinitionRules.
///   In      the blocks themselves, without included files.   Thread  any.
///   Fails   InvalidArgument at the line of the word.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament_core::shader {

Result<void> checkFeatureLevel(MaterialDefinition const& definition);

} // namespace filament_core::shader
