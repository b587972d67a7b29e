// SPDX-License-Identifier: Apache-2.0
/// ShaderTextGaps: what the language knows and the texts in shaders/material cannot do yet. One table, a row for each;
/// whoever writes the text takes the row out.
///   Thread  any. Fails: Unsupported, at the line of the property.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

Result<void> checkShaderText(MaterialDefinition const& definition);

} // namespace filament::shader
