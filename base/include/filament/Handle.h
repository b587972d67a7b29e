// SPDX-License-Identifier: Apache-2.0
/// Handle: a small typed reference to an object in a table. Zero refers to nothing.
///   Bits    20 bits of index, 12 bits of generation; the generation distinguishes a stale handle from a live one.
///   Thread  a plain value; passed and compared by value.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace filament {

template <class Tag>
struct Handle {
    static constexpr uint32_t kIndexBits = 20;
    static constexpr uint32_t kIndexMask = (1u << kIndexBits) - 1;
    static constexpr uint32_t kMaxGeneration = (1u << (32 - kIndexBits)) - 1;

    uint32_t bits = 0;

    static Handle make(uint32_t index, uint32_t generation) { return { (generation << kIndexBits) | index }; }
    uint32_t index() const { return bits & kIndexMask; }
    uint32_t generation() const { return bits >> kIndexBits; }
    explicit operator bool() const { return bits != 0; }
    friend bool operator==(Handle, Handle) = default;
    friend auto operator<=>(Handle, Handle) = default;
};

} // namespace filament

template <class Tag>
struct std::hash<filament::Handle<Tag>> {
    size_t operator()(filament::Handle<Tag> handle) const noexcept { return std::hash<uint32_t>{}(handle.bits); }
};
