// SPDX-License-Identifier: Apache-2.0
/// Machine: where and on what the figures were taken, for the report.
///   Fails   never: what the system does not tell is "unknown".
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace filament::bench {

/// Name and value, in the order to print them: cpu, cores, kernel, governor, load average, commit ...
std::vector<std::pair<std::string, std::string>> describeMachine();

} // namespace filament::bench
