// SPDX-License-Identifier: Apache-2.0
// The list of recent files between runs, whatever its file holds.
#include "tools/view/app/RecentFiles.h"
#include "tests/base/ScopedVariable.h"
#include "tests/fuzz/RecentFilesFuzzBody.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

fs::path storeOfThisTest() {
    const fs::path folder =
            fs::path(testing::TempDir()) /
            fmt::format("{}-{}", testing::UnitTest::GetInstance()->current_test_info()->name(), ::getpid());
    fs::remove_all(folder);
    return folder / "state/recent.json";
}

TEST(RecentFiles, TheNewestIsFirstAndStaysForTheNextRun) {
    const fs::path store = storeOfThisTest();
    RecentFiles files(store);
    for (const char* file : { "/a.glb", "/b.glb", "/c.glb", "/x/../a.glb" }) ASSERT_TRUE(files.add(file).ok());
    EXPECT_THAT(files.files(), testing::ElementsAre("/a.glb", "/c.glb", "/b.glb"));
    EXPECT_EQ(RecentFiles(store).files(), files.files());
    ASSERT_TRUE(files.add("relative.glb").ok());
    EXPECT_EQ(files.files().front(), fs::current_path() / "relative.glb");
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(files.add(fmt::format("/model {}.glb", i)).ok());
    EXPECT_EQ(files.files().size(), kMostRecent);
    EXPECT_EQ(files.files().front(), "/model 39.glb");
}

TEST(RecentFiles, TwoViewersKeepEachOthersFiles) {
    const fs::path store = storeOfThisTest();
    RecentFiles first(store), second(store);
    ASSERT_TRUE(first.add("/first.glb").ok());
    ASSERT_TRUE(second.add("/second.glb").ok());
    EXPECT_THAT(RecentFiles(store).files(), testing::ElementsAre("/second.glb", "/first.glb"));
}

TEST(RecentFiles, WhatIsNoPathIsLeftOut) {
    const std::string longest = "/" + std::string(kLongestPath, 'a');
    EXPECT_THAT(
            recentFromJson(R"(["/a.glb", 3, null, "relative", "", "/a.glb", "/b\nc", "/b\u0000c", ["/d"], "/e%s##"])"),
            testing::ElementsAre("/a.glb", "/e%s##"));
    EXPECT_THAT(recentFromJson(fmt::format(R"(["{}"])", longest)), testing::IsEmpty());
    for (const char* text : { "", "{}", "[", "\"/a\"", "[\"/a\"] x", "\xff\xfe", "[1e999]" })
        EXPECT_THAT(recentFromJson(text), testing::IsEmpty()) << text;
}

TEST(RecentFiles, AnyTextIsAList) {
    const std::string text = recentToJson({ "/models/bird.glb", "/caf\xc3\xa9/room.hdr", "/a/very/long/name.json" });
    ASSERT_TRUE(fuzzRecentFilesOnce({ reinterpret_cast<const uint8_t*>(text.data()), text.size() }));
    std::mt19937 random(5);
    for (int round = 0; round < 2000; ++round) {
        std::string edited = text;
        for (int edits = 0; edits < 3; ++edits) edited[random() % edited.size()] = static_cast<char>(random());
        fuzzRecentFilesOnce({ reinterpret_cast<const uint8_t*>(edited.data()), edited.size() });
    }
    const std::string deep(200'000, '[');
    EXPECT_FALSE(fuzzRecentFilesOnce({ reinterpret_cast<const uint8_t*>(deep.data()), deep.size() }));
}

TEST(RecentFiles, StoresThatCannotBeUsedAreNoHarm) {
    const fs::path store = storeOfThisTest();
    fs::create_directories(store); // a folder has its name
    RecentFiles files(store);
    EXPECT_THAT(files.files(), testing::IsEmpty());
    const Result<void> added = files.add("/a.glb");
    ASSERT_FALSE(added.ok());
    EXPECT_EQ(added.error().message.find('\n'), std::string::npos);
    EXPECT_THAT(files.files(), testing::ElementsAre("/a.glb")) << "in this run";
    RecentFiles none{ {} };
    EXPECT_TRUE(none.add("/a.glb").ok());
    EXPECT_THAT(none.files(), testing::ElementsAre("/a.glb"));
    EXPECT_TRUE(none.add("/new\nline").ok());
    EXPECT_EQ(none.files().size(), 1u);
}

TEST(RecentFiles, TheStoreLiesWhereTheDesktopKeepsStates) {
    const auto with = [](const char* state, const char* home) {
        const auto given = [](const char* value) { return value ? std::optional<std::string>(value) : std::nullopt; };
        const test::ScopedVariable stateHome("XDG_STATE_HOME", given(state)), userHome("HOME", given(home));
        return recentFilesPath();
    };
    EXPECT_EQ(with("/state", "/home/a"), "/state/filament-view/recent.json");
    EXPECT_EQ(with(nullptr, "/home/a"), "/home/a/.local/state/filament-view/recent.json");
    EXPECT_EQ(with("relative", "/home/a"), "/home/a/.local/state/filament-view/recent.json") << "as the standard asks";
    EXPECT_EQ(with("", ""), "");
    EXPECT_EQ(with(nullptr, nullptr), "");
}

} // namespace
} // namespace filament_core::view
