// SPDX-License-Identifier: Apache-2.0
/// corruptPackage(): the error for invalid package bytes; `what` says what is wrong with them.
#pragma once

#include "base/Result.h"

#include <string_view>

namespace filament_core::shader {

inline Error corruptPackage(std::string_view what) {
    return fail(ErrorCode::Corrupt, "material package: {}; compile the material again with matc", what);
}

} // namespace filament_core::shader
