// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Jsonish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace filament_core::shader {
namespace {

using ::testing::HasSubstr;
using Kind = JsonValue::Kind;

Result<MaterialText> parse(std::string_view text, IncludeResolver const& includes = {}) {
    return parseMaterialText(text, "wood.mat", includes);
}

std::string errorOf(std::string_view text) {
    const Result<MaterialText> parsed = parse(text);
    return parsed ? "" : parsed.error().message;
}

TEST(Jsonish, TakesKeysAndStringsWithAndWithoutQuotes) {
    const Result<MaterialText> parsed = parse("material { name : \"Wet pavement\", \"shadingModel\" : lit }");
    ASSERT_TRUE(parsed) << parsed.error().message;
    auto const& members = parsed->material.members;
    ASSERT_EQ(members.size(), 2u);
    EXPECT_EQ(members[0].name, "name");
    EXPECT_EQ(members[0].value.text, "Wet pavement");
    EXPECT_EQ(members[1].name, "shadingModel");
    EXPECT_EQ(members[1].value.text, "lit");
}

TEST(Jsonish, TellsBooleansNumbersAndStringsApart) {
    const Result<MaterialText> parsed =
            parse("material { a : true, b : FALSE, c : -0.5, d : 1e3, e : \"true\", f : 2d, g : float[9] }");
    ASSERT_TRUE(parsed) << parsed.error().message;
    auto const& members = parsed->material.members;
    const std::vector<Kind> expected{ Kind::Bool,   Kind::Bool,   Kind::Number, Kind::Number,
                                      Kind::String, Kind::String, Kind::String };
    ASSERT_EQ(members.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(members[i].value.kind, expected[i]) << members[i].name;
    EXPECT_TRUE(members[0].value.boolean);
    EXPECT_FALSE(members[1].value.boolean);
    EXPECT_EQ(members[2].value.number, -0.5);
    EXPECT_EQ(members[3].value.number, 1000.0);
    EXPECT_EQ(members[6].value.text, "float[9]");
}

TEST(Jsonish, AllowsCommentsAndTrailingCommas) {
    const Result<MaterialText> parsed =
            parse("// a { brace\nmaterial { /* } */ list : [ 1, [2], ], // ]\n object : { x : 1, }, }");
    ASSERT_TRUE(parsed) << parsed.error().message;
    auto const& members = parsed->material.members;
    ASSERT_EQ(members.size(), 2u);
    ASSERT_EQ(members[0].value.items.size(), 2u);
    EXPECT_EQ(members[0].value.items[1].kind, Kind::Array);
    EXPECT_EQ(members[1].value.members.size(), 1u);
}

TEST(Jsonish, KeepsGlslAsItIsAndKnowsItsLine) {
    const Result<MaterialText> parsed =
            parse("material {}\n\nfragment {\n  void f() { if (a) { } /* } */ } // }\n}\nvertex{int x;}");
    ASSERT_TRUE(parsed) << parsed.error().message;
    ASSERT_TRUE(parsed->fragment && parsed->vertex);
    EXPECT_EQ(parsed->fragment->text, "\n  void f() { if (a) { } /* } */ } // }\n");
    EXPECT_EQ(parsed->fragment->at.line, 3u);
    EXPECT_EQ(parsed->vertex->text, "int x;");
}

TEST(Jsonish, ContinuesInIncludedFilesAndReportsTheirLines) {
    const IncludeResolver files = [](std::string_view path) -> std::optional<std::string> {
        if (path == "common.inc") return "// shared\nflipUV : false,\n";
        if (path == "self.inc") return "#include \"self.inc\"\n";
        if (path == "broken.inc") return "a : 1,\nb b\n";
        return std::nullopt;
    };
    const Result<MaterialText> parsed = parse("material {\n#include \"common.inc\"\nname : x }", files);
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->material.members.size(), 2u);
    EXPECT_THAT(parse("material {\n#include \"self.inc\"\n}", files).error().message, HasSubstr("include itself"));
    EXPECT_THAT(parse("material {\n\n#include \"gone.inc\"\n}", files).error().message,
                HasSubstr("wood.mat:3: cannot find"));
    EXPECT_THAT(parse("material {\n#include \"broken.inc\"\n}", files).error().message,
                HasSubstr("broken.inc:2: expected ':'"));
}

TEST(Jsonish, NamesFileLineAndWhatItExpected) {
    EXPECT_EQ(errorOf("material {\n  name stone\n}"), "wood.mat:2: expected ':', found 'stone'");
    EXPECT_EQ(errorOf("material {\n  list : [ 1 2 ]\n}"), "wood.mat:2: expected ',' or ']', found '2'");
    EXPECT_EQ(errorOf("material {\n  name : \"stone\n}"), "wood.mat:2: this string has no closing quote");
    EXPECT_EQ(errorOf("material {\n  a : 1,\n"),
              "wood.mat:3: expected a property name or '}', found the end of the file");
    EXPECT_EQ(errorOf("material {}\nfragment {\n  {"), "wood.mat:2: this block has no closing brace");
    EXPECT_EQ(errorOf("fragment {}"), "wood.mat:1: there is no material block");
    EXPECT_EQ(errorOf("material {}\nmaterial {}"), "wood.mat:2: there are two material blocks");
    EXPECT_EQ(errorOf("geometry {}"), "wood.mat:1: expected 'material', 'vertex' or 'fragment', found 'geometry'");
}

TEST(Jsonish, RefusesEndlessNestingInsteadOfOverflowing) {
    EXPECT_THAT(errorOf("material { a : " + std::string(100'000, '[')), HasSubstr("nested too deeply"));
}

TEST(Jsonish, SurvivesEveryTruncationAndRandomBytes) {
    const std::string original = "material { name : \"a\\\"b\", list : [ { type : float[2], x : 1 } ], // c\n } vertex "
                                 "{ a { } } fragment { /* } */ }";
    ASSERT_TRUE(parse(original)) << parse(original).error().message;
    for (size_t size = 0; size < original.size(); ++size) {
        const Result<MaterialText> parsed = parse(std::string_view(original).substr(0, size));
        EXPECT_TRUE(parsed || !parsed.error().message.empty());
    }
    std::mt19937 random(1);
    for (int round = 0; round < 20'000; ++round) {
        std::string text = original;
        for (int edits = 0; edits < 3; ++edits) text[random() % text.size()] = static_cast<char>(random());
        const Result<MaterialText> parsed = parse(text);
        ASSERT_TRUE(parsed || !parsed.error().message.empty());
    }
}

} // namespace
} // namespace filament_core::shader
