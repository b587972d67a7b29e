// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/ConstantBits.h"

#include <bit>

namespace filament_core::engine {

using backend::ConstantValue;

ConstantValue::Type typeOf(ConstantData const& value) {
    switch (value.index()) {
    case 0:
        return ConstantValue::Type::Bool;
    case 1:
        return ConstantValue::Type::Int;
    default:
        return ConstantValue::Type::Float;
    }
}

uint32_t bitsOf(ConstantData const& value) {
    switch (value.index()) {
    case 0:
        return std::get<bool>(value) ? 1u : 0u;
    case 1:
        return static_cast<uint32_t>(std::get<int32_t>(value));
    default:
        return std::bit_cast<uint32_t>(std::get<float>(value));
    }
}

ConstantData dataOf(ConstantValue::Type type, uint32_t bits) {
    switch (type) {
    case ConstantValue::Type::Bool:
        return bits != 0;
    case ConstantValue::Type::Int:
        return static_cast<int32_t>(bits);
    case ConstantValue::Type::Float:
        return std::bit_cast<float>(bits);
    }
    return false;
}

} // namespace filament_core::engine
