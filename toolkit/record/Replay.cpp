// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/Replay.h"

#include "backend/create/CreateDriver.h"
#include "backend/layers/Validated.h"
#include "backend/null/NullDriver.h"
#include "base/Hash.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::record {
namespace {

using namespace backend;

Backend typeOf(Backend api) { return api == Backend::Vulkan ? Backend::Vulkan : Backend::Gles; }

/// A null driver for traces of any device. Its limits are those of every accepted device, but offsets in a trace fit
/// the alignment of the one that recorded it.
class AnyDevice final : public Driver {
public:
    explicit AnyDevice(ResultSink& sink) : mInner(createNullDriver(sink)), mInfo(mInner->info()) {
        mInfo.limits.uniformOffsetAlignment = mInfo.limits.storageOffsetAlignment = 4;
    }
    DeviceInfo const& info() const override { return mInfo; }
    void execute(CommandView commands) override { mInner->execute(commands); }
    void waitIdle() override { mInner->waitIdle(); }
    DriverStatistics statistics() const override { return mInner->statistics(); }

private:
    std::unique_ptr<Driver> mInner;
    DeviceInfo mInfo;
};

/// Writes down what the driver answers.
class Answers final : public ResultSink {
public:
    Answers(std::vector<uint64_t> const& keep, Replayed& to) : mKeep(keep), mTo(to) {}

    bool isDeviceLost() const { return mIsDeviceLost; }

    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        mTo.answers.push_back({ ticket.value, hashBytes(bytes), bytes.size() });
        if (std::ranges::find(mKeep, ticket.value) != mKeep.end())
            mTo.kept[ticket.value] = { bytes.begin(), bytes.end() };
    }
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind kind, std::string_view message) override {
        if (kind == DriverErrorKind::DeviceLost) mIsDeviceLost = true;
        if (mTo.errors.size() < kMaxErrors) mTo.errors.emplace_back(message);
    }

private:
    std::vector<uint64_t> const& mKeep;
    Replayed& mTo;
    bool mIsDeviceLost = false;
};

Result<void> checkRequest(Trace const& trace, ReplayRequest const& request) {
    if (request.backend != Backend::Null && request.backend != trace.backend)
        return fail(ErrorCode::Unsupported, "a trace of {} has its shaders; {} cannot run them",
                    toString(trace.backend), toString(request.backend));
    for (FrameCut const& cut : request.inside) {
        if (cut.frame >= trace.frames.size())
            return fail(ErrorCode::NotFound, "there is no frame {}; the trace has {}", cut.frame + 1,
                        trace.frames.size());
    }
    return {};
}

/// Innermost the device, around it the layer that looks inside, outermost the validator.
Result<std::unique_ptr<Driver>> makeDriver(ReplayRequest const& request, std::shared_ptr<FrameCapture> const& capture,
                                           ResultSink& sink) {
    auto driver = captured(capture, sink, [&request](ResultSink& results) -> Result<std::unique_ptr<Driver>> {
        if (request.backend == Backend::Null) return std::unique_ptr<Driver>(std::make_unique<AnyDevice>(results));
        return createDriver(typeOf(request.backend), { .requireDevice = request.requireDevice }, results);
    });
    if (!driver) return driver.error();
    return validate(std::move(*driver), sink);
}

/// Replays one stream; with a cut, waits for the inside of its frame.
Result<void> replayStream(Driver& driver, FrameCapture& capture, CommandView stream, FrameCut const* cut,
                          Replayed& to) {
    if (!cut) {
        driver.execute(stream);
        return {};
    }
    capture.arm({ .drawLimit = cut->drawLimit });
    driver.execute(stream);
    driver.waitIdle();
    std::optional<CapturedFrame> frame = capture.take();
    if (!frame)
        return fail(ErrorCode::Corrupt, "frame {} cannot be looked into: {}", cut->frame + 1,
                    to.errors.empty() ? "its stream has several" : to.errors.front());
    to.inside.push_back(std::move(*frame));
    return {};
}

Result<void> replayStreams(Driver& driver, FrameCapture& capture, Trace const& trace, ReplayRequest const& request,
                           Answers const& answers, Replayed& to) {
    auto cut = request.inside.begin();
    for (size_t i = 0; i < trace.streams.size() && !answers.isDeviceLost(); ++i) {
        const bool isCut = cut != request.inside.end() && trace.frames[cut->frame].stream == i;
        const FrameCut* const here = isCut ? &*cut++ : nullptr;
        if (Result<void> done = replayStream(driver, capture, trace.streams[i].view(), here, to); !done) return done;
    }
    driver.waitIdle();
    if (cut == request.inside.end()) return {};
    return fail(ErrorCode::Corrupt, "frame {} was not replayed: {}", cut->frame + 1,
                to.errors.empty() ? "it shares its stream with another one" : to.errors.front());
}

} // namespace

Result<Replayed> replayTrace(Trace const& trace, ReplayRequest const& request) {
    if (Result<void> possible = checkRequest(trace, request); !possible) return possible.error();
    Replayed result;
    Answers answers(request.keep, result);
    const auto capture = std::make_shared<FrameCapture>(request.edit ? request.edit() : nullptr);
    Result<std::unique_ptr<Driver>> driver = makeDriver(request, capture, answers);
    if (!driver) return driver.error();
    result.device = (*driver)->info().deviceName;
    result.driver = (*driver)->info().driverName;
    if (Result<void> done = replayStreams(**driver, *capture, trace, request, answers, result); !done)
        return done.error();
    driver->reset(); // its last errors belong to the result
    return result;
}

tools::FrameSource frameOf(Trace const& trace, ReplayRequest const& request, uint32_t frame) {
    return [&trace, request, frame](uint32_t drawLimit) -> Result<CapturedFrame> {
        ReplayRequest cut = request;
        cut.inside = { { frame, drawLimit } };
        Result<Replayed> replayed = replayTrace(trace, cut);
        if (!replayed) return replayed.error();
        return std::move(replayed->inside.front());
    };
}

FrameRecord recordOf(CapturedFrame const& frame, uint32_t index) {
    FrameRecord record{ .index = index };
    for (CapturedPass const& pass : frame.passes) {
        PassRecord& into = record.passes.emplace_back();
        into.name = pass.name;
        into.draws = pass.drawCount;
        for (CapturedAttachment const& attachment : pass.attachments) {
            into.attachments.push_back({ .name = attachment.name,
                                         .format = attachment.format,
                                         .size = { attachment.width, attachment.height },
                                         .hash = hashBytes(attachment.bytes) });
        }
    }
    return record;
}

} // namespace filament_core::record
