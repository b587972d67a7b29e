// SPDX-License-Identifier: Apache-2.0
/// TextureConditions: checks that a texture with `usedIf : [ a, b ]` is read only where one of these constants is true.
///   Why     Elsewhere the engine removes the texture (shaders/package/RemoveUnusedTextures.h), and code that reads it
///           would get the texels of another one.
///   How     Optimises the author's code as if the constants were false; no load of the texture may remain. Sees
///           through `a || b`. It does not see through `a && c`, because c may still be chosen: write if (a) { if (c)
///           ... }.
///   In      a definition after layOutParameters(), before any variant is compiled.
///   Thread  any. Cost: about 20 ms per texture with usedIf.
///   Fails   InvalidArgument at the line of the parameter. Errors in the author's GLSL, if they were not found before.
#pragma once

#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/StageText.h"

namespace filament_core::shader {

Result<void> checkTextureConditions(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                    IncludeResolver const& includes);

} // namespace filament_core::shader
