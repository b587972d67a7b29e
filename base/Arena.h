// SPDX-License-Identifier: Apache-2.0
/// Arena: linear memory for objects that live exactly one frame.
///   Memory  grows in blocks. reset() replaces several blocks by one of their total size, so that after warm-up a frame
///           allocates nothing from the heap, and growing frames allocate ever more rarely.
///   Thread  one thread at a time. Jobs get spans that are allocated before they start.
///   Limits  objects are never destroyed: trivially destructible types only.
///   Fails   std::bad_alloc; earlier allocations stay valid.
#pragma once

#include "base/Assert.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace filament_core {

class Arena {
public:
    explicit Arena(size_t blockBytes = 64 * 1024) : mBlockBytes(blockBytes) {}
    Arena(Arena&&) = default;
    Arena& operator=(Arena&&) = default;

    void* allocate(size_t bytes, size_t alignment);

    /// `count` value-initialised elements.
    template <class T>
    std::span<T> array(size_t count) {
        static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
        T* first = static_cast<T*>(allocate(count * sizeof(T), alignof(T)));
        for (size_t i = 0; i < count; ++i) new (first + i) T();
        return { first, count };
    }

    /// `count` uninitialised elements, for arrays that are written in full or from the front.
    template <class T>
    std::span<T> arrayForOverwrite(size_t count) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                      "only plain data begins its life by being written");
        return { static_cast<T*>(allocate(count * sizeof(T), alignof(T))), count };
    }

    template <class T, class... Args>
    T* make(Args&&... args) {
        static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
        return new (allocate(sizeof(T), alignof(T))) T{ std::forward<Args>(args)... };
    }

    template <class T>
    std::span<T> copy(std::span<const T> source) {
        static_assert(std::is_trivially_copyable_v<T>);
        T* first = static_cast<T*>(allocate(source.size_bytes(), alignof(T)));
        if (!source.empty()) std::memcpy(first, source.data(), source.size_bytes());
        return { first, source.size() };
    }

    /// Releases everything allocated, but keeps the memory.
    void reset();

    size_t bytesUsed() const;
    size_t bytesReserved() const;

private:
    struct Block {
        std::unique_ptr<std::byte[]> data;
        size_t size = 0;
        size_t used = 0;
    };

    void addBlock(size_t bytes);

    size_t mBlockBytes;
    std::vector<Block> mBlocks;
    size_t mCurrent = 0; // index of the block being filled
};

} // namespace filament_core
