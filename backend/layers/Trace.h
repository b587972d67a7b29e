// SPDX-License-Identifier: Apache-2.0
/// Trace: command streams as readable text, and back.
///   Text     line 1 "filament-trace 1"; then "Stream" begins a submission and every other line is one command with
///            named fields: Draw vertexCount=3 instanceCount=2. Fields with their default value are left out.
///            '#' begins a comment.
///   Values   numbers; names of enumerators, flags joined by '|'; handles index.generation; "text" with \xNN escapes;
///            {structs}; [arrays], trailing defaults left out; bytes as hex, above 64 as @offset+size in the side file.
///   Blob     the side file (FILE.bin): large payloads in sequence, in the order of the text.
///   Exact    write(read(write(x))) == write(x), byte for byte; floats are shortest round-trip decimals.
///   Fails    readTrace() with Corrupt and a line number, for any bytes; never crashes, and never allocates more than a
///            small multiple of its input.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "base/Result.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::backend {

struct TraceText {
    std::string text;
    std::vector<std::byte> blob;
};

/// The first line of a trace.
std::string_view traceHeader();

/// Appends one submission; `blobBase` is the size of the side file before out.blob.
void writeTrace(CommandView commands, TraceText& out, size_t blobBase = 0);

/// One command buffer for each submission of the trace.
Result<std::vector<CommandBuffer>> readTrace(std::string_view text, std::span<const std::byte> blob);

} // namespace filament_core::backend
