// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Statistics.h"

#include "base/Statistics.h"

#include <algorithm>
#include <cstdint>

namespace filament_core::accuracy {
namespace {

constexpr size_t kResamples = 1000;

// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": SplitMix64.
struct SplitMix {
    uint64_t state = 1;
    size_t below(size_t bound) {
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return static_cast<size_t>((z ^ z >> 31) % bound);
    }
};

} // namespace

Estimate estimate(std::span<const double> values) {
    if (values.empty()) return {};
    SplitMix random;
    std::vector<double> medians(kResamples), resample(values.size());
    for (double& one : medians) {
        for (double& value : resample) value = values[random.below(values.size())];
        one = median(resample);
    }
    std::sort(medians.begin(), medians.end());
    return { median({ values.begin(), values.end() }), medians[kResamples * 25 / 1000],
             medians[kResamples * 975 / 1000 - 1] };
}

Estimate estimateRatio(std::span<const double> a, std::span<const double> b) { return estimate(pairedRatios(a, b)); }

} // namespace filament_core::accuracy
