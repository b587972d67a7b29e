// SPDX-License-Identifier: Apache-2.0
/// describeMachine: the origin of the figures: processor, cores, system; commit; date (UTC).
///   Fails   never: unavailable information is "unknown".
#pragma once

#include "tools/accuracy/Results.h"

namespace filament::accuracy {

/// Fills machine, commit and date in.
void describeMachine(Results& results);

} // namespace filament::accuracy
