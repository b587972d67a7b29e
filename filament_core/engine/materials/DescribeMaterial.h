// SPDX-License-Identifier: Apache-2.0
/// describeMaterial: a package and the constants that it was loaded with, as the public <filament/Material.h>.
///   Out     what the author declared; the compiler's own parameters are left out.
///   Thread  pure.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/scene/Materials.h"

#include <filament/Material.h>

namespace filament::engine {

MaterialDescription describeMaterial(scene::Material const& material);

} // namespace filament::engine
