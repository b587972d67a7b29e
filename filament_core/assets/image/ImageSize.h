// SPDX-License-Identifier: Apache-2.0
/// imageSize: the size that the header of a PNG, JPEG, WebP, AVIF, KTX 2.0 or DDS file states, before anything is
/// decoded.
///   Thread  any; pure. Fails: never, for any bytes; {0, 0} if there is no size in them.
#pragma once

#include <filament_core/Math.h>

#include <cstddef>
#include <span>

namespace filament_core::assets {

uint2 imageSize(std::span<const std::byte> bytes);

/// A PNG whose chunks go on behind its last byte, as after an interrupted download.
bool isCutShortPng(std::span<const std::byte> bytes);

/// A PNG that has an alpha channel, or a list of transparent colours.
bool hasAlphaPng(std::span<const std::byte> bytes);

} // namespace filament_core::assets
