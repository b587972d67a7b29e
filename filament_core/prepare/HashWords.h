// SPDX-License-Identifier: Apache-2.0
/// hashWords: numbers, each as 64 bits, in their order.
#pragma once

#include "base/Hash.h"

#include <array>

namespace filament_core::prepare {

template <class... T>
uint64_t hashWords(uint64_t seed, T... values) {
    const std::array<uint64_t, sizeof...(T)> words{ static_cast<uint64_t>(values)... };
    return hashBytes(std::as_bytes(std::span(words)), seed);
}

} // namespace filament_core::prepare
