// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Machine.h"

#include "tools/common/Machine.h"

#include <fmt/chrono.h>

#include <ctime>

namespace filament::accuracy {

void describeMachine(Results& results) {
    results.machine = tools::describeMachine();
    results.commit = tools::builtCommit();
    results.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

} // namespace filament::accuracy
