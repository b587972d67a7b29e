// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"

#include "base/ApiCall.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace filament_core {
namespace {

[[noreturn]] void abortWith(std::string const& message) {
    std::fprintf(stderr, "%s\n", message.c_str());
    std::fflush(stderr);
    std::abort();
}

/// "Scene::add(RenderableDesc) of 'ball': "; empty outside of public functions.
std::string callPrefix() {
    if (!tApiCall.function) return {};
    std::string text = tApiCall.function;
    if (!tApiCall.object.empty()) text.append(" of '").append(tApiCall.object).append("'");
    return text + ": ";
}

} // namespace

void misused(std::string_view what) { abortWith(callPrefix().append(what)); }

void assertionFailed(const char* file, int line, const char* condition, const char* rule) {
    std::string message =
            callPrefix() + "rule broken: " + rule + " (" + condition + ", " + file + ":" + std::to_string(line) + ")";
    if (tAssertContext) message.append(" in job \"").append(tAssertContext).append("\"");
    abortWith(message);
}

} // namespace filament_core
