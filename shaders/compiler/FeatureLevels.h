// SPDX-License-Identifier: Apache-2.0
/// checkFeatureLevel: does the author's code keep to what its featureLevel guarantees (materials guide, table 13)?
///   Level 1 is ESSL 3.00: functions that came with ESSL 3.10 need level 2. Samplers are counted by DefinitionRules.
///   In      the blocks themselves, not what they include.   Thread  any.
///   Fails   InvalidArgument, at the line of the word.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

Result<void> checkFeatureLevel(MaterialDefinition const& definition);

} // namespace filament::shader
