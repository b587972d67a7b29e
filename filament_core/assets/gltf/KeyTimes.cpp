// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/KeyTimes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace filament_core::assets {
namespace {

/// By key: whether its values are finite, those of its tangents included.
std::vector<bool> findFinite(AnimationSampler const& sampler) {
    const size_t row = sampler.values.size() / sampler.times.size();
    std::vector<bool> isFinite(sampler.times.size(), true);
    for (size_t i = 0; i < sampler.values.size(); ++i) {
        if (!std::isfinite(sampler.values[i])) isFinite[i / row] = false;
    }
    return isFinite;
}

/// What is wrong with the keys as the file has them.
KeyRepairs findFaults(std::vector<float> const& times, std::vector<bool> const& hasFiniteValues) {
    KeyRepairs faults;
    float before = -std::numeric_limits<float>::infinity();
    for (size_t i = 0; i < times.size(); ++i) {
        const float time = times[i];
        if (!std::isfinite(time)) {
            ++faults.endless;
            continue;
        }
        if (!hasFiniteValues[i]) {
            ++faults.broken;
            continue;
        }
        faults.negative += time < 0;
        faults.earlier += time < before;
        before = time;
    }
    return faults;
}

size_t countRepeated(std::vector<float> const& times) {
    size_t count = 0;
    for (size_t i = 1; i < times.size(); ++i) count += times[i] == times[i - 1];
    return count;
}

/// Keys with finite times and values, by time; of equal times in the order of the file.
std::vector<size_t> orderOf(std::vector<float> const& times, std::vector<bool> const& hasFiniteValues) {
    std::vector<size_t> order(times.size());
    std::iota(order.begin(), order.end(), size_t{ 0 });
    std::erase_if(order, [&](size_t key) { return !std::isfinite(times[key]) || !hasFiniteValues[key]; });
    // Stable: of keys at one time, the last of the file holds from there on.
    std::ranges::stable_sort(order, {}, [&](size_t key) { return times[key]; });
    return order;
}

void reorder(AnimationSampler& sampler, std::vector<size_t> const& order) {
    const size_t row = sampler.values.size() / sampler.times.size();
    std::vector<float> times, values;
    times.reserve(order.size());
    values.reserve(order.size() * row);
    for (const size_t key : order) {
        times.push_back(sampler.times[key]);
        const auto first = sampler.values.begin() + static_cast<std::ptrdiff_t>(key * row);
        values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(row));
    }
    sampler.times = std::move(times);
    sampler.values = std::move(values);
}

} // namespace

KeyRepairs& KeyRepairs::operator+=(KeyRepairs const& other) {
    endless += other.endless, broken += other.broken, earlier += other.earlier, repeated += other.repeated,
            negative += other.negative;
    return *this;
}

KeyRepairs mendKeys(AnimationSampler& sampler) {
    const std::vector<bool> hasFiniteValues = findFinite(sampler);
    KeyRepairs repairs = findFaults(sampler.times, hasFiniteValues);
    if (repairs.endless + repairs.broken + repairs.earlier > 0)
        reorder(sampler, orderOf(sampler.times, hasFiniteValues));
    // Counted in the sorted list, where equal times are neighbours.
    repairs.repeated = countRepeated(sampler.times);
    return repairs;
}

std::string toString(KeyRepairs const& repairs) {
    std::string text;
    const auto add = [&](size_t count, const char* what) {
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    };
    add(repairs.repeated, "at the time of another (the last of them holds from there on)");
    add(repairs.earlier, "earlier than the one before (sorted)");
    add(repairs.negative, "before 0");
    add(repairs.endless, "without a finite time (left out)");
    add(repairs.broken, "with values that are not finite (left out)");
    return text;
}

std::string listOfNumbers(std::span<const size_t> numbers) {
    constexpr size_t kMostRanges = 16;
    std::string text;
    size_t ranges = 0;
    for (size_t i = 0; i < numbers.size(); ++ranges) {
        if (ranges == kMostRanges) return text + fmt::format(" and {} more", numbers.size() - i);
        size_t end = i + 1;
        while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
        text += fmt::format("{}{}", i == 0 ? "" : ", ", numbers[i]);
        if (end - i > 1) text += fmt::format("{}{}", end - i == 2 ? ", " : "-", numbers[end - 1]);
        i = end;
    }
    return text;
}

} // namespace filament_core::assets
