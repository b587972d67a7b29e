// SPDX-License-Identifier: Apache-2.0
/// MaterialValues: parses values of parameters and constants: "0.5", "1,0,0.2", "true".
///   Forms   as many numbers as the type has components, separated by commas; matrices by column; arrays by element.
///   Thread  that of the engine.
///   Fails   InvalidArgument: the name, the text and the number of values of the type.
#pragma once

#include "shaders/package/Package.h"

#include <filament_core/Engine.h>

#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

using MaterialValues = std::vector<std::pair<std::string, std::string>>;

/// Sets a parameter that is not a texture.
Result<void> setMaterialValue(Engine& engine, MaterialInstance instance, shader::Parameter const& parameter,
                              std::string const& words);

/// The values that belong to constants of the package.
Result<std::vector<MaterialConstant>> materialConstants(shader::MaterialPackage const& package,
                                                        MaterialValues const& values);

} // namespace filament_core::tools
