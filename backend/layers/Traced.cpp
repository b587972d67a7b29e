// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Traced.h"

#include "backend/layers/Trace.h"
#include "base/Assert.h"
#include "base/Log.h"

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace filament_core::backend {
namespace {

std::filesystem::path blobPath(std::filesystem::path const& path) { return path.string() + ".bin"; }

class Traced final : public Driver {
public:
    Traced(std::unique_ptr<Driver> inner, std::filesystem::path path)
            : mInner(std::move(inner)), mPath(std::move(path)), mText(mPath, std::ios::binary),
              mBlob(blobPath(mPath), std::ios::binary) {
        mText << traceHeader() << "# " << mInner->info().deviceName << ", " << mInner->info().driverName << '\n';
        mText.flush();
    }

    bool writes() const { return mText.good() && mBlob.good(); }

    DeviceInfo const& info() const override { return mInner->info(); }
    void execute(CommandView commands) override {
        // Written and flushed before the driver gets it: if the driver crashes, the trace has the stream that did it.
        if (writes()) write(commands);
        mInner->execute(commands);
    }
    void waitIdle() override { mInner->waitIdle(); }
    DriverStatistics statistics() const override { return mInner->statistics(); }

private:
    void write(CommandView commands) {
        mPending.text.clear();
        mPending.blob.clear();
        writeTrace(commands, mPending, mBlobBytes);
        mBlobBytes += mPending.blob.size();
        // The bytes before the text that refers to them: a trace that ends here is still complete.
        mBlob.write(reinterpret_cast<const char*>(mPending.blob.data()),
                    static_cast<std::streamsize>(mPending.blob.size()));
        mBlob.flush();
        mText << mPending.text;
        mText.flush();
        if (!writes()) log(Severity::Warning, "trace '{}' ends here: it cannot be written any further", mPath.string());
    }

    std::unique_ptr<Driver> mInner;
    const std::filesystem::path mPath;
    std::ofstream mText, mBlob;
    TraceText mPending; // reused, so that its memory is kept between streams
    size_t mBlobBytes = 0;
};

Result<std::string> readFile(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    if (!file || !(content << file.rdbuf()).good()) {
        // An empty file inserts no characters, which sets failbit although it is no error.
        if (file && file.peek() == std::ifstream::traits_type::eof()) return std::string{};
        return fail(ErrorCode::Unreadable, "cannot read '{}'", path.string());
    }
    return std::move(content).str();
}

/// Collects the tickets of the answers that a stream requests.
struct TicketCollector {
    std::vector<Ticket>& tickets;
    template <class C>
    void execute(C const& command) {
        constexpr bool kReads = std::same_as<C, CmdReadTexture> || std::same_as<C, CmdReadBuffer>;
        if constexpr (kReads || std::same_as<C, CmdEndTimer>) tickets.push_back(command.ticket);
    }
};

} // namespace

Result<std::unique_ptr<Driver>> trace(std::unique_ptr<Driver> inner, std::filesystem::path const& path) {
    auto traced = std::make_unique<Traced>(std::move(inner), path);
    if (!traced->writes())
        return fail(ErrorCode::Unreadable, "cannot write trace '{}'; does its folder exist?", path.string());
    return std::unique_ptr<Driver>(std::move(traced));
}

Result<std::vector<CommandBuffer>> loadTrace(std::filesystem::path const& path) {
    const Result<std::string> text = readFile(path);
    if (!text) return text.error();
    const Result<std::string> blob = readFile(blobPath(path));
    if (!blob) return blob.error();
    Result<std::vector<CommandBuffer>> streams = readTrace(*text, std::as_bytes(std::span(*blob)));
    if (!streams) return fail(streams.error().code, "{}: {}", path.string(), streams.error().message);
    return streams;
}

Result<std::vector<Ticket>> replayTrace(std::filesystem::path const& path, CommandStream& to) {
    FILAMENT_ASSERT(to.liveHandles() == 0, "a trace is replayed on a stream on which nothing lives");
    Result<std::vector<CommandBuffer>> streams = loadTrace(path);
    if (!streams) return streams.error();
    std::vector<Ticket> tickets;
    TicketCollector collector{ tickets };
    for (CommandBuffer& stream : *streams) {
        replay(stream.view(), collector);
        CommandBuffer& commands = to.acquire();
        commands.append(std::move(stream));
        to.submit(commands);
    }
    return tickets;
}

} // namespace filament_core::backend
