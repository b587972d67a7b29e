// SPDX-License-Identifier: Apache-2.0
/// CommandStream: the app's side of the driver. Allocates handles and command buffers, and owns the driver thread.
///   Thread  handles and tickets: any. acquire()/submit(): one app thread. Results: any.
///   Memory  three command buffers, reused; acquire() waits while two submitted frames are still unreplayed.
///   Fails   start() if no driver can be created. After that takeErrors() returns the errors of the device. If the
///           app's thread runs out of memory, the function throws std::bad_alloc and nothing has changed; submit(),
///           destroy() and free() never fail. If the driver thread runs out of memory, the device is lost, with an
///           error.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandBuffer.h"
#include "base/Result.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::backend {

/// Runs on the driver thread; creates the driver that the thread will own.
using DriverFactory = std::function<Result<std::unique_ptr<Driver>>(ResultSink&)>;

struct DriverError {
    DriverErrorKind kind;
    std::string message;
};

/// Wall-clock of the last replayed frame, nanoseconds of steady_clock.
struct FrameTiming {
    uint64_t frame = 0;       ///< CmdBeginFrame::frame, or the running number of the submission
    int64_t submitted = 0;    ///< submit() called
    int64_t replayBegin = 0;  ///< the driver thread took it
    int64_t replayEnd = 0;    ///< the driver thread has finished it (the GPU may still work)
    int64_t backPressure = 0; ///< how long acquire() had waited for this submission's buffer
    bool isFrame = false;     ///< it has a CmdBeginFrame
    uint64_t hash = 0;        ///< hashStream() of it, with CommandStreamOptions::hashStreams
};

/// Nanoseconds. Quantiles by nearest rank: a value that occurred.
struct LatencyDistribution {
    int64_t min = 0, median = 0, p99 = 0, max = 0;
};

/// Over the last frames (submissions with a CmdBeginFrame that reached the driver), at most 256.
struct LatencyStatistics {
    uint32_t frames = 0;                ///< number of frames in the figures
    LatencyDistribution submitToReplay; ///< waiting for the driver thread
    LatencyDistribution replay;         ///< on the driver thread
    LatencyDistribution submitToEnd;    ///< both
    LatencyDistribution backPressure;   ///< acquire() waiting for a buffer
};

/// A wait for a result gives up after this. A frame of a minute is no fault: a driver that draws on the CPU
/// needs it for what a GPU draws at once, for thousands of lights say, and longer on a busy machine.
inline constexpr std::chrono::minutes kLongestFrame{ 15 };

struct CommandStreamOptions {
    uint32_t maxFramesAhead = 2;  ///< submitted but not yet replayed
    int driverCore = -1;          ///< pin the driver thread to this core; -1: no pinning
    bool repinAfterWaits = false; ///< pin it again each time it wakes up: see jobs::AffinityPolicy::repinsAfterWaits
    bool ownThread = true;        ///< false: replay inside submit(), on the caller (single-threaded platforms, tests)
    bool hashStreams = false;     ///< FrameTiming::hash; the driver thread reads every stream once more
    /// If the driver thread stays in one command for this long, the waiting thread reports it in the log, once. 0:
    /// never.
    std::chrono::milliseconds stallWarning = std::chrono::seconds(10);
};

class CommandStream {
public:
    /// Starts the driver thread and waits for the factory's result.
    static Result<std::unique_ptr<CommandStream>> start(DriverFactory factory, CommandStreamOptions options = {});
    /// Replays what was submitted, waits for the device, ends the thread.
    ~CommandStream();
    CommandStream(CommandStream const&) = delete;
    CommandStream& operator=(CommandStream const&) = delete;

    DeviceInfo const& info() const;
    DriverStatistics statistics() const;

    // ---- handles: allocated at once, created when the command is replayed
    BufferHandle allocateBuffer();
    TextureHandle allocateTexture();
    SamplerHandle allocateSampler();
    ProgramHandle allocateProgram();
    PipelineHandle allocatePipeline();
    BindGroupHandle allocateBindGroup();
    SurfaceHandle allocateSurface();
    /// Returns the handle for reuse; call right after recording the matching CmdDestroy.
    void free(BufferHandle handle);
    void free(TextureHandle handle);
    void free(SamplerHandle handle);
    void free(ProgramHandle handle);
    void free(PipelineHandle handle);
    void free(BindGroupHandle handle);
    void free(SurfaceHandle handle);
    /// Records the destruction and returns the handle. Never fails: without memory to record it, object and handle stay
    /// until the driver ends.
    template <class Tag>
    void destroy(CommandBuffer& commands, Handle<Tag> handle) noexcept;
    /// Live handles of all types: zero when everything was destroyed.
    uint32_t liveHandles() const;
    Ticket nextTicket();

    // ---- frames
    /// An empty buffer to record into. Waits for back-pressure (see options.maxFramesAhead).
    CommandBuffer& acquire();
    /// Passes the acquired buffer to the driver thread; returns at once.
    void submit(CommandBuffer& commands);
    /// Waits until everything submitted has been replayed and the device is idle.
    void waitIdle();
    /// Waits until the driver thread has finished that submission; the time counts as back-pressure.
    void waitReplayed(uint64_t submission);
    /// Number of submitted buffers, and how many of them the driver thread has finished.
    uint64_t submissions() const;
    uint64_t replayedSubmissions() const;
    /// Nanoseconds that acquire() and waitReplayed() have waited in total.
    uint64_t backPressureNanoseconds() const;
    std::vector<FrameTiming> takeTimings();
    void takeTimings(std::vector<FrameTiming>& into); ///< replaces what it holds, and keeps its memory
    LatencyStatistics latency() const;

    // ---- answers
    /// Whether the device is lost: submitted work gets no more results.
    bool isDeviceLost() const;
    /// The bytes of a read-back, once; nothing while it is pending.
    std::optional<std::vector<std::byte>> takeReadback(Ticket ticket);
    /// Blocks until a submitted read-back arrives. Timeout if it takes longer (with the command that the driver thread
    /// is in), DeviceLost if the device is gone, NotFound if the device finished all work without a result (the
    /// read-back failed: see takeErrors()).
    Result<std::vector<std::byte>> waitReadback(Ticket ticket, std::chrono::milliseconds timeout = kLongestFrame);
    std::optional<uint64_t> takeTimer(Ticket ticket); ///< GPU nanoseconds
    /// Errors since the last call, oldest first.
    std::vector<DriverError> takeErrors();

private:
    CommandStream();
    struct State;
    std::unique_ptr<State> mState;
};

namespace detail {
inline CmdDestroyBuffer destruction(BufferHandle handle) { return { handle }; }
inline CmdDestroyTexture destruction(TextureHandle handle) { return { handle }; }
inline CmdDestroySampler destruction(SamplerHandle handle) { return { handle }; }
inline CmdDestroyProgram destruction(ProgramHandle handle) { return { handle }; }
inline CmdDestroyPipeline destruction(PipelineHandle handle) { return { handle }; }
inline CmdDestroyBindGroup destruction(BindGroupHandle handle) { return { handle }; }
inline CmdDestroySurface destruction(SurfaceHandle handle) { return { handle }; }
} // namespace detail

template <class Tag>
void CommandStream::destroy(CommandBuffer& commands, Handle<Tag> handle) noexcept {
    try {
        commands.record(detail::destruction(handle));
    } catch (std::bad_alloc const&) {
        return;
    }
    free(handle);
}

/// A handle whose creation is not recorded yet: it is freed unless it is kept.
template <class Tag>
class NewHandle {
public:
    NewHandle(CommandStream& stream, Handle<Tag> handle) : mStream(stream), mHandle(handle) {}
    ~NewHandle() {
        if (mHandle) mStream.free(mHandle);
    }
    NewHandle(NewHandle const&) = delete;
    NewHandle& operator=(NewHandle const&) = delete;

    operator Handle<Tag>() const { return mHandle; }
    Handle<Tag> keep() { return std::exchange(mHandle, {}); }

private:
    CommandStream& mStream;
    Handle<Tag> mHandle;
};

/// The buffer from acquire(), submitted at the end of the scope whatever happens before: caches rely on what is
/// recorded.
class FrameCommands {
public:
    explicit FrameCommands(CommandStream& stream) : mStream(stream), mCommands(stream.acquire()) {}
    ~FrameCommands() { mStream.submit(mCommands); }
    FrameCommands(FrameCommands const&) = delete;
    FrameCommands& operator=(FrameCommands const&) = delete;

    CommandBuffer& operator*() { return mCommands; }
    CommandBuffer* operator->() { return &mCommands; }

private:
    CommandStream& mStream;
    CommandBuffer& mCommands;
};

} // namespace filament_core::backend
