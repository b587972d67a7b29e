// SPDX-License-Identifier: Apache-2.0
// The costs of recording, joining, hashing and replaying commands. `ns` is the median per item; an item is a draw
// unless stated otherwise. Counters named vs_* are ratios of medians measured in turns within the same run; below 1
// means faster.
#include "backend/null/NullDriver.h"
#include "backend/stream/CommandBuffer.h"
#include "backend/stream/StreamHash.h"
#include "bench/backend/stream/InTurns.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <memory>
#include <vector>

namespace filament_core::backend {
namespace {

using bench::measureInTurns;

constexpr uint32_t kDraws = 10'000;

/// A sorted list as the passes leave it once redundant state is dropped: every 2nd draw has another geometry, every 4th
/// another material, every 32nd another pipeline, every 256th another window of objects. 2.3 commands per draw.
void recordSortedDraws(CommandBuffer& commands, uint32_t draws) {
    for (uint32_t i = 0; i < draws; ++i) {
        if (i % 32 == 0) commands.record(CmdBindPipeline{ PipelineHandle{ i } });
        if (i % 256 == 0) commands.record(CmdBindGroup{ BindGroupHandle{ 1 }, 0, 3, { 0, i * 64, 0 } });
        if (i % 4 == 0) commands.record(CmdBindGroup{ BindGroupHandle{ i }, 1 });
        if (i % 2 == 0) {
            commands.record(CmdBindVertexBuffers{ { BufferHandle{ i }, BufferHandle{ 2 } }, {}, 2 });
            commands.record(CmdBindIndexBuffer{ BufferHandle{ i }, 0, IndexFormat::UInt16 });
        }
        commands.record(CmdDrawIndexed{ 36, 1, i, 0, i % 256 });
    }
}

/// The lower bound for recording: copying as many bytes as the commands take.
template <class C>
class BytesToCopy {
public:
    void copy() {
        for (uint32_t i = 0; i < kDraws; ++i) std::memcpy(mTarget.data() + i * kBytes, mSource.data(), kBytes);
        benchmark::DoNotOptimize(mTarget.data());
        benchmark::ClobberMemory();
    }

private:
    static constexpr size_t kBytes = kCommandAlignment + (sizeof(C) + kCommandAlignment - 1) / 8 * 8;
    std::vector<std::byte> mTarget = std::vector<std::byte>(kBytes * kDraws), mSource = std::vector<std::byte>(kBytes);
};

void recordDraws(benchmark::State& state) {
    CommandBuffer commands;
    BytesToCopy<CmdDrawIndexed> bytes;
    const auto record = [&] {
        commands.reset();
        for (uint32_t i = 0; i < kDraws; ++i) commands.record(CmdDrawIndexed{ 36, 1, i, 0, i % 256 });
    };
    measureInTurns(state, kDraws, "vs_copyingTheBytes", record, [&] { bytes.copy(); });
}
BENCHMARK(recordDraws)->UseManualTime();

void recordSortedDraws(benchmark::State& state) {
    CommandBuffer commands;
    BytesToCopy<CmdDrawIndexed> bytes;
    const auto record = [&] {
        commands.reset();
        recordSortedDraws(commands, kDraws);
    };
    measureInTurns(state, kDraws, "vs_copyingTheDraws", record, [&] { bytes.copy(); });
    state.counters["commandsPerDraw"] = static_cast<double>(commands.commandCount()) / kDraws;
}
BENCHMARK(recordSortedDraws)->UseManualTime();

/// An item is an update.
void recordUpdateOf256Bytes(benchmark::State& state) {
    CommandBuffer commands;
    const std::vector<std::byte> bytes(256);
    std::vector<std::byte> target(bytes.size() * kDraws);
    const auto record = [&] {
        commands.reset();
        for (uint32_t i = 0; i < kDraws; ++i)
            commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
    };
    const auto copy = [&] {
        for (uint32_t i = 0; i < kDraws; ++i) std::memcpy(target.data() + i * bytes.size(), bytes.data(), bytes.size());
        benchmark::ClobberMemory();
    };
    measureInTurns(state, kDraws, "vs_copyingTheBytes", record, copy);
}
BENCHMARK(recordUpdateOf256Bytes)->UseManualTime();

constexpr uint32_t kDrawsPerBuffer = 1000;

/// A frame recorded into `buffers` buffers and joined, compared with the same frame in one buffer.
void recordAndJoin(benchmark::State& state) {
    const auto count = static_cast<size_t>(state.range(0));
    CommandBuffer joined, single;
    std::vector<CommandBuffer> tails(count);
    const auto recordInParts = [&] {
        joined.reset();
        for (CommandBuffer& tail : tails) recordSortedDraws(tail, kDrawsPerBuffer);
        for (CommandBuffer& tail : tails) joined.append(std::move(tail));
    };
    const auto recordInOne = [&] {
        single.reset();
        for (size_t i = 0; i < count; ++i) recordSortedDraws(single, kDrawsPerBuffer);
    };
    measureInTurns(state, count * kDrawsPerBuffer, "vs_oneBuffer", recordInParts, recordInOne);
}
BENCHMARK(recordAndJoin)->ArgName("buffers")->Arg(1)->Arg(10)->Arg(100)->UseManualTime();

/// Only the joining, compared with recording what is joined. An item is a buffer.
void joinBuffers(benchmark::State& state) {
    const auto count = static_cast<size_t>(state.range(0));
    CommandBuffer frame;
    std::vector<CommandBuffer> tails(count);
    const auto record = [&] {
        frame.reset();
        for (CommandBuffer& tail : tails) recordSortedDraws(tail, kDrawsPerBuffer);
    };
    const auto join = [&] {
        for (CommandBuffer& tail : tails) frame.append(std::move(tail));
    };
    record();
    measureInTurns(state, count, "vs_recording", join, record);
}
BENCHMARK(joinBuffers)->ArgName("buffers")->Arg(1)->Arg(10)->Arg(100)->Iterations(200)->UseManualTime();

// ---------------------------------------------------------------------------------------------- replay

struct Silent final : ResultSink {
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

class Replay {
public:
    explicit Replay(CommandBuffer const& commands) : mCommands(commands) {}
    /// Like the driver thread: publishes the command that it is in.
    void watched() {
        const WatchedReplay watched(mProgress);
        mDriver->execute(mCommands.view());
    }
    void unwatched() { mDriver->execute(mCommands.view()); }

private:
    CommandBuffer const& mCommands;
    ReplayProgress mProgress;
    Silent mSink;
    std::unique_ptr<Driver> mDriver = createNullDriver(mSink);
};

/// An item is a command.
void replaySortedDraws(benchmark::State& state) {
    CommandBuffer commands;
    recordSortedDraws(commands, kDraws);
    Replay replay(commands);
    measureInTurns(
            state, commands.commandCount(), "vs_unwatched", [&] { replay.watched(); }, [&] { replay.unwatched(); });
}
BENCHMARK(replaySortedDraws)->UseManualTime();

void replayDraws(benchmark::State& state) {
    CommandBuffer draws, sorted;
    for (uint32_t i = 0; i < kDraws; ++i) draws.record(CmdDrawIndexed{ 36, 1, i, 0, i % 256 });
    recordSortedDraws(sorted, kDraws);
    Replay one(draws), other(sorted);
    measureInTurns(
            state, kDraws, "vs_sortedDraws", [&] { one.watched(); }, [&] { other.watched(); });
}
BENCHMARK(replayDraws)->UseManualTime();

/// The cost that CommandStreamOptions::hashStreams adds on the driver thread. An item is a command.
void hashSortedDraws(benchmark::State& state) {
    CommandBuffer commands;
    recordSortedDraws(commands, kDraws);
    Replay replay(commands);
    measureInTurns(
            state, commands.commandCount(), "vs_replay", [&] { benchmark::DoNotOptimize(hashStream(commands.view())); },
            [&] { replay.watched(); });
}
BENCHMARK(hashSortedDraws)->UseManualTime();

} // namespace
} // namespace filament_core::backend
