// SPDX-License-Identifier: Apache-2.0
/// ConstantBits: converts values of material constants to the 32 bits that programs are specialised with, and back.
///   Bits    0 or 1 of a bool, two's complement of an int, IEEE 754 of a float.
///   Thread  pure functions.   Memory: none.   Fails: never.
#pragma once

#include "backend/api/Descriptions.h"

#include <cstdint>
#include <variant>

namespace filament_core::engine {

using ConstantData = std::variant<bool, int32_t, float>;

backend::ConstantValue::Type typeOf(ConstantData const& value);
uint32_t bitsOf(ConstantData const& value);
ConstantData dataOf(backend::ConstantValue::Type type, uint32_t bits);

} // namespace filament_core::engine
