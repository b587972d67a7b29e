// SPDX-License-Identifier: Apache-2.0
/// hashStream: a 64-bit content hash of a recorded stream: equal streams, equal hashes, on every machine and run.
///   In      the commands in order, every field and every byte of their payloads, by value.
///   Ignores padding, addresses, and chunk boundaries. Tickets are hashed by their first appearance in the stream,
///   because they are numbered per process; frame numbers and handles are hashed as they are.
///   Use     check that two recordings have the same bits: serial and parallel, or two runs.
///   Memory  a list of the stream's tickets, nothing else.
///   Cost    about 15 ns per command, and the bytes of the payloads at 4 bytes per cycle: bench/backend/stream.
#pragma once

#include "backend/api/Commands.h"

#include <cstdint>

namespace filament_core::backend {

uint64_t hashStream(CommandView commands);

} // namespace filament_core::backend
