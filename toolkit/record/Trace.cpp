// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/Trace.h"

#include "backend/api/Format.h"
#include "backend/layers/Trace.h"
#include "base/AsciiText.h"
#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace filament_core::record {
namespace {

using namespace backend;

constexpr size_t kMostOfName = 200; // characters that are shown

/// Follows names from the commands that create objects to those that use them.
class Lister {
public:
    std::vector<ListedFrame> frames;

    void beginStream(size_t stream) {
        mStream = stream;
        mIsInFrame = false;
    }

    template <class C>
    void execute(C const& command) {
        note(command);
        ++mPosition;
    }

private:
    template <class C>
    void note(C const&) {}
    void note(CmdCreateTexture const& command) {
        mTextures[command.handle] =
                fmt::format("{} {} {}x{}", printable(command.desc.debugName, kMostOfName),
                            formatInfo(command.desc.format).name, command.desc.width, command.desc.height);
    }
    void note(CmdDestroyTexture const& command) { mTextures.erase(command.handle); }
    void note(CmdCreatePipeline const& command) {
        mPipelines[command.handle] = printable(command.desc.debugName, kMostOfName);
    }
    void note(CmdDestroyPipeline const& command) { mPipelines.erase(command.handle); }
    void note(CmdBeginFrame const& command) {
        frames.push_back({ .number = command.frame, .stream = mStream });
        mIsInFrame = true;
        mPosition = 0;
    }
    void note(CmdBeginPass const& command) {
        mPipeline = {};
        if (!mIsInFrame) return;
        ListedFrame& frame = frames.back();
        ListedPass& pass = frame.passes.emplace_back();
        pass.name = printable(command.desc.debugName, kMostOfName);
        pass.firstDraw = static_cast<uint32_t>(frame.draws.size());
        const size_t colors = std::min<size_t>(command.desc.layout.colorCount, command.desc.colors.size());
        for (size_t i = 0; i < colors; ++i) attach(pass, command.desc.colors[i].texture);
        if (command.desc.layout.depthFormat != Format::None) attach(pass, command.desc.depth.texture);
    }
    void note(CmdNextSubpass const&) { mPipeline = {}; }
    void note(CmdBindPipeline const& command) { mPipeline = command.pipeline; }
    void note(CmdDraw const& command) { noteDraw(command.vertexCount, command.instanceCount, false); }
    void note(CmdDrawIndexed const& command) { noteDraw(command.indexCount, command.instanceCount, true); }

    void attach(ListedPass& pass, TextureHandle texture) {
        if (const auto found = mTextures.find(texture); found != mTextures.end())
            pass.attachments.push_back(found->second);
    }

    void noteDraw(uint32_t vertices, uint32_t instances, bool isIndexed) {
        if (!mIsInFrame || frames.back().passes.empty()) return;
        const auto name = mPipelines.find(mPipeline);
        frames.back().draws.push_back({ .position = mPosition,
                                        .pipeline = name == mPipelines.end() ? std::string() : name->second,
                                        .vertices = vertices,
                                        .instances = instances,
                                        .isIndexed = isIndexed });
        ++frames.back().passes.back().drawCount;
    }

    std::unordered_map<TextureHandle, std::string> mTextures;
    std::unordered_map<PipelineHandle, std::string> mPipelines;
    PipelineHandle mPipeline;
    size_t mStream = 0;
    uint32_t mPosition = 0;
    bool mIsInFrame = false;
};

Result<std::string> readBytes(std::filesystem::path const& path, size_t most) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        return fail(ErrorCode::NotFound, "'{}' is missing; ask for the whole folder", path.string());
    return assets::readText(path, most);
}

Result<void> compareBytes(std::filesystem::path const& path, std::string const& bytes, uint64_t size, uint64_t hash) {
    if (bytes.size() != size)
        return fail(ErrorCode::Corrupt, "{}: it has {} bytes, but {} were saved; copy the folder again", path.string(),
                    bytes.size(), size);
    if (hashString(bytes) == hash) return {};
    return fail(ErrorCode::Corrupt,
                "{}: its bytes are not those that were saved (hash {:016x} instead of {:016x}); copy the folder again",
                path.string(), hashString(bytes), hash);
}

} // namespace

std::vector<ListedFrame> listFrames(std::span<const CommandBuffer> streams) {
    Lister lister;
    for (size_t i = 0; i < streams.size(); ++i) {
        lister.beginStream(i);
        backend::replay(streams[i].view(), lister);
    }
    return std::move(lister.frames);
}

uint64_t TraceBytes::textHash() const { return hashString(text); }
uint64_t TraceBytes::payloadHash() const { return hashString(payload); }

Result<TraceBytes> readTraceBytes(std::filesystem::path const& folder, Backend backend) {
    Result<std::string> text = readBytes(tracePath(folder, backend), kMaxTextBytes);
    if (!text) return text.error();
    Result<std::string> payload = readBytes(payloadPath(folder, backend), kMaxPayloadBytes);
    if (!payload) return payload.error();
    return TraceBytes{ std::move(*text), std::move(*payload) };
}

Result<Trace> parseTrace(TraceBytes const& bytes, Backend backend, std::string const& name) {
    Result<std::vector<CommandBuffer>> streams = readTrace(bytes.text, std::as_bytes(std::span(bytes.payload)));
    if (!streams) return fail(streams.error().code, "{}: {}", name, streams.error().message);
    Trace trace{ .backend = backend, .streams = std::move(*streams) };
    trace.frames = listFrames(trace.streams);
    return trace;
}

Result<Trace> loadTrace(std::filesystem::path const& folder, TraceRecord const& record) {
    const Result<TraceBytes> bytes = readTraceBytes(folder, record.backend);
    if (!bytes) return bytes.error();
    const std::filesystem::path path = tracePath(folder, record.backend);
    if (Result<void> same = compareBytes(path, bytes->text, record.textBytes, record.textHash); !same)
        return same.error();
    if (Result<void> same = compareBytes(payloadPath(folder, record.backend), bytes->payload, record.payloadBytes,
                                         record.payloadHash);
        !same)
        return same.error();
    return parseTrace(*bytes, record.backend, path.string());
}

} // namespace filament_core::record
