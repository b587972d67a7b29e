// SPDX-License-Identifier: Apache-2.0
// What recording and replaying a command costs, side by side with copying the same bytes.
#include "backend/null/NullDriver.h"
#include "backend/stream/CommandBuffer.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

namespace filament::backend {
namespace {

constexpr uint32_t kDraws = 10'000;

/// The floor: writing as many bytes as a recorded draw takes.
void copyBytesOfDraws(benchmark::State& state) {
    constexpr size_t kBytes =
            kCommandAlignment + (sizeof(CmdDraw) + kCommandAlignment - 1) / kCommandAlignment * kCommandAlignment;
    std::vector<std::byte> memory(kBytes * kDraws);
    const std::vector<std::byte> source(kBytes);
    for (auto _ : state) {
        for (uint32_t i = 0; i < kDraws; ++i) std::memcpy(memory.data() + i * kBytes, source.data(), kBytes);
        benchmark::DoNotOptimize(memory.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * kDraws);
}
BENCHMARK(copyBytesOfDraws);

void recordDraws(benchmark::State& state) {
    CommandBuffer commands;
    for (auto _ : state) {
        commands.reset();
        for (uint32_t i = 0; i < kDraws; ++i) commands.record(CmdDraw{ .vertexCount = i });
    }
    state.SetItemsProcessed(state.iterations() * kDraws);
}
BENCHMARK(recordDraws);

/// One draw as the passes record it: a dynamic offset, then the draw.
void recordBindAndDraw(benchmark::State& state) {
    CommandBuffer commands;
    for (auto _ : state) {
        commands.reset();
        for (uint32_t i = 0; i < kDraws; ++i) {
            commands.record(CmdBindGroup{ .group = {}, .index = 2, .dynamicCount = 1, .dynamicOffsets = { 256 * i } });
            commands.record(CmdDrawIndexed{ .indexCount = 3, .firstInstance = i });
        }
    }
    state.SetItemsProcessed(state.iterations() * kDraws);
}
BENCHMARK(recordBindAndDraw);

void recordUpdateOf256Bytes(benchmark::State& state) {
    CommandBuffer commands;
    const std::vector<std::byte> bytes(256);
    for (auto _ : state) {
        commands.reset();
        for (uint32_t i = 0; i < kDraws; ++i)
            commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
    }
    state.SetItemsProcessed(state.iterations() * kDraws);
}
BENCHMARK(recordUpdateOf256Bytes);

struct Silent final : ResultSink {
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

void replayDrawsOnTheNullDriver(benchmark::State& state) {
    Silent sink;
    const std::unique_ptr<Driver> driver = createNullDriver(sink);
    CommandBuffer commands;
    for (uint32_t i = 0; i < kDraws; ++i) commands.record(CmdDraw{ .vertexCount = i });
    for (auto _ : state) driver->execute(commands.view());
    state.SetItemsProcessed(state.iterations() * kDraws);
}
BENCHMARK(replayDrawsOnTheNullDriver);

} // namespace
} // namespace filament::backend
