// SPDX-License-Identifier: Apache-2.0
/// hashBytes: a 64-bit content hash for caches and determinism checks; the same on every machine and in every run.
///   Source  wyhash-style 64x64 -> 128 bit multiply folding (Wang Yi, "wyhash", 2019); not cryptographic.
///   Cost    about 4 bytes per cycle; no allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core {

uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed = 0);

inline uint64_t hashString(std::string_view text, uint64_t seed = 0) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

/// Hash of a value without padding bytes.
template <class T>
uint64_t hashValue(T const& value, uint64_t seed = 0) {
    static_assert(std::has_unique_object_representations_v<T>, "padding would make the hash random");
    return hashBytes(std::as_bytes(std::span(&value, 1)), seed);
}

/// Order matters: combine(a, b) != combine(b, a).
uint64_t hashCombine(uint64_t a, uint64_t b);

} // namespace filament_core
