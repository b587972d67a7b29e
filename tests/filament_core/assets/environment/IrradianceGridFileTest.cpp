// SPDX-License-Identifier: Apache-2.0
// Files of irradiance grids: what is written is read, and damaged files are errors or grids.
#include "tests/fuzz/IrradianceGridFuzzBody.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace filament_core {
namespace {

IrradianceGridDesc someGrid() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(-3, 900);
    auto probes = std::make_shared<IrradianceProbes>();
    probes->count = { 3, 2, 2 };
    probes->depthSize = 4;
    for (int i = 0; i < 12; ++i) {
        IrradianceProbe probe{ .standardError = value(random) * 0.01f + 0.1f, .isInside = i % 5 == 0 };
        for (float3& coefficient : probe.irradianceSh) coefficient = { value(random), value(random), value(random) };
        probes->probes.push_back(probe);
        for (int texel = 0; texel < 16; ++texel) {
            const float depth = std::abs(value(random)) / 100;
            probes->depths.emplace_back(depth, 1.1f * depth * depth);
        }
    }
    return { .centerWorld = { 1, 2, 3e7 },
             .halfExtentMeters = { 4, 5, 6 },
             .worldFromBox = float3x3(0, 1, 0, -1, 0, 0, 0, 0, 1),
             .blendMeters = 0.5f,
             .intensity = 2,
             .probes = probes,
             .name = "hall" };
}

TEST(IrradianceGridFile, WhatIsWrittenIsRead) {
    const IrradianceGridDesc grid = someGrid();
    const Result<IrradianceGridDesc> read = readIrradianceGrid(writeIrradianceGrid(grid));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->centerWorld, grid.centerWorld);
    EXPECT_EQ(read->halfExtentMeters, grid.halfExtentMeters);
    EXPECT_EQ(read->worldFromBox, grid.worldFromBox);
    EXPECT_EQ(read->blendMeters, grid.blendMeters);
    EXPECT_EQ(read->intensity, grid.intensity);
    EXPECT_EQ(read->name, grid.name);
    EXPECT_EQ(read->probes->count, grid.probes->count);
    for (size_t i = 0; i < 12; ++i) {
        IrradianceProbe const &was = grid.probes->probes[i], &is = read->probes->probes[i];
        for (size_t k = 0; k < 9; ++k)
            EXPECT_LT(glm::length(is.irradianceSh[k] - was.irradianceSh[k]),
                      1e-3f * glm::length(was.irradianceSh[k]) + 0.02f);
        EXPECT_EQ(is.isInside, was.isInside);
        EXPECT_NEAR(is.standardError, was.standardError, 0.01f);
    }
    for (size_t i = 0; i < grid.probes->depths.size(); ++i) {
        EXPECT_NEAR(read->probes->depths[i].x, grid.probes->depths[i].x, 2e-4f);
        EXPECT_NEAR(std::sqrt(read->probes->depths[i].y), std::sqrt(grid.probes->depths[i].y), 2e-4f);
    }
}

TEST(IrradianceGridFile, EveryFileThatIsCutShortIsAnErrorAndSoIsALongerOne) {
    std::vector<std::byte> file = writeIrradianceGrid(someGrid());
    for (size_t i = 0; i < file.size(); ++i) EXPECT_FALSE(readIrradianceGrid(std::span(file).first(i))) << i;
    file.push_back(std::byte{ 0 });
    EXPECT_FALSE(readIrradianceGrid(file));
}

TEST(IrradianceGridFile, AnotherVersionIsAnErrorThatSaysWhatToDo) {
    std::vector<std::byte> file = writeIrradianceGrid(someGrid());
    file[4] = std::byte{ 2 };
    const Result<IrradianceGridDesc> read = readIrradianceGrid(file);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "irradiance grid: version 2 is not known, this engine reads 1: bake it again");
}

TEST(IrradianceGridFile, DamagedFilesAreErrorsOfOneLineOrGrids) {
    const std::vector<std::byte> file = writeIrradianceGrid(someGrid());
    std::mt19937 random(6);
    size_t taken = 0;
    for (int round = 0; round < 4000; ++round) {
        std::vector<std::byte> damaged = file;
        for (auto edits = 1 + random() % 3; edits > 0; --edits) {
            // Half of the edits are in the header, which is small.
            const size_t at = random() % (random() % 2 == 0 ? 124 : damaged.size());
            damaged[at] = random() % 2 == 0 ? static_cast<std::byte>(random()) : damaged[at] ^ std::byte{ 0x80 };
        }
        taken += fuzzIrradianceGridOnce({ reinterpret_cast<const uint8_t*>(damaged.data()), damaged.size() });
    }
    EXPECT_GT(taken, 800u);
    EXPECT_LT(taken, 3800u);
}

} // namespace
} // namespace filament_core
