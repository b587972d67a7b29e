// SPDX-License-Identifier: Apache-2.0
/// BuiltModel: builds a real .glb for a scene file that lists objects instead of naming a file.
///   In      { "objects": [ { "shape": "sphere", "at": [0, 1, 0], "material": { "color": [1, 0, 0, 1] } } ] }; also
///           "imageBasedLight" (BuiltLight.h)
///   Out     the bytes of a binary glTF file, so that the objects pass through the loader. The same JSON gives the same
///           bytes.
///   Fails   InvalidArgument with the field.
///   Thread  any; pure.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <cstddef>

namespace filament_core::tools {

Result<std::vector<std::byte>> buildModel(Json const& model, std::string const& name);

} // namespace filament_core::tools
