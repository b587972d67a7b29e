// SPDX-License-Identifier: Apache-2.0
/// deflateZlib, inflateZlib: whole zlib streams in memory. Private to this folder.
///   Out     the same bytes for the same input and version of zlib.
///   Thread  any; pure.
///   Fails   inflateZlib() with false, whatever the bytes; deflateZlib() with std::bad_alloc alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace filament_core::assets {

/// `level`: zlib's, 1 (fastest) to 9 (smallest).
std::vector<std::byte> deflateZlib(std::span<const std::byte> bytes, int level);

/// Of exactly out.size() bytes.
bool inflateZlib(std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace filament_core::assets
