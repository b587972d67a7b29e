// SPDX-License-Identifier: Apache-2.0
#include "tests/framegraph/AllocationCount.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<uint64_t> gAllocations{ 0 };

void* counted(void* memory) {
    gAllocations.fetch_add(1, std::memory_order_relaxed);
    if (!memory) std::abort();
    return memory;
}

} // namespace

// The array forms call these.
void* operator new(size_t bytes) { return counted(std::malloc(bytes)); }
void* operator new(size_t bytes, std::align_val_t alignment) {
    const auto align = static_cast<size_t>(alignment);
    return counted(std::aligned_alloc(align, (bytes + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

namespace filament_core::framegraph {

uint64_t allocationCount() { return gAllocations.load(std::memory_order_relaxed); }

} // namespace filament_core::framegraph
