// SPDX-License-Identifier: Apache-2.0
/// The layout of a material's parameters in its MaterialParams block: std140 (OpenGL 4.6 specification, 7.6.2.2).
///   Used by the compiler (to assign), the reader (to check) and the engine (to write). Booleans are 32-bit words.
///   Fails   never; textures take no bytes.
#pragma once

#include "base/math/Math.h"
#include "shaders/package/Package.h"

#include <cstdint>
#include <cstring>
#include <span>

namespace filament_core::shader {

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

// ---- the bytes of one value

/// A boolean is a word of 32 bits, 1 or 0.
inline void storeValue(std::byte* to, bool value) {
    const uint32_t word = value;
    std::memcpy(to, &word, sizeof(word));
}
template <class T>
void storeValue(std::byte* to, T const& value) {
    std::memcpy(to, &value, sizeof(value));
}
template <int N>
void storeValue(std::byte* to, glm::vec<N, bool> const& value) {
    for (int i = 0; i < N; ++i) storeValue(to + 4 * i, value[i]);
}
/// The columns of a matrix start at multiples of 16 bytes.
template <int N>
void storeValue(std::byte* to, glm::mat<N, N, float> const& value) {
    for (int column = 0; column < N; ++column) std::memcpy(to + 16 * column, &value[column], sizeof(value[column]));
}

} // namespace filament_core::shader
