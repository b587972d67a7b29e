// SPDX-License-Identifier: Apache-2.0
/// require(): FILAMENT_ASSERT for rules whose message names passes and textures. For the .cpp files of this folder.
///   Cost  the message is formatted only when the rule is broken.
#pragma once

#include "base/Assert.h"

#include <fmt/core.h>

#include <cstddef>
#include <string>

namespace filament_core::framegraph {

/// A format string that remembers who passed it.
struct Rule {
    // Not std::source_location: clang 14, which builds the fuzzers, lacks it.
    template <size_t N>
    consteval Rule(const char (&text)[N], const char* callersFile = __builtin_FILE(),
                   int callersLine = __builtin_LINE())
            : format(text), file(callersFile), line(callersLine) {}
    const char* format;
    const char* file;
    int line;
};

template <class... Args>
void require(bool condition, Rule rule, Args const&... args) {
    if (condition) [[likely]]
        return;
    const std::string message = fmt::vformat(rule.format, fmt::make_format_args(args...));
    assertionFailed(rule.file, rule.line, "frame graph", message.c_str());
}

} // namespace filament_core::framegraph
