// SPDX-License-Identifier: Apache-2.0
/// ModelVariants: the variants of a model by name (KHR_materials_variants).
///   Fails   InvalidArgument for a name that the model does not have, with the nearest known name.
///   Thread  any.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <span>
#include <string_view>

namespace filament_core::assets {

/// The index of the first variant with this name. `model`: the name of the model in messages.
Result<uint32_t> findVariant(std::span<const std::string> variants, std::string_view name, std::string_view model);

/// Gives every primitive the material that the variant names for it; others keep theirs. "": changes nothing.
Result<void> selectVariant(ModelData& model, std::string_view name);

} // namespace filament_core::assets
