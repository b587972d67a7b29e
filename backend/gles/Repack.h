// SPDX-License-Identifier: Apache-2.0
/// repack: converts texels from the form that every ES 3.1 device can read to the form that Format.h promises.
///   In      4 components per texel: bytes (UNORM), 32-bit unsigned integers, or floats; see genericBytes().
///   Exact   the values came out of a texture of that format, so each has an exact representation in it.
///   Thread  any; pure.
#pragma once

#include "backend/api/Format.h"

#include <cstddef>
#include <span>

namespace filament_core::backend::gles {

/// Bytes of a generic texel: 4 for UNORM formats, 16 for integers and floats.
uint32_t genericBytes(Format format);

/// False for formats that need no conversion: packed UNORM, depth and compressed ones.
bool canRepack(Format format);

/// `texels` texels from `generic` to `packed`.
void repack(Format format, std::span<const std::byte> generic, std::span<std::byte> packed);

/// Bits of a half that holds `value` exactly; infinities and NaN too.
uint16_t exactHalfBits(float value);

} // namespace filament_core::backend::gles
