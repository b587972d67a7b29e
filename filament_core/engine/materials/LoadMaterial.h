// SPDX-License-Identifier: Apache-2.0
/// loadMaterial: turns the bytes of a package and the app's constants into a material without device objects.
///   Thread  pure.   Memory: the material, and the text of an error.
///   Fails   as readPackage() and, for packages that are not part of this program, checkSpirv(); NotFound, with the
///           nearest name, for a constant that the material lacks; InvalidArgument for a constant of another type.
///   Cost    20 to 40 ms for one of glTF's packages, nearly all of it unpackMaterial(): unpack a package once
///           for several materials.
#pragma once

#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/Objects.h>

namespace filament_core::engine {

Result<scene::Material> loadMaterial(MaterialDesc const& desc);

/// Its two halves: the package, and one material of it.
Result<shader::MaterialPackage> unpackMaterial(MaterialDesc const& desc);
Result<scene::Material> specialiseMaterial(shader::MaterialPackage package, MaterialDesc const& desc);

/// Whether a device that samples `units` textures a stage can draw it (shaders/interface/SamplerBudget.h).
///   Fails   Unsupported, naming the material, what it needs and what `device` has.
Result<void> checkSamplers(scene::Material const& material, uint32_t units, std::string_view device);

} // namespace filament_core::engine
