// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/CommandStream.h"

#include "backend/stream/DriverThread.h"
#include "backend/stream/ResultMailbox.h"
#include "base/OutOfMemory.h"

#include <algorithm>
#include <atomic>

namespace filament_core::backend {
namespace {

std::atomic<uint64_t> gLastTicket{ 0 }; // tickets are never reused within a process

} // namespace

struct CommandStream::State {
    explicit State(CommandStreamOptions const& options) : driver(options, mailbox) {}

    ResultMailbox mailbox; // must outlive the driver, which delivers answers to it
    DriverThread driver;
    HandleAllocator<BufferTag> buffers;
    HandleAllocator<TextureTag> textures;
    HandleAllocator<SamplerTag> samplers;
    HandleAllocator<ProgramTag> programs;
    HandleAllocator<PipelineTag> pipelines;
    HandleAllocator<BindGroupTag> bindGroups;
    HandleAllocator<SurfaceTag> surfaces;

    /// ResultMailbox::waitFor(), which also checks the driver thread from time to time.
    ResultMailbox::Wait waitFor(Ticket ticket, uint64_t submission, std::chrono::steady_clock::time_point deadline) {
        ReplayWatch& watch = driver.watch();
        while (true) {
            watch.check();
            const auto next = watch.warns() ? std::chrono::steady_clock::now() + watch.period() : deadline;
            const ResultMailbox::Wait outcome = mailbox.waitFor(ticket, submission, std::min(next, deadline));
            if (outcome != ResultMailbox::Wait::TimedOut || next >= deadline) return outcome;
        }
    }
};

CommandStream::CommandStream() = default;
CommandStream::~CommandStream() = default;

Result<std::unique_ptr<CommandStream>> CommandStream::start(DriverFactory factory, CommandStreamOptions options) {
    return orOutOfMemory("driver thread", {}, [&]() -> Result<std::unique_ptr<CommandStream>> {
        std::unique_ptr<CommandStream> stream(new CommandStream);
        stream->mState = std::make_unique<State>(options);
        if (Result<void> started = stream->mState->driver.start(std::move(factory)); !started) return started.error();
        return stream;
    });
}

DeviceInfo const& CommandStream::info() const { return mState->driver.info(); }
DriverStatistics CommandStream::statistics() const { return mState->driver.statistics(); }

BufferHandle CommandStream::allocateBuffer() { return mState->buffers.allocate(); }
TextureHandle CommandStream::allocateTexture() { return mState->textures.allocate(); }
SamplerHandle CommandStream::allocateSampler() { return mState->samplers.allocate(); }
ProgramHandle CommandStream::allocateProgram() { return mState->programs.allocate(); }
PipelineHandle CommandStream::allocatePipeline() { return mState->pipelines.allocate(); }
BindGroupHandle CommandStream::allocateBindGroup() { return mState->bindGroups.allocate(); }
SurfaceHandle CommandStream::allocateSurface() { return mState->surfaces.allocate(); }

void CommandStream::free(BufferHandle handle) { mState->buffers.free(handle); }
void CommandStream::free(TextureHandle handle) { mState->textures.free(handle); }
void CommandStream::free(SamplerHandle handle) { mState->samplers.free(handle); }
void CommandStream::free(ProgramHandle handle) { mState->programs.free(handle); }
void CommandStream::free(PipelineHandle handle) { mState->pipelines.free(handle); }
void CommandStream::free(BindGroupHandle handle) { mState->bindGroups.free(handle); }
void CommandStream::free(SurfaceHandle handle) { mState->surfaces.free(handle); }

uint32_t CommandStream::liveHandles() const {
    return mState->buffers.liveCount() + mState->textures.liveCount() + mState->samplers.liveCount() +
           mState->programs.liveCount() + mState->pipelines.liveCount() + mState->bindGroups.liveCount() +
           mState->surfaces.liveCount();
}

Ticket CommandStream::nextTicket() { return { gLastTicket.fetch_add(1, std::memory_order_relaxed) + 1 }; }

CommandBuffer& CommandStream::acquire() { return mState->driver.acquire(); }
void CommandStream::submit(CommandBuffer& commands) { mState->driver.submit(commands); }
void CommandStream::waitIdle() { mState->driver.waitIdle(); }
void CommandStream::waitReplayed(uint64_t submission) { mState->driver.waitReplayed(submission); }
uint64_t CommandStream::submissions() const { return mState->driver.submissions(); }
uint64_t CommandStream::replayedSubmissions() const { return mState->driver.replayedSubmissions(); }
uint64_t CommandStream::backPressureNanoseconds() const { return mState->driver.backPressureNanoseconds(); }
LatencyStatistics CommandStream::latency() const { return mState->driver.latency(); }
std::vector<FrameTiming> CommandStream::takeTimings() { return mState->mailbox.takeTimings(); }
void CommandStream::takeTimings(std::vector<FrameTiming>& into) { mState->mailbox.takeTimings(into); }

std::optional<std::vector<std::byte>> CommandStream::takeReadback(Ticket ticket) {
    std::optional<std::vector<std::byte>> bytes = mState->mailbox.takeReadback(ticket);
    if (bytes) return bytes;
    DriverThread& driver = mState->driver;
    driver.watch().check(); // an app that only polls reaches no other check
    // Drivers look for answers when they replay: without another stream none would.
    if (driver.replayedSubmissions() == driver.submissions()) driver.requestIdle();
    return bytes;
}

Result<std::vector<std::byte>> CommandStream::waitReadback(Ticket ticket, std::chrono::milliseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    if (std::optional<std::vector<std::byte>> bytes = takeReadback(ticket)) return std::move(*bytes);
    const uint64_t submission = mState->driver.requestIdle(); // otherwise the answer would wait for the next frame
    const ResultMailbox::Wait outcome = mState->waitFor(ticket, submission, deadline);
    if (outcome == ResultMailbox::Wait::Answered) {
        // Two threads may wait for the same ticket; the other one may have taken it.
        if (std::optional<std::vector<std::byte>> bytes = takeReadback(ticket)) return std::move(*bytes);
        return fail(ErrorCode::NotFound, "read-back {} was already taken: each can be taken only once", ticket.value);
    }
    if (outcome == ResultMailbox::Wait::DeviceLost) {
        return fail(ErrorCode::DeviceLost, "read-back {}: the device was lost; make a new engine", ticket.value);
    }
    if (outcome == ResultMailbox::Wait::TimedOut) {
        return fail(ErrorCode::Timeout, "read-back {}: no answer within {} ms; driver thread: {}", ticket.value,
                    timeout.count(), mState->driver.watch().describe());
    }
    return fail(ErrorCode::NotFound,
                "read-back {}: the device finished all submitted work without answering it; was it "
                "submitted, and does takeErrors() say why it failed?",
                ticket.value);
}

bool CommandStream::isDeviceLost() const { return mState->mailbox.deviceLost(); }
std::optional<uint64_t> CommandStream::takeTimer(Ticket ticket) { return mState->mailbox.takeTimer(ticket); }
std::vector<DriverError> CommandStream::takeErrors() { return mState->mailbox.takeErrors(); }

} // namespace filament_core::backend
