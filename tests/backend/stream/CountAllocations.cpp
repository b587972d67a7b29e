// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/stream/CountAllocations.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<uint64_t> gAllocations{ 0 };

void* countedAllocation(size_t size, size_t alignment) {
    gAllocations.fetch_add(1, std::memory_order_relaxed);
    const size_t rounded = (size + alignment - 1) / alignment * alignment; // required by aligned_alloc
    if (void* memory = std::aligned_alloc(alignment, rounded ? rounded : alignment)) return memory;
    throw std::bad_alloc();
}

} // namespace

uint64_t filament_core::allocationCount() { return gAllocations.load(std::memory_order_relaxed); }

void* operator new(size_t size) { return countedAllocation(size, alignof(std::max_align_t)); }
void* operator new(size_t size, std::align_val_t alignment) {
    return countedAllocation(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size) { return countedAllocation(size, alignof(std::max_align_t)); }
void* operator new[](size_t size, std::align_val_t alignment) {
    return countedAllocation(size, static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
