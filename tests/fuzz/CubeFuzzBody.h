// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a .cube file gives an error of one line that names
/// the file and a line, or a look that shows finite colours and is the same again when it is written and read.
#pragma once

#include "base/Assert.h"

#include <filament_core/Look.h>

#include <cmath>
#include <cstdint>
#include <span>

namespace filament_core {

/// Returns whether it was a look.
inline bool fuzzCubeOnce(std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const auto look = parseLook(text, "fuzz");
    if (!look) {
        FILAMENT_ASSERT(look.error().message.starts_with("fuzz: line "), "an error names its file and line");
        FILAMENT_ASSERT(look.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    Look const& read = **look;
    const size_t entries = read.isCube ? size_t{ read.size } * read.size * read.size : read.size;
    FILAMENT_ASSERT(read.size >= 2 && read.entries.size() == entries, "a colour for each entry");
    for (const float value : { -1e30f, -1.0f, 0.0f, 0.3f, 1.0f, 7.0f, 1e30f, std::nanf("") }) {
        const float3 shown = lookedUp(read, float3(value, 1 - value, 0.5f));
        FILAMENT_ASSERT(std::isfinite(shown.x) && std::isfinite(shown.y) && std::isfinite(shown.z), "finite colours");
    }
    if (entries > 4096) return true; // writing it takes long
    const auto again = parseLook(cubeText(read), "again");
    FILAMENT_ASSERT(again && **again == read, "what is written is what was read");
    return true;
}

} // namespace filament_core
