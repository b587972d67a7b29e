// SPDX-License-Identifier: Apache-2.0
/// CommandPayload: makes a command independent of its caller's memory, by copying the data of its spans and names.
///   In/out  adoptPayload(command, memory): every span and string_view field, at any depth, is copied into memory and
///           then points there. Empty ones point nowhere.
///   Memory  memory.allocate(bytes, alignment) -> std::span<std::byte>.
///   Cost    one memcpy per payload; nothing for commands without payload (most of them).
#pragma once

#include "backend/stream/CommandFields.h"

#include <cstring>

namespace filament_core::backend {

namespace detail {

template <class T>
constexpr bool hasPayload();

template <class S, class... T>
constexpr bool anyPayload(FieldList<S, T...> const&) {
    return (hasPayload<T>() || ...);
}

template <class T>
constexpr bool hasPayload() {
    if constexpr (std::same_as<T, std::string_view> || kIsSpan<T>)
        return true;
    else if constexpr (HasFields<T>)
        return anyPayload(kFields<T>);
    else if constexpr (kIsArray<T>)
        return hasPayload<typename T::value_type>();
    else
        return false;
}

} // namespace detail

/// Whether a command (or a struct in one) points to memory outside of itself.
template <class T>
inline constexpr bool kHasPayload = detail::hasPayload<T>();

template <class T, class Memory>
void adoptPayload(T& value, Memory& memory) {
    if constexpr (std::same_as<T, std::string_view>) {
        const std::span<std::byte> copy = value.empty() ? std::span<std::byte>{} : memory.allocate(value.size(), 1);
        if (!copy.empty()) std::memcpy(copy.data(), value.data(), value.size());
        value = { reinterpret_cast<const char*>(copy.data()), copy.size() };
    } else if constexpr (kIsSpan<T>) {
        using Element = std::remove_const_t<typename T::element_type>;
        static_assert(std::is_trivially_copyable_v<Element> && !kHasPayload<Element>, "payloads are flat");
        // Bytes may be anything from SPIR-V words to texels: 16 suits them all.
        constexpr size_t kAlignment = sizeof(Element) == 1 ? 16 : alignof(Element);
        const std::span<std::byte> copy =
                value.empty() ? std::span<std::byte>{} : memory.allocate(value.size_bytes(), kAlignment);
        if (!copy.empty()) std::memcpy(copy.data(), value.data(), value.size_bytes());
        value = { reinterpret_cast<const Element*>(copy.data()), value.empty() ? 0 : value.size() };
    } else if constexpr (kHasPayload<T>) {
        static_assert(HasFields<T>, "an array of payloads would need a loop here");
        visitFields(value, [&](const char*, auto& field) { adoptPayload(field, memory); });
    }
}

} // namespace filament_core::backend
