// SPDX-License-Identifier: Apache-2.0
// Changed words of a module: the check accepts or refuses them, and never fails itself.
#include "tests/fuzz/SpirvFuzzBody.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace filament_core::engine {
namespace {

TEST(CheckSpirv, SurvivesChangedWordsAnywhere) {
    std::mt19937 random(9);
    size_t accepted = 0;
    constexpr int kRounds = 150;
    for (int round = 0; round < kRounds; ++round) {
        std::array<uint8_t, 17> input{};
        for (uint8_t& byte : input) byte = static_cast<uint8_t>(random());
        if (round % 2 == 0) input[7] = input[8] = input[15] = input[16] = 0; // small values reach further
        accepted += test::fuzzSpirv(std::span(input).first(9 + 8 * (random() % 2)));
    }
    EXPECT_LT(accepted, kRounds / 2u);
    EXPECT_TRUE(test::fuzzSpirv(std::array<uint8_t, 1>{})) << "unchanged";
}

} // namespace
} // namespace filament_core::engine
