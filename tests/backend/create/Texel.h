// SPDX-License-Identifier: Apache-2.0
/// Texel: an independent, slow implementation of the formats of backend/api, to check drivers against.
///   encodeTexel  the bytes of one colour in its format, rounded to nearest.
///   decodeTexel  what a shader reads from these bytes: components that the format lacks are 0, 0, 0, 1.
///   Uncompressed colour formats only.
#pragma once

#include "tests/backend/create/Gpu.h"

namespace filament_core::backend {

Bytes encodeTexel(Format format, Rgba const& color);
Rgba decodeTexel(Format format, const std::byte* bytes);

double linearFromSrgb(double encoded); ///< IEC 61966-2-1
double srgbFromLinear(double linear);

} // namespace filament_core::backend
