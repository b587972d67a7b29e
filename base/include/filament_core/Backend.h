// SPDX-License-Identifier: Apache-2.0
/// Backend: the graphics API that draws. A plain value.
#pragma once

#include <filament_core/EnumNames.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace filament_core {

enum class Backend : uint8_t {
    Vulkan,
    Gles, ///< OpenGL ES
    Null, ///< draws nothing
};
template <>
struct EnumNames<Backend> {
    static constexpr std::array<std::string_view, 3> values{ "vulkan", "gles", "null" };
};

} // namespace filament_core
