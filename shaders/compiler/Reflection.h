// SPDX-License-Identifier: Apache-2.0
/// Reflection: the declarations of a definition as JSON, in the form of the materials guide, 5.2.4.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <string>

namespace filament_core::shader {

/// The author's parameters in the order of the file; sizes are strings, as in the guide.
std::string parametersAsJson(MaterialDefinition const& definition);

} // namespace filament_core::shader
