// SPDX-License-Identifier: Apache-2.0
// The published schema and the reader agree: on every scene file of the conformance tests, and on files that were
// changed in one place.
#include "filament_core/assets/files/FileBytes.h"
#include "tests/filament_core/scenefile/Schema.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/SceneFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace filament_core::test {
namespace {

std::string textOf(std::filesystem::path const& path) { return assets::readText(path, 1 << 24).value(); }

std::vector<std::filesystem::path> sceneFiles() {
    std::vector<std::filesystem::path> files;
    for (auto const& entry : std::filesystem::directory_iterator(tools::sourceDir() / "tests/conformance/scenes"))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

bool isRead(Tree const& tree) { return SceneFile::parse(tree.dump()).ok(); }

/// Every value of a tree, with the schema of its place; `visit` may change it for as long as it runs.
void forEachValue(Tree& value, Tree const& schema, std::function<void(Tree& value, Tree const& schema)> const& visit) {
    visit(value, schema);
    if (value.is_object() && schema.contains("properties"))
        for (auto const& member : value.items())
            forEachValue(member.value(), schema["properties"][member.key()], visit);
    if (value.is_array() && schema.contains("items"))
        for (Tree& element : value) forEachValue(element, schema["items"], visit);
}

TEST(SceneSchema, IsThePublishedOne) {
    EXPECT_TRUE(SceneFile::schema() == textOf(tools::sourceDir() / "docs/scene-file.schema.json"))
            << "run filament-tables --write docs/scene-file.schema.json";
}

TEST(SceneSchema, AcceptsEveryConformanceScene) {
    const Tree schema = Tree::parse(SceneFile::schema());
    for (auto const& file : sceneFiles()) EXPECT_TRUE(accepts(schema, Tree::parse(textOf(file)))) << file;
    EXPECT_GT(sceneFiles().size(), 50u);
}

TEST(SceneSchema, RefusesWhatTheReaderRefuses) {
    const Tree schema = Tree::parse(SceneFile::schema());
    size_t mutants = 0;
    std::set<Tree const*> changed; // a place of the schema each, in the first file that has it
    for (auto const& file : sceneFiles()) {
        Tree tree = Tree::parse(textOf(file));
        tree.erase("features");
        const auto check = [&](const char* change, Tree const& value) {
            ++mutants;
            EXPECT_FALSE(accepts(schema, tree)) << file << ": " << change << ": " << value.dump();
            EXPECT_FALSE(isRead(tree)) << file << ": " << change << ": " << value.dump();
        };
        forEachValue(tree, schema, [&](Tree& value, Tree const& here) {
            if (!changed.insert(&here).second) return;
            const Tree kept = value;
            if (kept.is_object() && here.contains("properties")) {
                value["noSuchKey"] = 1;
                check("an unknown key", kept);
            }
            if (here.contains("type") || here.contains("enum")) {
                value = nullptr;
                check("null", kept);
            }
            if (here.contains("minimum")) {
                value = here["minimum"].get<double>() - std::abs(here["minimum"].get<double>()) - 1;
                check("too small", kept);
                value = here["maximum"].get<double>() * 2 + 1;
                if (std::isfinite(value.get<double>())) check("too large", kept);
            }
            value = kept;
        });
    }
    EXPECT_GT(mutants, 300u);
}

// What the schema has and no file uses: each key is one that the reader knows.
TEST(SceneSchema, HasNoKeyThatTheReaderDoesNotKnow) {
    const Tree schema = Tree::parse(SceneFile::schema());
    const std::function<void(Tree const&, std::vector<std::string> const&)> visit =
            [&](Tree const& here, std::vector<std::string> const& path) {
                if (here.contains("items")) {
                    auto inside = path;
                    inside.emplace_back("[]");
                    return visit(here["items"], inside);
                }
                if (here.contains("properties")) {
                    for (auto const& member : here["properties"].items()) {
                        auto inside = path;
                        inside.push_back(member.key());
                        visit(member.value(), inside);
                    }
                    return;
                }
                Tree tree;
                Tree* at = &tree;
                std::string key;
                for (std::string const& step : path) {
                    if (step == "[]")
                        at = &at->emplace_back();
                    else
                        at = &(*at)[step];
                    if (step != "[]") key = step;
                }
                *at = nullptr; // no known field takes it
                const Result<SceneFile> read = SceneFile::parse(tree.dump());
                ASSERT_FALSE(read.ok()) << tree.dump();
                EXPECT_EQ(read.error().message.find("is not a field"), std::string::npos) << read.error().message;
            };
    visit(schema, {});
}

} // namespace
} // namespace filament_core::test
