// SPDX-License-Identifier: Apache-2.0
/// deflateBytes, inflateBytes: compression with zlib; the same input and version of zlib give the same bytes.
///   Form    the size (u32), then raw DEFLATE (RFC 1951) up to the last byte. No checksum: the file has one.
///   Memory  inflate: the output, allocated only if its size is within `maxBytes` and within what that many bytes of
///           DEFLATE can expand to; and zlib's state of some ten kilobytes.
///   Fails   inflateBytes(): Corrupt for anything that is not exactly of this form. Both: std::bad_alloc.
///   Pre     deflateBytes(): less than 4 GiB.
///   Thread  pure functions.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<std::byte> deflateBytes(std::span<const std::byte> bytes);
Result<std::vector<std::byte>> inflateBytes(std::span<const std::byte> packed, uint32_t maxBytes);

} // namespace filament_core::shader
