// SPDX-License-Identifier: Apache-2.0
/// readOptions: the options of a struct (Options.h) that a JSON object names, as words, numbers, switches or lists of
/// numbers.
///   Fails   as JsonReader, with what setOption() says.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/Options.h>

namespace filament_core::scenefile {

/// One option as a field.
void readOption(JsonReader& reader, Option const& option, std::span<const Option> options, void* object);

template <HasOptions T>
void readOptions(JsonReader& reader, T& object) {
    for (Option const& option : optionsOf<T>()) readOption(reader, option, optionsOf<T>(), &object);
}

/// The value of an option as files have it: a number, a list, a switch or a word.
Json optionJson(Option const& option, void const* object);

} // namespace filament_core::scenefile
