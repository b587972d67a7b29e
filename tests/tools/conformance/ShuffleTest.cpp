// SPDX-License-Identifier: Apache-2.0
// The order of --shuffle, and that images do not depend on it.
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Runner.h"
#include "tools/conformance/random/Dice.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace filament_core::conformance {
namespace {

std::vector<SceneSpec> numberedCases(int count) {
    std::vector<SceneSpec> cases(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) cases[static_cast<size_t>(i)].name = std::to_string(i);
    return cases;
}

std::vector<std::string> shuffledNames(Options const& options, int count) {
    std::vector<std::string> names;
    for (SceneSpec const& spec : casesOf(numberedCases(count), options)) names.push_back(spec.name);
    return names;
}

// ISO C++ [rand.predef]: the 10000th number of a default mt19937_64 is 9981545732273789042.
TEST(Shuffle, ThrowsTheDiceOfTheStandard) {
    Dice dice(5489);
    for (int i = 1; i < 10000; ++i) (void)dice.below(1);
    EXPECT_EQ(dice.below(size_t{ 1 } << 32), 9981545732273789042u >> 32);
}

TEST(Shuffle, OfASeedIsOneOrderOfAllCases) {
    std::set<std::vector<std::string>> orders;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<std::string> names = shuffledNames({ .shuffle = seed }, 50);
        EXPECT_EQ(names, shuffledNames({ .shuffle = seed }, 50));
        EXPECT_EQ(std::set(names.begin(), names.end()).size(), 50u);
        orders.insert(names);
    }
    EXPECT_EQ(orders.size(), 20u);
}

// With 7 cases each pair of neighbours occurs in 2 / 7 of 5040 orders.
TEST(Shuffle, MakesNeighboursOfAnyTwoCases) {
    std::map<std::pair<std::string, std::string>, int> neighbours;
    constexpr int kSeeds = 2100;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
        const std::vector<std::string> names = shuffledNames({ .shuffle = seed }, 7);
        for (size_t i = 1; i < names.size(); ++i) ++neighbours[{ names[i - 1], names[i] }];
    }
    EXPECT_EQ(neighbours.size(), 42u);
    for (auto const& [pair, count] : neighbours)
        EXPECT_NEAR(count, kSeeds / 7, 80) << pair.first << " " << pair.second; // five deviations
}

TEST(Shuffle, IsDividedAmongShards) {
    std::multiset<std::string> together;
    Options options{ .shuffle = 3 };
    for (options.shard = { 0, 4 }; options.shard.index < 4; ++options.shard.index) {
        const std::vector<std::string> names = shuffledNames(options, 21);
        together.insert(names.begin(), names.end());
    }
    EXPECT_EQ(together.size(), 21u);
    EXPECT_EQ(std::set(together.begin(), together.end()).size(), 21u);
}

TEST(Shuffle, LeavesEveryPictureAndTheReportAsTheyAre) {
    Options options{ .cases = { "motion-blur/first-frame", "motion-blur/gathered", "reflections/first-frame",
                                "reflections", "shadows", "shadows-large", "finish/exposure", "sun-only" } };
    options.scenes = tools::sourceDir() / "tests/conformance/scenes";
    options.baselines = tools::sourceDir() / "tests/conformance/baselines.json";
    options.out = tools::buildDir() / "conformance-shuffle";
    options.threads = options.mutations = false;
    options.build = "test";
    const auto run = [&](std::optional<uint64_t> seed) {
        options.shuffle = seed;
        auto scenes = readScenes(options.scenes);
        EXPECT_TRUE(scenes.ok());
        auto results = runCases(options, casesOf(std::move(*scenes), options));
        EXPECT_TRUE(results.ok()) << (results.ok() ? "" : results.error().message);
        return results.ok() ? toJson(*results) : Json();
    };
    const Json byName = run({});
    EXPECT_EQ(byName.at("cases").size(), 8u);
    for (const uint64_t seed : { 1u, 2u }) EXPECT_EQ(run(seed), byName) << seed;
}

} // namespace
} // namespace filament_core::conformance
