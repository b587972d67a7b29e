// SPDX-License-Identifier: Apache-2.0
/// deflateBytes, inflateBytes: bytes in fewer bytes, by zlib; the same bytes for the same input and the same zlib.
///   Form    the size (u32), then raw DEFLATE (RFC 1951) up to the last byte. No checksum: the file has one.
///   Memory  inflate: the output, asked for only if its size is within `maxBytes` and within what so many bytes of
///           DEFLATE can become; and zlib's state of some ten kilobytes.
///   Fails   inflateBytes(): Corrupt for whatever is not exactly of this form. Both: std::bad_alloc.
///   Pre     deflateBytes(): less than 4 GiB.
///   Thread  pure functions.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament::shader {

std::vector<std::byte> deflateBytes(std::span<const std::byte> bytes);
Result<std::vector<std::byte>> inflateBytes(std::span<const std::byte> packed, uint32_t maxBytes);

} // namespace filament::shader
