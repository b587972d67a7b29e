// SPDX-License-Identifier: Apache-2.0
/// Machine: where and of what measured figures are.
///   Fails   never: what the system does not tell is "unknown".
#pragma once

#include <string>

namespace filament::tools {

/// Processor, cores, system, load.
std::string describeMachine();
/// The commit that was built, "-dirty" if files differ from it.
std::string builtCommit();

} // namespace filament::tools
