// SPDX-License-Identifier: Apache-2.0
/// FullScreenInterface: what a full-screen pass gives its material, and the check that both agree.
///   Thread  any; pure.   Memory: none, except an error's text.
#pragma once

#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/Material.h>

#include <span>
#include <string_view>

namespace filament_core::passes {

struct FullScreenParameter {
    std::string_view name;
    ParameterType type = ParameterType::Float;
};

/// What a pass gives its material: names of textures, names and types of values.
struct FullScreenInterface {
    std::string_view pass; ///< for errors
    std::span<const std::string_view> inputs{};
    std::span<const FullScreenParameter> values{};
};

/// Checks that the material has everything that the pass gives, and that the pass gives everything that the material
/// has. Textures that the material's constants switch off (usedIf) may be missing.
///   Fails   NotFound or InvalidArgument; one line that names the material, the pass and the parameter.
Result<void> checkFullScreenMaterial(scene::Material const& material, FullScreenInterface const& given);

} // namespace filament_core::passes
