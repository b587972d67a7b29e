// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/BlockErrors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::tools {
namespace {

Picture uniform(float3 color) { return { 24, 16, std::vector<float3>(24 * 16, color) }; }

TEST(BlockErrors, AreThoseOfUniformImages) {
    const BlockErrors errors = blockErrors(uniform(float3(0.6f)), uniform(float3(0.5f)), uniform(float3(0.1f)));
    EXPECT_NEAR(errors.error, 0.2, 1e-6);
    EXPECT_NEAR(errors.noise, 0.1 / 8 / 0.5, 1e-6) << "64 independent pixels";
}

TEST(BlockErrors, WhatCancelsInABlockDoesNotCount) {
    Picture striped = uniform(float3(0.0f)), halves = striped;
    for (size_t i = 0; i < striped.pixels.size(); ++i) {
        striped.pixels[i] = float3(i % 2 == 0 ? 0.0f : 1.0f);
        halves.pixels[i] = float3(i % 24 < 12 ? 0.0f : 1.0f); // the middle block has a half of each
    }
    const Picture traced = uniform(float3(0.5f)), black = uniform(float3(0.0f));
    EXPECT_NEAR(blockErrors(striped, traced, black).error, 0, 1e-6);
    EXPECT_NEAR(blockErrors(halves, traced, black).error, std::sqrt(2.0 / 3), 1e-6);
    EXPECT_EQ(blockErrors(striped, black, black).error, 0) << "black";
}

} // namespace
} // namespace filament_core::tools
