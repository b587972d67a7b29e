// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace filament_core::bake {
namespace {

std::vector<double> upTo(size_t count) {
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), 1.0);
    std::shuffle(values.begin(), values.end(), std::minstd_rand(static_cast<uint32_t>(count)));
    return values;
}

// The sizes of samples from which on the m-th largest value bounds 95 % with a confidence of 95 %: Somerville 1958,
// "Tables for Obtaining Non-Parametric Tolerance Limits", table 1.
TEST(ToleranceBound, IsTheOrderStatisticOfTheTables) {
    const size_t sizes[] = { 59, 93, 124, 153, 181, 208, 234, 260 };
    for (size_t m = 1; m <= std::size(sizes); ++m) {
        const size_t size = sizes[m - 1];
        EXPECT_EQ(toleranceBound(upTo(size)), double(size - m + 1)) << size;
        const std::optional<double> before = m > 1 ? std::optional(double(size + 1 - m)) : std::nullopt;
        EXPECT_EQ(toleranceBound(upTo(size - 1)), before) << size - 1;
    }
}

TEST(ToleranceBound, FewValuesBoundNothing) {
    EXPECT_FALSE(toleranceBound({}));
    EXPECT_FALSE(toleranceBound(upTo(58)));
}

TEST(ToleranceBound, OfManyValuesIsCloseToTheQuantile) {
    EXPECT_NEAR(*toleranceBound(upTo(65536)), 0.95 * 65536, 0.003 * 65536);
}

} // namespace
} // namespace filament_core::bake
