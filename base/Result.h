// SPDX-License-Identifier: Apache-2.0
/// Result and Error are public types; the rooms below the API include them through this header.
///   fail() builds an Error from a format string: `return fail(ErrorCode::NotFound, "no file '{}'", path);`
#pragma once

#include <filament_core/Result.h>

#include <fmt/core.h>

namespace filament_core {

template <class... Args>
Error fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
    return { code, fmt::vformat(format, fmt::make_format_args(args...)) };
}

} // namespace filament_core
