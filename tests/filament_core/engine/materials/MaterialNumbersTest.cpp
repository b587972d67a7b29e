// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/MaterialNumbers.h"

#include <gtest/gtest.h>

namespace filament_core::engine {
namespace {

TEST(MaterialNumbers, AscendWhateverIsGivenBack) {
    MaterialNumbers numbers;
    EXPECT_EQ(numbers.take(), 0u);
    EXPECT_EQ(numbers.take(), 1u);
    numbers.giveBack(0);
    EXPECT_EQ(numbers.take(), 2u) << "draws are sorted by them";
}

TEST(MaterialNumbers, BeginAgainWithThoseThatAreFreeOnceAllWereUsed) {
    MaterialNumbers numbers;
    const uint32_t kept = numbers.take();
    for (uint32_t i = 1; i < MaterialNumbers::kCount; ++i) numbers.giveBack(numbers.take());
    EXPECT_EQ(numbers.take(), kept + 1) << "the first one lives";
    for (uint32_t i = 2; i < MaterialNumbers::kCount; ++i) numbers.take();
    EXPECT_THROW(numbers.take(), OutOfHandles);
    numbers.giveBack(7);
    EXPECT_EQ(numbers.take(), 7u);
}

TEST(MaterialNumbersDeathTest, AreGivenBackOnce) {
    MaterialNumbers numbers;
    numbers.giveBack(numbers.take());
    EXPECT_DEATH(numbers.giveBack(0), "given back once");
}

} // namespace
} // namespace filament_core::engine
