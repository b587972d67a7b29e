// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, what is pasted into a viewer gives an error of one line
/// that names its source, or a document, a camera or a camera path that is the same again when it is written and read.
#pragma once

#include "base/Assert.h"
#include "tools/view/document/TextForms.h"

#include <cstdint>
#include <span>

namespace filament_core {

/// Returns whether it was one of the three.
inline bool fuzzTextFormsOnce(std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const auto any = view::anyFromJson(text, "fuzz");
    if (!any) {
        FILAMENT_ASSERT(any.error().message.starts_with("fuzz: "), "an error names its source");
        FILAMENT_ASSERT(any.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    const std::string written = std::visit([](auto const& value) { return view::toJson(value); }, *any);
    const auto again = view::anyFromJson(written, "again");
    FILAMENT_ASSERT(again && again->index() == any->index(), "what is written is of the same kind");
    const std::string twice = std::visit([](auto const& value) { return view::toJson(value); }, *again);
    FILAMENT_ASSERT(twice == written, "what is written is what was read");
    return true;
}

} // namespace filament_core
