// SPDX-License-Identifier: Apache-2.0
// Replays the fuzzer's corpus of material texts in tests/fuzz/corpus, and edits of it, without clang.
#include "tests/fuzz/EditedText.h"
#include "tests/shaders/compiler/MaterialTextFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace filament_core::shader {
namespace {

std::vector<std::string> corpus() {
    std::vector<std::filesystem::path> paths;
    const std::filesystem::path folder(tools::sourceDir() / "tests/fuzz/corpus/material_text");
    for (auto const& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<std::string> texts;
    for (std::filesystem::path const& path : paths) {
        std::ifstream file(path, std::ios::binary);
        texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return texts;
}

TEST(MaterialText, OfTheCorpusIsAMaterialOrAnErrorThatSaysWhereAndWhy) {
    const std::vector<std::string> texts = corpus();
    ASSERT_GT(texts.size(), 50u);
    const auto accepted =
            std::ranges::count_if(texts, [](std::string const& text) { return test::fuzzMaterialText(text); });
    EXPECT_GT(accepted, 3);
    EXPECT_LT(accepted, static_cast<ptrdiff_t>(texts.size()));
}

TEST(MaterialText, SurvivesEditsAnywhere) {
    const std::vector<std::string> texts = corpus();
    ASSERT_FALSE(texts.empty());
    std::mt19937 random(4711);
    constexpr std::string_view kMarks = "{}[]:,\"'\n#/*-.0aZ\\";
    size_t accepted = 0;
    for (int round = 0; round < 5000; ++round) {
        std::string text = filament_core::test::editedText(texts[random() % texts.size()], random, kMarks);
        if (random() % 4 == 0)
            text.insert(random() % (text.size() + 1), texts[random() % texts.size()].substr(0, random() % 40));
        accepted += test::fuzzMaterialText(text);
    }
    EXPECT_GT(accepted, 0u);
}

} // namespace
} // namespace filament_core::shader
