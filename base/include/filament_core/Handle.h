// SPDX-License-Identifier: Apache-2.0
/// Handle, ObjectHandle: small typed references to objects in tables. Zero refers to nothing.
///   Handle        of a device: 20 bits of index, 12 bits of generation. 32 bits, because commands are full of them.
///   ObjectHandle  of an app: 20 bits of index, 28 bits of generation, 16 bits of the owner that gave it out, an engine
///                 or a scene. The generation tells a stale handle from a live one, the owner one engine's objects from
///                 another's.
///   Thread        plain values; passed and compared by value.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace filament_core {

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

template <class Tag>
struct ObjectHandle {
    static constexpr uint32_t kIndexBits = 20;
    static constexpr uint32_t kIndexMask = (1u << kIndexBits) - 1;
    static constexpr uint32_t kMaxGeneration = (1u << 28) - 1;
    static constexpr uint32_t kOwnerShift = 48;

    uint64_t bits = 0;

    static ObjectHandle make(uint32_t index, uint32_t generation, uint16_t owner = 0) {
        return { uint64_t{ owner } << kOwnerShift | uint64_t{ generation } << kIndexBits | index };
    }
    uint32_t index() const { return static_cast<uint32_t>(bits) & kIndexMask; }
    uint32_t generation() const { return static_cast<uint32_t>(bits >> kIndexBits) & kMaxGeneration; }
    uint16_t owner() const { return static_cast<uint16_t>(bits >> kOwnerShift); }
    /// Without the owner: the same in every run that makes the same objects. 48 bits.
    uint64_t number() const { return bits & ((uint64_t{ 1 } << kOwnerShift) - 1); }
    explicit operator bool() const { return bits != 0; }
    friend bool operator==(ObjectHandle, ObjectHandle) = default;
    friend auto operator<=>(ObjectHandle, ObjectHandle) = default;
};

} // namespace filament_core

template <class Tag>
struct std::hash<filament_core::Handle<Tag>> {
    size_t operator()(filament_core::Handle<Tag> handle) const noexcept { return std::hash<uint32_t>{}(handle.bits); }
};

template <class Tag>
struct std::hash<filament_core::ObjectHandle<Tag>> {
    size_t operator()(filament_core::ObjectHandle<Tag> handle) const noexcept {
        return std::hash<uint64_t>{}(handle.bits);
    }
};
