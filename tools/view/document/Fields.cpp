// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/Fields.h"

#include "base/Result.h"

#include <filament_core/Material.h>

namespace filament_core::view {
// ParameterValue and ParameterType list the same types in the same order.
const char* parameterTypeName(size_t index) { return toString(static_cast<ParameterType>(index)); }

} // namespace filament_core::view
