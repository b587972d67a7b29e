// SPDX-License-Identifier: Apache-2.0
// The documents have the tables of the programs, and a document that is not current is found.
#include "tools/tables/Tables.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace filament_core::tools {
namespace {

using ::testing::HasSubstr;

const std::vector<NamedTable> kTables{ { "a", "| 1 |\n" }, { "b", "| 2 |\n" } };

TEST(Tables, ReplaceWhatStandsBetweenTheirMarks) {
    const Result<std::string> text = withTables(
            "x\n<!-- begin: b -->\nold\n<!-- end: b -->\ny\n<!-- begin: a -->\n<!-- end: a -->\n", kTables, "d");
    ASSERT_TRUE(text);
    EXPECT_EQ(*text, "x\n<!-- begin: b -->\n| 2 |\n<!-- end: b -->\ny\n<!-- begin: a -->\n| 1 |\n<!-- end: a -->\n");
    EXPECT_EQ(*withTables(*text, kTables, "d"), *text);
}

TEST(Tables, DocumentsWithoutMarksStayAsTheyAre) {
    EXPECT_EQ(*withTables("x\n<!-- y -->", kTables, "d"), "x\n<!-- y -->");
}

TEST(Tables, WrongMarksAreNamedWithTheirLine) {
    const auto errorOf = [](std::string_view document) {
        const Result<std::string> text = withTables(document, kTables, "d.md");
        return text ? "" : text.error().message;
    };
    EXPECT_EQ(errorOf("\n\n<!-- begin: c -->\n<!-- end: c -->"), "d.md:3: there is no table 'c'");
    EXPECT_THAT(errorOf("<!-- begin: a -->\n"),
                HasSubstr("d.md:1: the table needs a line '<!-- begin: a -->' and then"));
    EXPECT_THAT(errorOf("<!-- begin: a --> <!-- end: a -->"), HasSubstr("d.md:1: the table needs a line"));
    EXPECT_THAT(errorOf("<!-- begin: a"), HasSubstr("there is no table ''"));
}

/// Every document below docs/, with its name.
std::vector<std::pair<std::string, std::string>> documents() {
    std::vector<std::pair<std::string, std::string>> found;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(sourceDir() / "docs")) {
        if (entry.path().extension() != ".md") continue;
        std::ifstream file(entry.path(), std::ios::binary);
        found.emplace_back(entry.path(), std::string(std::istreambuf_iterator<char>(file), {}));
    }
    return found;
}

TEST(Tables, DocumentsAreCurrent) {
    const std::vector<NamedTable> tables = documentTables();
    for (auto const& [name, text] : documents()) {
        const Result<std::string> current = withTables(text, tables, name);
        ASSERT_TRUE(current) << current.error().message;
        EXPECT_EQ(text, *current) << "run filament-tables --write " << name;
    }
}

TEST(Tables, EveryTableIsInADocument) {
    const auto all = documents();
    for (auto const& [table, rows] : documentTables()) {
        EXPECT_GT(std::ranges::count(rows, '\n'),
                  table == "types" || table == "attributes" || table == "filters" ? 0 : 2)
                << table;
        const std::string mark = "<!-- begin: " + table + " -->\n";
        EXPECT_TRUE(std::ranges::any_of(all, [&](auto const& each) {
            return each.second.find(mark) != std::string::npos;
        })) << table;
    }
}

} // namespace
} // namespace filament_core::tools
