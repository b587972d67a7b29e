// SPDX-License-Identifier: Apache-2.0
/// MaterialValues: words to values of parameters and constants: "0.5", "1,0,0.2", "true".
///   Forms   as many numbers as the type has components, separated by commas; matrices column by column; arrays element
///           by element.
///   Thread  that of the engine.
///   Fails   InvalidArgument: the name, the word and how many numbers its type has.
#pragma once

#include "shaders/package/Package.h"

#include <filament/Engine.h>

#include <string>
#include <utility>
#include <vector>

namespace filament::tools {

using MaterialValues = std::vector<std::pair<std::string, std::string>>;

/// Of a parameter that is no texture.
Result<void> setMaterialValue(Engine& engine, MaterialInstance instance, shader::Parameter const& parameter,
                              std::string const& words);

/// Those of the values that are constants of the package.
Result<std::vector<MaterialConstant>> materialConstants(shader::MaterialPackage const& package,
                                                        MaterialValues const& values);

} // namespace filament::tools
