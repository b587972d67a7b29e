// SPDX-License-Identifier: Apache-2.0
/// appendPngChunk: the chunks of a PNG (ISO/IEC 15948, 5.3): length, name, data and checksum, numbers with their
/// highest byte first.
///   Thread  any; pure.   Fails: std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

void appendPngWord(std::vector<std::byte>& bytes, uint32_t value);
/// `name`: four letters.
void appendPngChunk(std::vector<std::byte>& bytes, std::string_view name, std::span<const std::byte> data);

} // namespace filament_core::assets
