// SPDX-License-Identifier: Apache-2.0
/// OptionRows: descriptions of options, from members: what kind of value a field holds follows from its type.
///   const Option strength = option("bloom.strength", &Bloom::strength, { 0, 1 }, "Share of the light ...");
///   Thread   any; pure.   Fails: never; a type that no option can have does not compile.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Options.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace filament_core {

/// Beyond what a float holds: no limit.
inline constexpr double kUnlimited = 1e300;

inline constexpr std::array<std::string_view, 2> kSwitchWords{ "off", "on" };

/// Of a number; see Option.
struct OptionRange {
    double least = -kUnlimited, most = kUnlimited;
    std::string_view unit{};
    std::span<const std::string_view> values{};
    bool onlyValues = false;
};

/// Bytes from the beginning of T to its member.
template <class T, class M>
uint32_t offsetOf(M T::*member) {
    static const T sample{};
    auto const* begin = reinterpret_cast<const char*>(&sample);
    return static_cast<uint32_t>(reinterpret_cast<const char*>(&(sample.*member)) - begin);
}

/// One number of a field, and how many it has.
template <class M>
struct OptionNumber {
    using Type = M;
    static constexpr uint8_t kComponents = 1;
};
template <class M>
requires requires(M unit) {
    { unit.value } -> std::same_as<float&>;
}
struct OptionNumber<M> { // Lux, Candela, Nits
    using Type = float;
    static constexpr uint8_t kComponents = 1;
};
template <int N, class S, glm::qualifier Q>
struct OptionNumber<glm::vec<N, S, Q>> {
    using Type = S;
    static constexpr uint8_t kComponents = N;
};

template <class N>
constexpr Option::Storage storageOf() {
    static_assert(std::same_as<N, float> || std::same_as<N, double> || std::unsigned_integral<N>);
    if constexpr (std::same_as<N, float>) return Option::Storage::Float;
    if constexpr (std::same_as<N, double>) return Option::Storage::Double;
    return sizeof(N) == 1 ? Option::Storage::Uint8 : sizeof(N) == 2 ? Option::Storage::Uint16 : Option::Storage::Uint32;
}

/// A switch.
template <class T>
Option option(std::string_view name, bool T::*member, std::string_view description) {
    return { .name = name, .description = description, .values = kSwitchWords, .offset = offsetOf(member) };
}

/// One of the names of an enumeration.
template <class T, NamedEnum E>
Option option(std::string_view name, E T::*member, std::string_view description) {
    static_assert(sizeof(E) == 1);
    return { .name = name,
             .description = description,
             .kind = OptionKind::Choice,
             .values = enumNames<E>(),
             .storage = Option::Storage::Enum8,
             .offset = offsetOf(member) };
}

/// Numbers.
template <class T, class M>
Option option(std::string_view name, M T::*member, OptionRange const& range, std::string_view description) {
    using Number = typename OptionNumber<M>::Type;
    return { .name = name,
             .description = description,
             .kind = std::is_integral_v<Number> ? OptionKind::Integer : OptionKind::Number,
             .components = OptionNumber<M>::kComponents,
             .onlyValues = range.onlyValues,
             .least = range.least,
             .most = range.most,
             .unit = range.unit,
             .values = range.values,
             .storage = storageOf<Number>(),
             .offset = offsetOf(member) };
}

/// The bytes of a field, which has no padding: for hashing.
std::span<const std::byte> bytesOf(Option const& option, void const* object);

/// Options of a member are options of the struct that has it, by the same names.
template <class T, class M>
void append(std::vector<Option>& options, M T::*member, std::span<const Option> ofMember) {
    for (Option option : ofMember) {
        option.offset += offsetOf(member);
        options.push_back(option);
    }
}

} // namespace filament_core
