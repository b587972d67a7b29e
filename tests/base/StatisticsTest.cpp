// SPDX-License-Identifier: Apache-2.0
#include "base/Statistics.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using testing::ElementsAre;

TEST(Median, IsTheMiddleValueOrTheMeanOfTheTwoMiddleOnes) {
    EXPECT_EQ(median({ 3, 1, 100 }), 3.0);
    EXPECT_EQ(median({ 4, 1, 2, 100 }), 3.0);
    EXPECT_EQ(median({}), 0.0);
}

TEST(Quartiles, OfOneToFiveAreTwoThreeAndFour) {
    const Quartiles q = quartiles({ 4, 1, 5, 2, 3 });
    EXPECT_EQ(q.first, 2);
    EXPECT_EQ(q.median, 3);
    EXPECT_EQ(q.third, 4);
}

TEST(Quartiles, LieBetweenTheValuesWhenTheCountIsEven) {
    const Quartiles q = quartiles({ 10, 20, 30, 40 });
    EXPECT_DOUBLE_EQ(q.first, 17.5);
    EXPECT_DOUBLE_EQ(q.median, 25);
    EXPECT_DOUBLE_EQ(q.third, 32.5);
}

TEST(Quartiles, OfNothingAreZero) { EXPECT_EQ(quartiles({}).median, 0); }

TEST(Quantile, ReachesTheSmallestAndTheLargestValue) {
    EXPECT_EQ(quantile({ 7, -1, 3 }, 0), -1);
    EXPECT_EQ(quantile({ 7, -1, 3 }, 1), 7);
}

TEST(PairedRatios, AreFormedWithinARoundAndLeaveOutZeros) {
    const double a[] = { 1, 20, 3, 9 }, b[] = { 2, 40, 0 };
    EXPECT_THAT(pairedRatios(a, b), ElementsAre(0.5, 0.5));
}

} // namespace
} // namespace filament_core
