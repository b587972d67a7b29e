// SPDX-License-Identifier: Apache-2.0
/// plainMaterial: the engine's own materials with the arithmetic left to the drivers (matc --inexact), for programs
/// that measure what exactness costs: EngineOptions::exactShaders = false. Compiled when first needed, because no
/// image but theirs needs them.
///   Out     the package of the material; an empty span for an unknown name. For EngineDebug::plainMaterials.
///   Thread  any; a second caller waits for the first. Memory: kept until the program ends.
///   Cost    0.02 to 0.5 s for each material, once a process.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace filament_core::tools {

std::span<const std::byte> plainMaterial(std::string_view name);

/// The definition of an engine material; empty for an unknown name.
std::string_view engineMaterialText(std::string_view name);

} // namespace filament_core::tools
