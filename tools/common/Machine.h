// SPDX-License-Identifier: Apache-2.0
/// Machine: describes the machine and the build that figures were measured with.
///   Fails   never: unavailable information is "unknown".
#pragma once

#include <string>

namespace filament::tools {

/// Processor, cores, system, load.
std::string describeMachine();
/// The commit that was built, with "-dirty" if files differ from it.
std::string builtCommit();

} // namespace filament::tools
