// SPDX-License-Identifier: Apache-2.0
/// generateMaterial: a small random material that is well typed, from a seed.
///   Out      properties, parameters, textures, a vertex block with variables, helper functions, and code with loops,
///            branches, arrays and every built-in function (Productions.h); a "// show:" line with values.
///   Scene    the .json of a conformance scene that draws it.
///   Bits     the same seed gives the same text on every machine.
///   Thread   any; pure.
#pragma once

#include "tools/conformance/random/MaterialTree.h"

#include <cstdint>

namespace filament_core::conformance {

/// Its children: the values shown, the properties, the vertex block, the fragment block. Each is a list.
MaterialTree generateMaterial(uint64_t seed);

/// `material`: the file's path, relative to the scene.
std::string generateScene(uint64_t seed, std::string const& material);

} // namespace filament_core::conformance
