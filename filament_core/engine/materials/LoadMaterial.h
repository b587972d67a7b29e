// SPDX-License-Identifier: Apache-2.0
/// loadMaterial: the bytes of a package and the constants that an app gives -> a material without device objects.
///   Thread  pure.   Memory: the material, and the text of an error.
///   Fails   as readPackage(); NotFound for a constant that the material lacks, with the nearest name that it has;
///           InvalidArgument for one of another type.
#pragma once

#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament/Objects.h>

namespace filament::engine {

Result<scene::Material> loadMaterial(MaterialDesc const& desc);

} // namespace filament::engine
