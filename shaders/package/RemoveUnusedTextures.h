// SPDX-License-Identifier: Apache-2.0
/// removeUnusedTextures: removes the textures that the constants of a loaded material switch off (Parameter::usedIf).
///   Why     A fragment stage has few samplers (shaders/interface/SamplerBudget.h). A material with many features fits
///           if the features that it uses fit. Shorter bind groups are also cheaper to bind.
///   How     A shader variable needs a binding, whether it is read or not. The variable of a removed texture gets the
///           binding of a texture of the same type that stays; if there is none, one unread texture stays. The empty
///           bindings then leave the layout. The others keep their numbers; in ESSL, where texture units count on over
///           all groups, later units move up.
///   In      a package as it was read, and the constants that it is loaded with.
///   Out     the same package. Parameter::isBound says which textures are left.
///   Thread  any.   Cost: one copy of the code of the package, if anything is removed.
///   Fails   never. Code that this project's compiler did not write stays as it is where it cannot be parsed.
#pragma once

#include "shaders/package/Package.h"

#include <span>

namespace filament_core::shader {

void removeUnusedTextures(MaterialPackage& package, std::span<const backend::ConstantValue> constants);

} // namespace filament_core::shader
