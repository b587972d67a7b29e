// SPDX-License-Identifier: Apache-2.0
/// Backend: which API draws. A plain value.
#pragma once

#include <cstdint>

namespace filament {

enum class Backend : uint8_t { Vulkan, Gles, Null };
const char* toString(Backend backend);

} // namespace filament
