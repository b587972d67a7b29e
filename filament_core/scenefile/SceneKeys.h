// SPDX-License-Identifier: Apache-2.0
/// SceneKeys: the keys of SceneFile::get(), set() and erase(), and the values that set() takes.
///   In      "points[0].candela", "effects.fog.density": a part up to a dot is an object if the tree or the schema has
///           an object or a list of that name there; otherwise what is left is the name of a field.
///   Fails   InvalidArgument: the key and the place in it.
///   Thread  any; pure.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <string>
#include <string_view>
#include <vector>

namespace filament_core::scenefile {

/// A member of an object, or a place in a list.
struct KeyStep {
    std::string member{};
    size_t place = 0;
    bool isPlace = false;
};

struct Key {
    std::vector<KeyStep> steps{};
    Json const* schema = nullptr; ///< of the value; null: unknown
};

Result<Key> parseKey(std::string_view key, Json const& tree, Json const& schema);

/// Null: the tree does not have it.
Json const* find(Json const& tree, Key const& key);
/// JSON, or words as command lines have them, as the schema expects them.
Json valueOf(std::string_view words, Json const* schema);
Result<void> put(Json& tree, Key const& key, Json value);
/// False: the tree does not have it.
bool take(Json& tree, Key const& key);

} // namespace filament_core::scenefile
