// SPDX-License-Identifier: Apache-2.0
// Every short list of hostile times, sampled beside a second implementation that sorts nothing.
#include "filament_core/assets/gltf/KeyTimes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kHostileTimes[] = { 0, 1, 1.5f, 1e30f, -2, kNan, kInfinity, -kInfinity };

double valueOf(size_t key) { return static_cast<double>(key * key + 3); }

/// Of the keys at or before a moment the latest, of equal ones the last; and of those after it the earliest, of equal
/// ones the first. None: numbers beyond the list.
std::pair<size_t, size_t> around(std::vector<float> const& times, double seconds) {
    size_t before = times.size(), after = times.size();
    for (size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) continue;
        const bool isPast = static_cast<double>(times[i]) <= seconds;
        if (isPast && (before == times.size() || times[i] >= times[before])) before = i;
        if (!isPast && (after == times.size() || times[i] < times[after])) after = i;
    }
    return { before, after };
}

double expectedAt(std::vector<float> const& times, Interpolation interpolation, double seconds) {
    const auto [before, after] = around(times, seconds);
    if (before == times.size()) return valueOf(after);
    const double from = static_cast<double>(times[before]);
    if (after == times.size() || interpolation == Interpolation::Step || from == seconds) return valueOf(before);
    const double share = (seconds - from) / (static_cast<double>(times[after]) - from);
    return valueOf(before) + (valueOf(after) - valueOf(before)) * share;
}

AnimationSampler samplerOf(std::vector<float> const& times, Interpolation interpolation) {
    AnimationSampler sampler{ .interpolation = interpolation, .times = times };
    for (size_t i = 0; i < times.size(); ++i) {
        const auto value = static_cast<float>(valueOf(i));
        if (interpolation == Interpolation::CubicSpline)
            sampler.values.insert(sampler.values.end(), { -value, value, 10 * value });
        else
            sampler.values.push_back(value);
    }
    return sampler;
}

/// Calls visit(times) for all lists of up to four times.
template <class F>
void forEachList(F&& visit) {
    constexpr size_t kTimes = std::size(kHostileTimes);
    for (size_t length = 1, lists = kTimes; length <= 4; ++length, lists *= kTimes) {
        for (size_t list = 0; list < lists; ++list) {
            std::vector<float> times;
            for (size_t i = 0, digits = list; i < length; ++i, digits /= kTimes)
                times.push_back(kHostileTimes[digits % kTimes]);
            visit(times);
        }
    }
}

TEST(KeyTimes, EveryListOfHostileTimesPlaysLikeTheUnsortedList) {
    size_t played = 0;
    forEachList([&](std::vector<float> const& times) {
        for (const Interpolation interpolation : { Interpolation::Step, Interpolation::Linear }) {
            AnimationSampler sampler = samplerOf(times, interpolation);
            mendKeys(sampler);
            const auto finite = std::ranges::count_if(times, [](float time) { return std::isfinite(time); });
            ASSERT_EQ(sampler.times.size(), static_cast<size_t>(finite));
            ASSERT_EQ(sampler.values.size(), sampler.times.size());
            ASSERT_TRUE(std::ranges::is_sorted(sampler.times));
            if (sampler.times.empty()) continue;
            for (const double seconds : { -3.0, -2.0, -1.0, 0.0, 0.5, 1.0, 1.25, 1.5, 2.0, 1e30 }) {
                double value = 0;
                sampleAnimation(sampler, seconds, { &value, 1 });
                ASSERT_EQ(value, expectedAt(times, interpolation, seconds)) << testing::PrintToString(times) << seconds;
                ++played;
            }
        }
    });
    EXPECT_GT(played, 50'000u);
}

TEST(KeyTimes, TangentsMoveWithTheirKeys) {
    forEachList([](std::vector<float> const& times) {
        AnimationSampler sampler = samplerOf(times, Interpolation::CubicSpline);
        mendKeys(sampler);
        ASSERT_EQ(sampler.values.size(), 3 * sampler.times.size());
        for (size_t i = 0; i < sampler.times.size(); ++i) {
            const float value = sampler.values[3 * i + 1];
            const auto key = static_cast<size_t>(std::lround(std::sqrt(value - 3)));
            ASSERT_EQ(sampler.times[i], times[key]);
            ASSERT_EQ(sampler.values[3 * i], -value);
            ASSERT_EQ(sampler.values[3 * i + 2], 10 * value);
        }
    });
}

TEST(KeyTimes, CountsWhatWasWrong) {
    const auto repairsOf = [](std::vector<float> const& times) {
        AnimationSampler sampler = samplerOf(times, Interpolation::Linear);
        return mendKeys(sampler);
    };
    EXPECT_FALSE(repairsOf({ 0, 0.5f, 7 }).any());
    EXPECT_EQ(repairsOf({ 0, 1, 1, 1 }).repeated, 2u);
    EXPECT_EQ(repairsOf({ 0, 2, 1, 2 }).earlier, 1u);
    EXPECT_EQ(repairsOf({ 0, 2, 1, 2 }).repeated, 1u) << "after sorting";
    EXPECT_EQ(repairsOf({ -2, -1, 0 }).negative, 2u);
    EXPECT_EQ(repairsOf({ 0, kNan, kInfinity, 4 }).endless, 2u);
    EXPECT_EQ(repairsOf({ 0, kNan, 1 }).earlier, 0u) << "a time that is left out is before nothing";
    EXPECT_EQ(
            toString(repairsOf({ 0, 2, 1, 2, -1, kNan })),
            "1 at the time of another (the last of them holds from there on), 2 earlier than the one before (sorted), "
            "1 before 0, 1 without a finite time (left out)");
}

TEST(KeyTimes, SamplersInOrderKeepTheirBits) {
    const std::vector<float> times{ 0.1f, 0.3f, 0.7f };
    AnimationSampler sampler = samplerOf(times, Interpolation::CubicSpline);
    const std::vector<float> values = sampler.values;
    EXPECT_FALSE(mendKeys(sampler).any());
    EXPECT_EQ(sampler.times, times);
    EXPECT_EQ(sampler.values, values);
}

TEST(KeyTimes, ListsAreShort) {
    const auto text = [](std::vector<size_t> const& numbers) { return listOfNumbers(numbers); };
    EXPECT_EQ(text({ 3 }), "3");
    EXPECT_EQ(text({ 3, 4 }), "3, 4");
    EXPECT_EQ(text({ 0, 2, 3, 4, 9 }), "0, 2-4, 9");
    std::vector<size_t> even(71);
    for (size_t i = 0; i < even.size(); ++i) even[i] = 2 * i;
    EXPECT_EQ(text(even), "0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30 and 55 more");
}

} // namespace
} // namespace filament_core::assets
