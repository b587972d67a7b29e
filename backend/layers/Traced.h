// SPDX-License-Identifier: Apache-2.0
/// Traced: a layer that writes every stream to a file before executing it, so that the trace survives a crash.
///   Out     PATH (text, see Trace.h) and PATH.bin (large payloads), flushed after each stream.
///   Fails   trace(): Unreadable if the files cannot be created. If the disk fills up later, the trace ends with one
///           warning in the log, and the driver continues.
///   Thread  as the inner driver.  Cost: about 1 us per command and the bytes of its payloads.
/// replayTrace: sends a trace into a fresh stream. The same commands with the same handles give the same bits.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandStream.h"
#include "base/Result.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace filament_core::backend {

Result<std::unique_ptr<Driver>> trace(std::unique_ptr<Driver> inner, std::filesystem::path const& path);

/// One command buffer for each submission. Unreadable or Corrupt with file and line.
Result<std::vector<CommandBuffer>> loadTrace(std::filesystem::path const& path);

/// Submits a whole trace to a stream without live objects: handles and tickets are those of the recording.
///   Returns the tickets requested by the trace, in order.
Result<std::vector<Ticket>> replayTrace(std::filesystem::path const& path, CommandStream& to);

} // namespace filament_core::backend
