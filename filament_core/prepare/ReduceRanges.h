// SPDX-License-Identifier: Apache-2.0
/// reduceRanges: a value over many objects, by jobs over ranges of them, joined in their order: the same for any number
/// of workers.
#pragma once

#include "base/Arena.h"
#include "jobsystem/JobSystem.h"

#include <cstddef>

namespace filament_core::prepare {

/// `add(part, index)` for [0, count), then `join(whole, part)` in the order of the ranges.
template <class T, class Add, class Join>
T reduceRanges(jobs::JobSystem& jobs, Arena& arena, size_t count, Add&& add, Join&& join) {
    constexpr size_t kRange = 4096; // about 20 us
    const auto parts = arena.array<T>((count + kRange - 1) / kRange);
    jobs::parallelFor<"extent">(jobs, count, kRange, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) add(parts[begin / kRange], i);
    });
    T whole{};
    for (T const& part : parts) join(whole, part);
    return whole;
}

} // namespace filament_core::prepare
