// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameTimingLog.h"

#include "jobsystem/JobTrace.h"

#include <algorithm>
#include <bit>
#include <new>

namespace filament_core::engine {
namespace {

using namespace std::chrono;

int64_t nanoseconds(FrameTimingLog::TimePoint point) {
    return duration_cast<std::chrono::nanoseconds>(point.time_since_epoch()).count();
}

double milliseconds(FrameTimingLog::TimePoint from, FrameTimingLog::TimePoint to) {
    return duration<double, std::milli>(to - from).count();
}

} // namespace

FrameTimingLog::FrameTimingLog(Engine::Impl& engine) : mEngine(engine) {
    for (Dependent* dependent : engine.dependents) {
        if (auto const* other = dynamic_cast<FrameTimingLog const*>(dependent))
            mRange = std::max(mRange, other->mRange + 1);
    }
    engine.dependents.push_back(this);
    mIsListed = true;
}

FrameTimingLog::~FrameTimingLog() {
    if (mIsListed) std::erase(mEngine.dependents, this);
}

FrameTimingLog* FrameTimingLog::logOf(uint64_t numberInStream) {
    for (Dependent* dependent : mEngine.dependents) {
        auto* const log = dynamic_cast<FrameTimingLog*>(dependent);
        if (log && log->mRange == numberInStream >> kFrameBits) return log;
    }
    return nullptr; // its renderer is gone
}

void FrameTimingLog::keep(backend::FrameTiming const& replay) {
    const uint64_t frame = frameOf(replay.frame);
    Record& record = mRecords[frame % mRecords.size()];
    if (record.frame != frame || record.taken) return;
    record.replay = replay;
    record.replayed = true;
}

void FrameTimingLog::add(uint64_t frame, Stamps const& stamps, std::span<const framegraph::PassTimer> timers) {
    collectTimers(); // the stream keeps answers only for a limited time
    // Without memory the frame is drawn and its passes have no times.
    if (!makeRoom(timers.size())) timers = {};
    Record& record = mRecords[frame % mRecords.size()];
    record.frame = mNewest = frame;
    record.stamps = stamps;
    record.replay = {};
    record.replayed = record.taken = false;
    record.passes.resize(timers.size());
    record.waiting = timers.size();
    for (size_t i = 0; i < timers.size(); ++i) {
        record.passes[i] = { .ticket = timers[i].ticket };
        timers[i].name.copy(record.passes[i].name.data(), record.passes[i].name.size() - 1);
    }
    if (!mEngine.jobs.trace()) return;
    traceFrame(record);
    collectReplays(); // at once, so that a trace has every replay, requested or not
}

void FrameTimingLog::traceFrame(Record const& record) {
    jobs::JobTrace& trace = *mEngine.jobs.trace();
    const auto frame = static_cast<int64_t>(record.frame);
    const auto track = trace.track("app thread");
    const int64_t prepared = nanoseconds(record.stamps.prepared), acquired = nanoseconds(record.stamps.acquired);
    trace.span(track, "prepare frame", nanoseconds(record.stamps.begin), prepared, frame);
    trace.span(track, "wait for driver", prepared, acquired, frame);
    trace.span(track, "record frame", acquired, nanoseconds(record.stamps.recorded), frame);
}

void FrameTimingLog::traceReplay(backend::FrameTiming const& replay) {
    jobs::JobTrace& trace = *mEngine.jobs.trace();
    const char* name = replay.isFrame ? "replay frame" : "replay set-up";
    trace.span(trace.track("driver thread"), name, replay.replayBegin, replay.replayEnd,
               replay.isFrame ? static_cast<int64_t>(frameOf(replay.frame)) : -1);
}

void FrameTimingLog::collectReplays() {
    mEngine.stream->takeTimings(mReplays);
    for (backend::FrameTiming const& replay : mReplays) {
        if (mEngine.jobs.trace()) traceReplay(replay);
        if (!replay.isFrame) continue;
        if (FrameTimingLog* const log = logOf(replay.frame)) log->keep(replay);
    }
}

bool FrameTimingLog::makeRoom(size_t passes) noexcept {
    if (passes <= mPassRoom) return true;
    const size_t room = std::bit_ceil(passes);
    try {
        for (Record& record : mRecords) record.passes.reserve(room);
    } catch (std::bad_alloc const&) {
        return false;
    }
    mPassRoom = room;
    return true;
}

void FrameTimingLog::collectTimers() {
    for (Record& record : mRecords) {
        for (size_t i = 0; record.waiting > 0 && i < record.passes.size(); ++i) {
            Pass& pass = record.passes[i];
            if (pass.milliseconds >= 0) continue;
            const auto answer = mEngine.stream->takeTimer(pass.ticket);
            if (!answer) break; // passes end in order
            pass.milliseconds = static_cast<double>(*answer) * 1e-6;
            --record.waiting;
        }
    }
}

double FrameTimingLog::deviceMilliseconds(Record const& record) {
    double sum = 0;
    for (Pass const& pass : record.passes) sum += pass.milliseconds;
    return sum;
}

double FrameTimingLog::replayMilliseconds(Record const& record) {
    return static_cast<double>(record.replay.replayEnd - record.replay.replayBegin) * 1e-6;
}

FrameTimings FrameTimingLog::publish(Record const& record) const {
    FrameTimings timings;
    timings.frame = record.frame;
    timings.prepareMilliseconds = milliseconds(record.stamps.begin, record.stamps.prepared);
    timings.recordMilliseconds = milliseconds(record.stamps.acquired, record.stamps.recorded);
    timings.replayMilliseconds = replayMilliseconds(record);
    timings.workerBusyMilliseconds = static_cast<double>(record.stamps.workerBusyNanoseconds) * 1e-6;
    timings.packetHash = record.stamps.packetHash;
    timings.streamHash = record.replay.hash;
    timings.beginSeconds = mEngine.secondsSinceStart(nanoseconds(record.stamps.begin));
    timings.submitSeconds = mEngine.secondsSinceStart(nanoseconds(record.stamps.recorded));
    timings.replayBeginSeconds = mEngine.secondsSinceStart(record.replay.replayBegin);
    timings.replayEndSeconds = mEngine.secondsSinceStart(record.replay.replayEnd);
    for (Pass const& pass : record.passes) timings.passes.push_back({ pass.name.data(), pass.milliseconds });
    timings.gpuMilliseconds = deviceMilliseconds(record);
    return timings;
}

std::vector<FrameTimings> FrameTimingLog::take() {
    collectReplays();
    collectTimers();
    std::vector<FrameTimings> finished;
    for (Record& record : mRecords) {
        if (record.taken || !record.replayed || record.waiting > 0) continue;
        finished.push_back(publish(record));
        record.taken = true;
    }
    std::sort(finished.begin(), finished.end(),
              [](FrameTimings const& a, FrameTimings const& b) { return a.frame < b.frame; });
    return finished;
}

std::vector<PassTiming> FrameTimingLog::latestPasses() const {
    Record const* latest = nullptr;
    for (Record const& record : mRecords) {
        const bool isTimed = !record.passes.empty() && record.waiting == 0;
        if (isTimed && (!latest || record.frame > latest->frame)) latest = &record;
    }
    std::vector<PassTiming> passes;
    if (!latest) return passes;
    for (Pass const& pass : latest->passes) passes.push_back({ pass.name.data(), pass.milliseconds });
    return passes;
}

} // namespace filament_core::engine
