// SPDX-License-Identifier: Apache-2.0
/// compressBytes, decompressBytes: text and code in fewer bytes; the same bytes for the same input, everywhere.
///   Source  Ziv and Lempel, "A Universal Algorithm for Sequential Data Compression", 1977: what came before is
///   referred
///           to by distance and length.
///   Form    a size, then in turns: a number of literals and the literals, a length (less kMinMatch) and a distance;
///           until the size is reached. Numbers are in groups of 7 bits, the lowest first; bit 7: another one follows.
///   Memory  compress: 12 bytes a byte of input. decompress: the output, asked for only if it is within the limit.
///   Fails   decompressBytes(): nothing, for bytes that are not of this form, or more than `maxBytes`.
///   Thread  pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filament {

std::vector<std::byte> compressBytes(std::span<const std::byte> bytes);
std::optional<std::vector<std::byte>> decompressBytes(std::span<const std::byte> compressed, uint64_t maxBytes);

} // namespace filament
