// SPDX-License-Identifier: Apache-2.0
/// Machine: describes the machine for the report.
///   Fails   never: unavailable information is "unknown".
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace filament::bench {

/// Name and value, in the order to print them: cpu, cores, kernel, governor, load average, commit ...
std::vector<std::pair<std::string, std::string>> describeMachine();

} // namespace filament::bench
