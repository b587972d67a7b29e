// SPDX-License-Identifier: Apache-2.0
/// Traced: a driver around a driver that writes every stream to a file before executing it: a crash leaves the trace.
///   Out     PATH (text, see Trace.h) and PATH.bin (large payloads), flushed after each stream.
///   Fails   trace(): Unreadable if the files cannot be made. Later a full disk ends the trace with one warning in the
///           log; the driver goes on.
///   Thread  as the driver inside.  Cost: about 1 us a command and the bytes of its payloads.
/// replayTrace: sends a trace into a fresh stream. The same commands with the same handles give the same bits.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandStream.h"
#include "base/Result.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace filament::backend {

Result<std::unique_ptr<Driver>> trace(std::unique_ptr<Driver> inner, std::filesystem::path const& path);

/// One command buffer for each submission. Unreadable or Corrupt with file and line.
Result<std::vector<CommandBuffer>> loadTrace(std::filesystem::path const& path);

/// Submits all of a trace to a stream on which nothing lives yet: handles and tickets are those of the recording.
///   Returns the tickets that the trace asks for, in order.
Result<std::vector<Ticket>> replayTrace(std::filesystem::path const& path, CommandStream& to);

} // namespace filament::backend
