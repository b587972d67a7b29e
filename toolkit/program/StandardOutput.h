// SPDX-License-Identifier: Apache-2.0
/// finishOutput(): what was printed has reached its destination. Without it, a program that fills a disk through its
/// standard output would end with status 0.
///   Thread  the main thread, after the last line. Fails: Unreadable, once something could not be written.
#pragma once

#include "base/Result.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace filament_core::tools {

inline Error fullOutput(int error) {
    return fail(ErrorCode::Unreadable, "cannot write to the standard output: {}; redirect it to where there is space",
                error != 0 ? std::strerror(error) : "an earlier line failed");
}

inline Result<void> finishOutput() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
    if (errno == 0) { // an earlier line failed; another one says why, if it still does
        std::fputc('\n', stdout);
        std::fflush(stdout);
    }
    return fullOutput(errno);
}

/// Prints all of a text, or says why not.
inline Result<void> printText(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) return fullOutput(errno);
    return finishOutput();
}

} // namespace filament_core::tools
