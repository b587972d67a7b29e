// SPDX-License-Identifier: Apache-2.0
/// Options: the settings of a view, of lights and of loading by name. Each is described once, and everything else
/// follows from that description: command lines, scene files, panels, Python and the tables of docs/options.md.
///   Names    "bloom.strength", as in `filament-render --set bloom.strength=0.2` and in scene files.
///   Types    View, whose options are its own and those of Quality, Effects, DisplayTransform and SectionPlanes;
///            lights; the settings and the loading of environments and of glTF files.
///   Values   words: "on" and "off", the names of an enumeration, or numbers in the C locale, with commas between the
///            components of a vector. One number stands for all components.
///   Clamping setOption() refuses what lies outside of a range; values that a program writes into a struct itself are
///            clamped when a frame begins, and NaN counts as the default.
///   Thread   any; pure.   Memory: a table a type, made once, of a few kilobytes.
///   Fails    setOption(): NotFound with the nearest name, InvalidArgument with the valid values.
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/Result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace filament_core {

struct DisplayTransform;
struct DiscLight;
struct Effects;
struct EnvironmentLoadOptions;
struct EnvironmentSettings;
struct GltfLoadOptions;
struct PointLight;
struct Quality;
struct RectLight;
struct SectionPlanes;
struct SpotLight;
struct SunLight;
struct TubeLight;
struct View;

enum class OptionKind : uint8_t {
    Switch,  ///< "off" or "on"
    Choice,  ///< one of `values`
    Integer, ///< a whole number in [least, most]; one of `values` if `onlyValues`
    Number,  ///< `components` numbers, each in [least, most]
};

/// One field of a struct.
struct Option {
    /// How the field is stored, and where: bytes from the beginning of the struct.
    enum class Storage : uint8_t { Bool, Enum8, Uint8, Uint16, Uint32, Float, Double };

    std::string_view name;        ///< "bloom.strength"
    std::string_view description; ///< what it does, a sentence of Markdown
    OptionKind kind = OptionKind::Switch;
    uint8_t components = 1;     ///< of a Number: 2 to 4 for vectors
    bool onlyValues = false;    ///< of an Integer: see OptionKind
    double least = 0, most = 0; ///< of numbers, inclusive
    std::string_view unit{};    ///< of a number: "metres"; of a vector: "R,G,B"; empty: none
    std::span<const std::string_view>
            values{}; ///< all words of a Switch or Choice; of an Integer those worth measuring
    Storage storage = Storage::Bool;
    uint32_t offset = 0;
};

/// All options of a struct, in the order of the documentation.
template <class T>
std::span<const Option> optionsOf() = delete;
template <>
std::span<const Option> optionsOf<DisplayTransform>();
template <>
std::span<const Option> optionsOf<DiscLight>();
template <>
std::span<const Option> optionsOf<Effects>();
template <>
std::span<const Option> optionsOf<EnvironmentLoadOptions>();
template <>
std::span<const Option> optionsOf<EnvironmentSettings>();
template <>
std::span<const Option> optionsOf<GltfLoadOptions>();
template <>
std::span<const Option> optionsOf<PointLight>();
template <>
std::span<const Option> optionsOf<Quality>();
template <>
std::span<const Option> optionsOf<RectLight>();
template <>
std::span<const Option> optionsOf<SectionPlanes>();
template <>
std::span<const Option> optionsOf<SpotLight>();
template <>
std::span<const Option> optionsOf<SunLight>();
template <>
std::span<const Option> optionsOf<TubeLight>();
template <>
std::span<const Option> optionsOf<View>();

/// The one with this name, or null.
Option const* findOption(std::span<const Option> options, std::string_view name);
/// The valid values in words: "metres from 0 to 10000", "table or analytic".
std::string rangeOf(Option const& option);

// The same for any described struct; `object` points to one whose options these are.
Result<void> setOption(std::span<const Option> options, void* object, std::string_view name, std::string_view value);
std::string optionValue(Option const& option, void const* object);
void clampOptions(std::span<const Option> options, void* object, void const* defaults);

template <class T>
concept HasOptions = requires {
    optionsOf<T>();
};

/// Sets one option by name. After an error `object` is unchanged.
template <HasOptions T>
Result<void> setOption(T& object, std::string_view name, std::string_view value) {
    return setOption(optionsOf<T>(), &object, name, value);
}

/// The value of an option as text that setOption() accepts; nothing for an unknown name.
template <HasOptions T>
std::optional<std::string> optionValue(T const& object, std::string_view name) {
    Option const* option = findOption(optionsOf<T>(), name);
    return option ? std::optional(optionValue(*option, &object)) : std::nullopt;
}

/// A copy with every option within its range.
template <HasOptions T>
T clamped(T const& object) {
    T result = object;
    const T defaults{};
    clampOptions(optionsOf<T>(), &result, &defaults);
    return result;
}

} // namespace filament_core
