// SPDX-License-Identifier: Apache-2.0
// The examples of docs/material-language.md compile, and the editor's grammar knows the language that the compiler
// reads. tests/tools/tables has its tables.
#include "shaders/compiler/GlslKeywords.h"
#include "shaders/compiler/LanguageTables.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace filament_core::shader {
namespace {

std::string contents(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file.good()) << path;
    return { std::istreambuf_iterator<char>(file), {} };
}

/// The materials in the document's code blocks.
std::vector<std::string> examplesIn(std::string const& document) {
    std::vector<std::string> examples;
    constexpr std::string_view kBegin = "```material\n";
    for (size_t at = document.find(kBegin); at != std::string::npos; at = document.find(kBegin, at)) {
        at += kBegin.size();
        examples.push_back(document.substr(at, document.find("```", at) - at));
    }
    return examples;
}

TEST(Language, ExamplesOfTheReferenceCompileWithoutWarnings) {
    const auto examples = examplesIn(contents(tools::sourceDir() / "docs/material-language.md"));
    EXPECT_GE(examples.size(), 4u);
    for (std::string const& example : examples) {
        std::vector<std::string> warnings;
        CompileOptions options;
        options.warnings = &warnings;
        const Result<MaterialPackage> package = compileMaterial(example, "example.mat", options);
        EXPECT_TRUE(package) << example << package.error().message;
        EXPECT_EQ(warnings, std::vector<std::string>{}) << example;
    }
}

/// Every pattern of the grammar: JSON strings behind "match", "begin" and "end", without JSON's escapes.
std::string unescaped(std::string const& json) {
    std::string out;
    for (size_t i = 0; i < json.size(); ++i) {
        if (json[i] == '\\' && i + 1 < json.size()) ++i;
        out += json[i];
    }
    return out;
}

std::string grammar() { return contents(tools::sourceDir() / "tools/editor/material.tmLanguage.json"); }

TEST(Language, GrammarKnowsEveryWordOfTheCompiler) {
    const std::string text = grammar();
    const auto knows = [&](std::string_view word) {
        const std::regex whole("[(|]" + std::string(word) + "[)|]");
        return std::regex_search(text, whole);
    };
    for (std::string const& word : languageWords()) EXPECT_TRUE(knows(word)) << word;
    for (const std::string_view word : glslKeywords()) EXPECT_TRUE(knows(word)) << word;
}

TEST(Language, GrammarHasPatternsThatARegularExpressionCanBe) {
    const std::string text = grammar();
    static const std::regex field("\"(match|begin|end)\": \"((?:[^\"\\\\]|\\\\.)*)\"");
    size_t count = 0;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), field); at != std::sregex_iterator(); ++at, ++count) {
        const std::string pattern = unescaped((*at)[2].str());
        EXPECT_NO_THROW(std::regex(pattern, std::regex::ECMAScript)) << pattern;
    }
    EXPECT_GE(count, 15u);
    EXPECT_NE(text.find("\"scopeName\": \"source.filament-material\""), std::string::npos);
}

} // namespace
} // namespace filament_core::shader
