// SPDX-License-Identifier: Apache-2.0
/// What compiles and is probably not meant: parameters that no code reads, attributes that are required twice, a
/// material() without prepareMaterial(), numbers that are known not to be one.
///   Out     "file:line: text", in the order of the text.
///   Thread  any. Cost: a fragment stage parsed. Fails: never; of a material that does not compile, less is found.
#pragma once

#include "shaders/compiler/GlslGenerator.h"

#include <string>
#include <vector>

namespace filament_core::shader {

std::vector<std::string> materialWarnings(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                          IncludeResolver const& includes);

} // namespace filament_core::shader
