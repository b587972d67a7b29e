// SPDX-License-Identifier: Apache-2.0
// The serial loop: the cost of the work without any runtime. An empty job is a call that is not inlined.
#include "bench/threading/Runtime.h"

namespace filament_core::bench {
namespace {

[[gnu::noinline]] void emptyJob() { asm volatile(""); }

[[gnu::noinline]] uint32_t callTree(uint32_t depth) {
    if (depth == 0) return 1;
    const uint32_t left = callTree(depth - 1);
    return left + callTree(depth - 1);
}

class SerialRuntime final : public Runtime {
public:
    void enter() override {}
    void leave() override {}

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        for (uint64_t i = 0; i < count * repeats; ++i) emptyJob();
    }

    uint32_t tree(uint32_t depth) override { return callTree(depth); }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        for (uint64_t i = 0; i < repeats; ++i) keep(work.run(0, count, i));
    }

    void chain(uint32_t links, uint64_t repeats) override { emptyJobs(links, repeats); }

    void graph(uint32_t links, uint64_t repeats) override { emptyJobs(links, repeats); }

    void relay(uint32_t links, uint64_t repeats) override { emptyJobs(links, repeats); }

    void spinJobs(std::span<const uint32_t> steps) override {
        for (const uint32_t count : steps) keep(spinSteps(count, count));
    }

    std::optional<int64_t> wakeUp(int64_t) override { return std::nullopt; } // there is no thread to wake
};

} // namespace

std::unique_ptr<Runtime> makeSerialRuntime() { return std::make_unique<SerialRuntime>(); }

} // namespace filament_core::bench
