// SPDX-License-Identifier: Apache-2.0
/// expandTemplates: one material text for several materials: replaces every ${NAME} by the value that belongs to it.
///   Out     the text; values are inserted as they are and not searched again.
///   Thread  any. Fails: InvalidArgument, "file:line: ..." for a name without a value and for a ${ without its }.
#pragma once

#include "base/Result.h"

#include <map>
#include <string>
#include <string_view>

namespace filament_core::shader {

using TemplateValues = std::map<std::string, std::string, std::less<>>;

Result<std::string> expandTemplates(std::string_view text, std::string_view fileName, TemplateValues const& values);

} // namespace filament_core::shader
