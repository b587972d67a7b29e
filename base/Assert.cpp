// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"

#include <cstdio>
#include <cstdlib>

namespace filament {

void assertionFailed(const char* file, int line, const char* condition, const char* rule) {
    const char* context = tAssertContext;
    std::fprintf(stderr, "%s:%d: rule broken: %s (%s)%s%s%s\n", file, line, rule, condition,
                 context ? " in job \"" : "", context ? context : "", context ? "\"" : "");
    std::fflush(stderr);
    std::abort();
}

} // namespace filament
