// SPDX-License-Identifier: Apache-2.0
// The editor's grammar colours every material of the project as an independent reading of the text says.
#include "shaders/compiler/GlslKeywords.h"
#include "tests/shaders/compiler/TextMateTokenizer.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace filament_core::shader {
namespace {

using test::TextMateTokenizer;

std::string textOf(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file.good()) << path;
    return { std::istreambuf_iterator<char>(file), {} };
}

TextMateTokenizer const& tokenizer() {
    static const TextMateTokenizer made(textOf(tools::sourceDir() / "tools/editor/material.tmLanguage.json"));
    return made;
}

std::vector<std::filesystem::path> materialFiles() {
    std::vector<std::filesystem::path> files;
    for (const char* folder : { "samples/materials", "shaders", "tools", "tests" }) {
        for (auto const& entry : std::filesystem::recursive_directory_iterator(tools::sourceDir() / folder)) {
            if (entry.path().extension() == ".mat") files.push_back(entry.path());
        }
    }
    std::ranges::sort(files);
    return files;
}

enum class Part : uint8_t { Code, Comment, String };

/// A reading by hand: comments of both kinds, and strings within a line.
std::vector<Part> partsOf(std::string const& text) {
    std::vector<Part> parts(text.size(), Part::Code);
    const auto mark = [&](size_t begin, size_t end, Part part) {
        end = std::min(end, text.size());
        std::fill(parts.begin() + static_cast<std::ptrdiff_t>(begin), parts.begin() + static_cast<std::ptrdiff_t>(end),
                  part);
        return end;
    };
    for (size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            i = mark(i, text.find('\n', i), Part::Comment);
        } else if (text.compare(i, 2, "/*") == 0) {
            i = mark(i, text.find("*/", i + 2) + 2, Part::Comment);
        } else if (text[i] == '"') {
            i = mark(i, text.find('"', i + 1) + 1, Part::String);
        } else {
            ++i;
        }
    }
    return parts;
}

bool has(test::Scopes const& scopes, std::string_view part) { return scopes.find(part) != std::string::npos; }
bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Calls found(begin, end) for words and numbers in code: letters, digits, "_", and the point of a number.
template <class Found>
void forEachWord(std::string const& text, std::vector<Part> const& parts, Found const& found) {
    for (size_t i = 0; i < text.size();) {
        const bool begins = parts[i] == Part::Code && isWordCharacter(text[i]);
        size_t end = i + 1;
        const bool isNumber = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
        while (begins && end < text.size() && (isWordCharacter(text[end]) || (isNumber && text[end] == '.'))) ++end;
        if (begins) found(i, end);
        i = end;
    }
}

TEST(Grammar, EveryBlockThatBeginsEnds) {
    ASSERT_GE(materialFiles().size(), 80u);
    for (auto const& file : materialFiles()) {
        const std::string text = textOf(file);
        const TextMateTokenizer::Result found = tokenizer().run(text);
        ASSERT_EQ(found.scopes.size(), text.size()) << file;
        EXPECT_EQ(found.open, 0u) << file;
    }
}

TEST(Grammar, CommentsAndStringsOfMaterialsAreThoseOfTheText) {
    for (auto const& file : materialFiles()) {
        const std::string text = textOf(file);
        const std::vector<Part> parts = partsOf(text);
        const TextMateTokenizer::Result found = tokenizer().run(text);
        for (size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '\n') continue;
            EXPECT_EQ(has(found.scopes[i], "comment."), parts[i] == Part::Comment)
                    << file << " at " << text.substr(i, 40);
            EXPECT_EQ(has(found.scopes[i], "string."), parts[i] == Part::String)
                    << file << " at " << text.substr(i, 40);
        }
    }
}

TEST(Grammar, NumbersAndKeywordsAreColouredAsAWhole) {
    size_t numbers = 0, keywords = 0;
    for (auto const& file : materialFiles()) {
        const std::string text = textOf(file);
        const TextMateTokenizer::Result found = tokenizer().run(text);
        forEachWord(text, partsOf(text), [&](size_t begin, size_t end) {
            const std::string word = text.substr(begin, end - begin);
            const bool isInCode = has(found.scopes[begin], "meta.block.code");
            const bool isKeyword = isInCode && isGlslKeyword(word) && !has(found.scopes[begin], "support.");
            const bool isNumber =
                    std::isdigit(static_cast<unsigned char>(word[0])) != 0 && !has(found.scopes[begin], "preprocessor");
            const char* expected = isNumber ? "constant.numeric" : isKeyword ? "keyword." : "";
            for (size_t i = begin; i < end; ++i)
                EXPECT_TRUE(has(found.scopes[i], expected)) << file << ' ' << word << " is not " << expected;
            numbers += isNumber;
            keywords += isKeyword;
        });
    }
    EXPECT_GT(numbers, 500u);
    EXPECT_GT(keywords, 400u);
}

TEST(Grammar, PropertiesOfAMaterialAreNamesAndTheirValuesValues) {
    size_t properties = 0;
    for (auto const& file : materialFiles()) {
        const std::string text = textOf(file);
        const TextMateTokenizer::Result found = tokenizer().run(text);
        forEachWord(text, partsOf(text), [&](size_t begin, size_t end) {
            if (!has(found.scopes[begin], "meta.block.material")) return;
            const size_t next = text.find_first_not_of(" \t\n", end);
            if (next == std::string::npos || text[next] != ':') return;
            EXPECT_TRUE(has(found.scopes[begin], "support.type.property-name"))
                    << file << ' ' << text.substr(begin, 30);
            ++properties;
        });
    }
    EXPECT_GT(properties, 300u);
}

TEST(Grammar, ColoursCornersOfTheLanguage) {
    const auto scopeOf = [](std::string const& text, std::string_view at) {
        return tokenizer().run(text).scopes[text.find(at)];
    };
    const auto inCode = [](std::string const& line) { return "fragment {\n" + line + "\n}\n"; };
    for (const std::string number : { "2.", ".5", "1e-3", "0x1Fu", "3u", "1.5f", "07", "2.5e+2" }) {
        const std::string text = inCode("x = " + number + ";");
        const auto scopes = tokenizer().run(text).scopes;
        const size_t first = text.find(number);
        for (size_t i = first; i < first + number.size(); ++i)
            EXPECT_TRUE(has(scopes[i], "constant.numeric")) << number;
        EXPECT_FALSE(has(scopes[first + number.size()], "constant.numeric")) << number;
    }
    EXPECT_FALSE(has(scopeOf(inCode("x2 = a;"), "2"), "constant.numeric"));
    EXPECT_TRUE(has(scopeOf(inCode("  #  include \"a.glsl\""), "include"), "keyword.control.include"));
    EXPECT_TRUE(has(scopeOf(inCode("  #\tinclude \"a.glsl\""), "\"a"), "string."));
    EXPECT_TRUE(has(scopeOf("material {\n # include \"a.inc\"\n}\n", "include"), "keyword.control.include"));
    EXPECT_TRUE(has(scopeOf(inCode("/* a\n b */ discard;"), "b */"), "comment."));
    EXPECT_TRUE(has(scopeOf(inCode("/* a\n b */ discard;"), "discard"), "keyword."));
    EXPECT_TRUE(has(scopeOf("material { name : \"a // b { }\", shadingModel : lit }", "lit"), "support.constant"));
    EXPECT_TRUE(has(scopeOf("material { parameters : [ { type : float3, name : tint } ] }", "float3"), "storage.type"));
}

} // namespace
} // namespace filament_core::shader
