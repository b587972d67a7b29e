// SPDX-License-Identifier: Apache-2.0
/// Trace: the recorded commands of one API, ready to be replayed, and what is in them.
///   Out     the streams, and of every frame its passes and draws. No device is needed for that.
///   Limits  kMaxTextBytes and kMaxPayloadBytes.
///   Memory  the payloads once, and the commands.
///   Thread  any; plain values.
///   Fails   NotFound, Unreadable, or Corrupt if the files are not those that were saved, with file and line.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "toolkit/record/Manifest.h"

namespace filament_core::record {

inline constexpr size_t kMaxTextBytes = size_t{ 512 } << 20, kMaxPayloadBytes = size_t{ 3 } << 30;

struct ListedDraw {
    uint32_t position = 0; ///< among the commands of the frame: CmdBeginFrame is 0
    std::string pipeline;  ///< debug name: the material's
    uint32_t vertices = 0, instances = 0;
    bool isIndexed = false;
};

struct ListedPass {
    std::string name;
    uint32_t firstDraw = 0, drawCount = 0; ///< into ListedFrame::draws
    std::vector<std::string> attachments;  ///< "hdr RGBA16F 640x360"
};

/// One call of Renderer::render(): from a CmdBeginFrame to the end of its stream. Numbers are those of CapturedFrame.
struct ListedFrame {
    uint64_t number = 0; ///< of the engine
    size_t stream = 0;   ///< into Trace::streams
    std::vector<ListedPass> passes;
    std::vector<ListedDraw> draws;
};

struct Trace {
    Backend backend = Backend::Null; ///< the API whose shaders it has
    std::vector<backend::CommandBuffer> streams;
    std::vector<ListedFrame> frames;
};

std::vector<ListedFrame> listFrames(std::span<const backend::CommandBuffer> streams);

/// The bytes of a trace, before they are parsed.
struct TraceBytes {
    std::string text, payload;
    uint64_t textHash() const;
    uint64_t payloadHash() const;
};
Result<TraceBytes> readTraceBytes(std::filesystem::path const& folder, Backend backend);
/// `name` begins every message.
Result<Trace> parseTrace(TraceBytes const& bytes, Backend backend, std::string const& name);

/// Fails with Corrupt, too, if sizes or hashes are not those of the record.
Result<Trace> loadTrace(std::filesystem::path const& folder, TraceRecord const& record);

} // namespace filament_core::record
