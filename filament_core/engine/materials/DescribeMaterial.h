// SPDX-License-Identifier: Apache-2.0
/// describeMaterial: a package and the constants it was loaded with, as the public <filament_core/Material.h>.
///   Out     the author's declarations, without the compiler's own parameters.
///   Thread  pure.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/scene/Materials.h"

#include <filament_core/Material.h>

namespace filament_core::engine {

MaterialDescription describeMaterial(scene::Material const& material);

} // namespace filament_core::engine
