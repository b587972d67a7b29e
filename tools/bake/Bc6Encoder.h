// SPDX-License-Identifier: Apache-2.0
/// encodeBc6: half floats as blocks of BC6H (unsigned), 16 bytes for 4 x 4 texels. Khronos Data Format Specification
/// 1.3, chapter 20.
///   In      RGBA16F, one level, no negative numbers; alpha is left out. Infinities and NaN become the largest half.
///   Method  of each block the line through its colours (their first principal component) in the codes of half floats,
///           whose steps are equal parts of a value; then least squares for its ends and the nearest places on it, in
///           turns. All four modes with one line are tried, and the one with the least squared error is kept.
///   Error   docs/baking.md: measured; a block of one colour is off by less than 2^-9 of it.
///   Thread  any; pure.
#pragma once

#include "filament_core/assets/image/Image.h"

#include <cstddef>
#include <span>
#include <vector>

namespace filament_core::bake {

/// `halves` has width * height texels of 8 bytes. Blocks that stick out repeat the last row and column.
std::vector<std::byte> encodeBc6(std::span<const std::byte> halves, uint32_t width, uint32_t height);

/// BC4 of codes from 0 to 255: 8 bytes for 4 x 4 of them (chapter 19).
std::vector<std::byte> encodeBc4(std::span<const std::byte> codes, uint32_t width, uint32_t height);

} // namespace filament_core::bake
