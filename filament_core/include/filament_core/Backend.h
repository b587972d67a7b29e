// SPDX-License-Identifier: Apache-2.0
/// Backend: the graphics API that draws. A plain value.
#pragma once

#include <cstdint>

namespace filament_core {

enum class Backend : uint8_t { Vulkan, Gles, Null };
const char* toString(Backend backend);

} // namespace filament_core
