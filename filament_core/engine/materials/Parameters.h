// SPDX-License-Identifier: Apache-2.0
/// Parameters: writes typed values into the MaterialParams block of an instance (std140,
/// shaders/package/ParameterLayout.h).
///   In      a parameter of the package, the block, the app's value.
///   Thread  pure functions.   Memory: only for the text of an error.
///   Fails   InvalidArgument with both types, or with the elements that the array lacks; nothing is written in that
///           case.
#pragma once

#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/Objects.h>

#include <span>

namespace filament_core::engine {

Result<void> writeParameter(scene::Material const& material, shader::Parameter const& parameter,
                            ParameterValue const& value, std::span<std::byte> block);
/// As the parameter's type, if that can hold it.
Result<void> writeNumber(scene::Material const& material, shader::Parameter const& parameter,
                         ParameterNumber const& number, std::span<std::byte> block);
Result<void> writeParameters(scene::Material const& material, shader::Parameter const& parameter,
                             ParameterArray const& values, uint32_t first, std::span<std::byte> block);

} // namespace filament_core::engine
