// SPDX-License-Identifier: Apache-2.0
// Latencies that are known, told to the meter by two clocks.
#include "tools/view/panels/LatencyMeter.h"

#include <gtest/gtest.h>

namespace filament_core::view {
namespace {

TEST(Percentiles, AreValuesThatOccurred) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    const Percentiles hundred = percentilesOf(values);
    EXPECT_EQ(hundred.count, 100u);
    EXPECT_EQ(hundred.median, 50);
    EXPECT_EQ(hundred.p95, 95);
    EXPECT_EQ(hundred.worst, 100);
    const Percentiles one = percentilesOf({ 7 });
    EXPECT_EQ(one.median, 7);
    EXPECT_EQ(one.p95, 7);
    EXPECT_EQ(percentilesOf({}).count, 0u);
}

TEST(LatencyMeter, MeasuresByTheClockOfThePresents) {
    LatencyMeter meter;
    constexpr double kEngineBegan = 1000; // of the caller's clock
    double now = kEngineBegan;
    for (int frame = 1; frame <= 100; ++frame) {
        now += 0.1;
        const double latency = frame > 90 ? 0.050 : 0.020; // 10 of 100 are slow
        meter.input(now);
        meter.input(now + 0.001); // the first one counts
        meter.sent(now + 0.002);
        EXPECT_EQ(meter.framesInFlight(), 1u);
        const double presented = now + latency;
        // Looks come late by 0 to 9 ms: the least of them tells how the clocks differ.
        meter.look(static_cast<uint64_t>(frame), presented - kEngineBegan,
                   presented + 0.001 * (frame % 10 == 0 ? 0 : 9));
        EXPECT_EQ(meter.framesInFlight(), 0u);
    }
    const Percentiles found = meter.milliseconds();
    EXPECT_EQ(found.count, 100u);
    EXPECT_NEAR(found.median, 20, 1e-6);
    EXPECT_NEAR(found.p95, 50, 1e-6);
    EXPECT_EQ(meter.history().size(), 100u);
    EXPECT_EQ(meter.inFlight().p95, 1);
}

TEST(LatencyMeter, FramesWithoutInputsAreNotMeasured) {
    LatencyMeter meter;
    for (uint64_t i = 1; i <= 5; ++i) {
        meter.sent(static_cast<double>(i));
        meter.look(i, 0, static_cast<double>(i) + 0.5);
    }
    EXPECT_EQ(meter.milliseconds().count, 0u);
    EXPECT_EQ(meter.inFlight().count, 5u);
}

TEST(LatencyMeter, ALateWindowShowsHowFarTheProgramIsAhead) {
    LatencyMeter meter;
    meter.input(0);
    for (int i = 0; i < 3; ++i) meter.sent(0.01 * i);
    EXPECT_EQ(meter.framesInFlight(), 3u);
    EXPECT_TRUE(meter.isWaiting(0.5));
    EXPECT_FALSE(meter.isWaiting(5)) << "the window is hidden";
    meter.look(0, 0, 0.1);
    EXPECT_EQ(meter.milliseconds().count, 0u);
    meter.look(2, 0, 0.2);
    EXPECT_EQ(meter.framesInFlight(), 1u);
    EXPECT_NEAR(meter.milliseconds().median, 200, 1e-9);
    meter.look(~uint64_t{ 0 }, 0, 0.3);
    EXPECT_EQ(meter.framesInFlight(), 0u) << "no more than were sent";
    EXPECT_EQ(meter.inFlight().worst, 3);
}

TEST(LatencyMeter, AnotherEngineBeginsAgainAndTheHistoryStays) {
    LatencyMeter meter;
    meter.input(1);
    meter.sent(1);
    meter.look(1, 0.5, 1.25);
    meter.input(2);
    meter.sent(2);
    meter.reset();
    EXPECT_EQ(meter.framesInFlight(), 0u);
    EXPECT_EQ(meter.milliseconds().count, 1u);
    meter.input(3);
    meter.sent(3);
    meter.look(1, 0.01, 3.5); // by another clock
    EXPECT_NEAR(meter.milliseconds().worst, 500, 1e-9);
}

TEST(LatencyMeter, KeepsTheLastFrames) {
    LatencyMeter meter;
    for (uint64_t i = 1; i <= 3 * LatencyMeter::kFrames; ++i) {
        meter.input(static_cast<double>(i));
        meter.sent(static_cast<double>(i));
        meter.look(i, 0, static_cast<double>(i) + 0.25);
    }
    EXPECT_EQ(meter.milliseconds().count, LatencyMeter::kFrames);
}

} // namespace
} // namespace filament_core::view
