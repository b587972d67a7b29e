// SPDX-License-Identifier: Apache-2.0
// Damaged glTF files that can be loaded can be shown: the loader promises what the rest of the engine asserts. The
// seeds are fixed; the number of rounds depends on the time, which is limited: 5 s, and minutes with FILAMENT_STRESS.
#include "tests/filament_core/assets/gltf/GltfSpecimens.h"
#include "tests/filament_core/engine/gltf/ModelFuzzBody.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

namespace filament_core {
namespace {

using assets::test::Specimen;

TEST(ModelMutation, WhatIsLoadedOfScratchedFilesCanBeShown) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 1, .validation = true });
    ASSERT_TRUE(engine) << engine.error().message;
    Renderer renderer(*engine);
    const std::vector<Specimen> specimens = assets::test::allSpecimens();
    const bool isStress = std::getenv("FILAMENT_STRESS") != nullptr;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(isStress ? 300 : 5);
    size_t runs = 0, loads = 0;
    for (uint32_t round = 0; round < 100'000 && std::chrono::steady_clock::now() < end; ++round) {
        for (size_t i = 0; i < specimens.size(); ++i) {
            Specimen specimen = specimens[i];
            const uint32_t seed = 7'000'000 + round * 1000 + static_cast<uint32_t>(i);
            SCOPED_TRACE(testing::Message() << "seed " << seed);
            if (round > 0) assets::test::Scratcher(seed).scratch(specimen);
            const bool isLoaded =
                    test::fuzzModel(*engine, renderer, assets::test::glbFrom(specimen.json, specimen.binary));
            EXPECT_TRUE(isLoaded || round > 0) << "specimen " << i << " must be whole";
            loads += isLoaded;
            ++runs;
        }
    }
    EXPECT_GT(loads, runs / 20) << "damage that always breaks the JSON would test nothing";
    EXPECT_LT(loads, runs);
}

} // namespace
} // namespace filament_core
