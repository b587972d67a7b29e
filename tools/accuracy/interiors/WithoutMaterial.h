// SPDX-License-Identifier: Apache-2.0
/// withoutMaterial: a binary glTF file without the meshes of one material, and without animations.
///   For     models with outlines that are inverted hulls: to paths they are walls around everything.
///   Thread  any; pure.
///   Fails   Corrupt if it is no .glb; NotFound if no material has the name.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace filament_core::accuracy {

Result<std::vector<std::byte>> withoutMaterial(std::span<const std::byte> glb, std::string const& material);

} // namespace filament_core::accuracy
