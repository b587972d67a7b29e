// SPDX-License-Identifier: Apache-2.0
// Generated materials compile and are the same for a seed; the reducer keeps what fails and little else.
#include "shaders/compiler/MaterialCompiler.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/random/MaterialGenerator.h"
#include "tools/conformance/random/MaterialReducer.h"
#include "tools/conformance/random/RandomRun.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace filament_core::conformance {
namespace {

TEST(RandomMaterials, AreTheSameForASeedAndOthersForAnother) {
    EXPECT_EQ(print(generateMaterial(7)), print(generateMaterial(7)));
    EXPECT_NE(print(generateMaterial(7)), print(generateMaterial(8)));
}

TEST(RandomMaterials, Compile) {
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        const std::string text = print(generateMaterial(seed));
        const auto package = shader::compileMaterial(text, "random.mat");
        EXPECT_TRUE(package) << seed << ": " << (package ? "" : package.error().message) << "\n" << text;
    }
}

bool has(std::string const& text, const char* word) { return text.find(word) != std::string::npos; }

TEST(Reducer, KeepsOnlyWhatTheFailureNeeds) {
    const auto expensive = [](std::string const& text) { return has(text, "sin(") && has(text, "prepareMaterial"); };
    uint32_t reduced = 0;
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        const MaterialTree material = generateMaterial(seed);
        if (!expensive(print(material))) continue;
        const Reduction reduction = reduceMaterial(material, expensive, 5000);
        const std::string text = print(reduction.material);
        EXPECT_TRUE(expensive(text)) << text;
        EXPECT_LT(text.size(), 220u) << seed << "\n" << text;
        ++reduced;
    }
    EXPECT_GT(reduced, 10u);
}

TEST(Reducer, LeavesAMaterialThatNothingCanBeTakenFrom) {
    const std::string whole = print(generateMaterial(3));
    const Reduction reduction = reduceMaterial(generateMaterial(3), [&](auto const& text) { return text == whole; });
    EXPECT_EQ(print(reduction.material), whole);
    EXPECT_LE(reduction.tries, 600u);
}

std::string readFile(std::filesystem::path const& path) {
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

/// The next seed whose material fetches a texture with a level that the hardware chooses, and has short code.
uint64_t fetchingSeed(uint64_t seed) {
    for (;; ++seed) {
        const std::string text = print(generateMaterial(seed));
        if (text.size() < 1500 && has(text, "texture(")) return seed;
    }
}

// The defect changes what such fetches return, so the reduced material still has one.
TEST(Reducer, FindsTheTextureFetchBehindAnInjectedDifference) {
    Options options;
    options.out = tools::buildDir() / "conformance-random-tests";
    options.random = 1;
    options.mutate = "mipBias";
    for (uint64_t seed = 1, tries = 0; tries < 6; ++tries, seed = options.seed + 1) {
        options.seed = fetchingSeed(seed);
        const Result<RandomResults> results = runRandom(options);
        if (!results) GTEST_SKIP() << results.error().message;
        if (results->findings.empty()) continue; // what it fetches is not seen
        RandomFinding const& finding = results->findings.front();
        const std::string text = readFile(finding.material);
        EXPECT_TRUE(has(text, "texture(")) << finding.what << "\n" << text;
        EXPECT_LT(text.size(), 500u) << text;
        std::filesystem::path difference = finding.material;
        EXPECT_TRUE(std::filesystem::exists(difference.replace_extension(".difference.png")));
        return;
    }
    ADD_FAILURE() << "no material shows the defect";
}

} // namespace
} // namespace filament_core::conformance
