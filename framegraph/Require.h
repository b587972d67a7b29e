// SPDX-License-Identifier: Apache-2.0
/// require(): FILAMENT_ASSERT for rules whose message names passes and textures. For the .cpp files of this folder.
///   Cost  the message is formatted only when the rule is broken.
#pragma once

#include "base/Assert.h"

#include <fmt/core.h>

#include <cstddef>
#include <source_location>
#include <string>

namespace filament::framegraph {

/// A format string that remembers who passed it.
struct Rule {
    template <size_t N>
    consteval Rule(const char (&text)[N], std::source_location from = std::source_location::current())
            : format(text), where(from) {}
    const char* format;
    std::source_location where;
};

template <class... Args>
void require(bool condition, Rule rule, Args const&... args) {
    if (condition) [[likely]]
        return;
    const std::string message = fmt::vformat(rule.format, fmt::make_format_args(args...));
    assertionFailed(rule.where.file_name(), static_cast<int>(rule.where.line()), "frame graph", message.c_str());
}

} // namespace filament::framegraph
