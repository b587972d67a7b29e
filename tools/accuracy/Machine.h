// SPDX-License-Identifier: Apache-2.0
/// describeMachine: where and of what the figures are: processor, cores, system; commit; date (UTC).
///   Fails   never: what the system does not tell is "unknown".
#pragma once

#include "tools/accuracy/Results.h"

namespace filament::accuracy {

/// Fills machine, commit and date in.
void describeMachine(Results& results);

} // namespace filament::accuracy
