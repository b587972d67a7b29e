// SPDX-License-Identifier: Apache-2.0
/// How large texels are, for programs that make or read pixels.
#pragma once

#include <filament_core/Format.h>

#include <cstdint>

namespace filament_core {

/// Bytes of one texel; 0: the format has none, or stores blocks.
uint32_t texelBytes(Format format);

} // namespace filament_core
