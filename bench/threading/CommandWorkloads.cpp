// SPDX-License-Identifier: Apache-2.0
// The cost of recording a draw command, and of replaying it on the driver without a device, beside copying as many
// bytes.
#include "backend/null/NullDriver.h"
#include "backend/stream/CommandBuffer.h"
#include "bench/threading/Clock.h"
#include "bench/threading/SpinWork.h"
#include "bench/threading/Workloads.h"

#include <cstring>

namespace filament_core::bench {
namespace {

using namespace backend;

constexpr uint32_t kDraws = 10'000;

struct Silent final : ResultSink {
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

void recordDraws(CommandBuffer& commands) {
    commands.reset();
    for (uint32_t i = 0; i < kDraws; ++i) commands.record(CmdDrawIndexed{ .indexCount = 36, .firstInstance = i });
}

/// Like the passes: a separate group for every draw.
void recordBindsAndDraws(CommandBuffer& commands) {
    commands.reset();
    for (uint32_t i = 0; i < kDraws; ++i) {
        commands.record(CmdBindGroup{ .group = {}, .index = 2, .dynamicCount = 1, .dynamicOffsets = { 256 * i } });
        commands.record(CmdDrawIndexed{ .indexCount = 36, .firstInstance = i });
    }
}

/// Nanoseconds per draw of repeating `work`, which processes kDraws of them.
Sampler perDraw(Settings const& settings, std::function<void()> const& work) {
    return [=, sampleNs = settings.sampleNs](std::vector<double>& figures) {
        work(); // warm up: allocates the chunks and brings them into the cache
        uint64_t repeats = 0;
        const int64_t start = wallNow();
        int64_t elapsed = 0;
        do {
            work();
            ++repeats;
            elapsed = wallNow() - start;
        } while (static_cast<double>(elapsed) < sampleNs);
        figures.push_back(static_cast<double>(elapsed) / static_cast<double>(repeats * kDraws));
    };
}

using Recorder = void (*)(CommandBuffer&);

Workload recording(Settings const& settings, const char* name, const char* title, Recorder record, bool hasTarget) {
    auto commands = std::make_shared<CommandBuffer>();
    record(*commands);
    auto bytes = std::make_shared<std::vector<std::byte>>(commands->bytesUsed());
    auto source = std::make_shared<std::vector<std::byte>>(*bytes);
    Workload workload{
        .name = name, .title = title, .unit = "ns/draw", .kind = "commands", .contenders = {}, .targets = {}
    };
    workload.contenders.push_back({ "ours", perDraw(settings, [=] { record(*commands); }) });
    workload.contenders.push_back({ "copy", perDraw(settings, [=] {
                                        const size_t draw = bytes->size() / kDraws;
                                        for (size_t i = 0; i < kDraws; ++i)
                                            std::memcpy(bytes->data() + i * draw, source->data() + i * draw, draw);
                                        keep(reinterpret_cast<uint64_t>(bytes->data()));
                                    }) });
    if (hasTarget) workload.targets = { { .limit = 10 } };
    return workload;
}

/// A driver and the stream that it replays.
struct Replay {
    Silent sink;
    std::unique_ptr<Driver> driver = createNullDriver(sink);
    CommandBuffer commands;
};

Workload replaying(Settings const& settings, const char* name, const char* title, Recorder record, bool hasTarget) {
    auto replay = std::make_shared<Replay>();
    record(replay->commands);
    Workload workload{
        .name = name, .title = title, .unit = "ns/draw", .kind = "commands", .contenders = {}, .targets = {}
    };
    workload.contenders.push_back(
            { "ours", perDraw(settings, [=] { replay->driver->execute(replay->commands.view()); }) });
    if (hasTarget) workload.targets = { { .limit = 5 } };
    return workload;
}

} // namespace

void addCommandWorkloads(WorkloadList& list, Settings const& settings) {
    list.push_back(
            { "record_draw", [=] { return recording(settings, "record_draw", "record a draw", recordDraws, true); } });
    list.push_back(
            { "replay_draw", [=] { return replaying(settings, "replay_draw", "replay a draw", recordDraws, true); } });
    list.push_back({ "record_bind_draw", [=] {
                        return recording(settings, "record_bind_draw", "record bind and draw", recordBindsAndDraws,
                                         false);
                    } });
    list.push_back({ "replay_bind_draw", [=] {
                        return replaying(settings, "replay_bind_draw", "replay bind and draw", recordBindsAndDraws,
                                         false);
                    } });
}

} // namespace filament_core::bench
