// SPDX-License-Identifier: Apache-2.0
/// The layout of a material's parameters in its MaterialParams block: std140 (OpenGL 4.6 specification, 7.6.2.2).
///   Used by the compiler (to assign), the reader (to check) and the engine (to write). Booleans are 32-bit words.
///   Fails   never; textures take no bytes.
#pragma once

#include "shaders/package/Package.h"

#include <cstdint>
#include <span>

namespace filament::shader {

/// Size of one value, not an array: 4, 8, 12 or 16; 48 and 64 for the matrices; 0 for textures.
uint32_t valueBytes(ParameterType type);
/// Alignment of a value that is not in an array. Array elements start at multiples of 16.
uint32_t valueAlignment(ParameterType type);
/// Distance between array elements.
uint32_t arrayStride(ParameterType type);
/// All bytes of a parameter, arrays included.
uint64_t parameterBytes(Parameter const& parameter);

/// Sets the offset of each parameter, in the order given; returns the size of the block, a multiple of 16.
uint32_t assignOffsets(std::span<Parameter> parameters);

} // namespace filament::shader
