// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/PathInside.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;

/// outside.txt; model/inside.txt, with links to both and to the folder above.
struct PathInside : testing::Test {
    TemporaryFolder folder;
    fs::path model = folder / "model";

    void SetUp() override {
        const std::vector<std::byte> bytes(4);
        ASSERT_TRUE(replaceFile(folder / "outside.txt", bytes));
        ASSERT_TRUE(replaceFile(model / "textures" / "inside.txt", bytes));
        fs::create_symlink("textures/inside.txt", model / "to-inside");
        fs::create_symlink("../outside.txt", model / "to-outside");
        fs::create_directory_symlink("..", model / "up");
    }

    std::string refusal(std::string_view relative) const {
        const auto file = fileInside(model, relative);
        if (file) return "was found";
        EXPECT_EQ(file.error().code, ErrorCode::InvalidArgument);
        return file.error().message;
    }
};

TEST_F(PathInside, FilesOfTheFolderAreFoundAlsoThroughLinks) {
    for (const char* relative :
         { "textures/inside.txt", "to-inside", "./textures/../to-inside", "up/model/to-inside" }) {
        const auto file = fileInside(model, relative);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->filename(), "inside.txt");
    }
}

TEST_F(PathInside, NothingLeavesTheFolder) {
    const char* const kOutside = "lies outside the folder";
    for (std::string const& relative : { std::string("../outside.txt"), std::string("to-outside"),
                                         std::string("up/outside.txt"), std::string("textures/../../outside.txt"),
                                         (folder / "outside.txt").string(), (model / "to-inside").string() })
        EXPECT_NE(refusal(relative).find(kOutside), std::string::npos) << relative << ": " << refusal(relative);
    EXPECT_NE(refusal({ "to-inside\0.txt", 14 }).find("zero byte"), std::string::npos);
}

TEST_F(PathInside, AFolderWhoseNameOnlyBeginsAlikeIsOutside) {
    ASSERT_TRUE(replaceFile(folder / "model2" / "file", {}));
    fs::create_symlink("../model2/file", model / "sibling");
    EXPECT_NE(refusal("sibling").find("through a link"), std::string::npos);
}

TEST_F(PathInside, EverythingIsFoundWhereFilesComeFromAnywhere) {
    for (std::string const& relative :
         { std::string("../outside.txt"), std::string("to-outside"), (folder / "outside.txt").string() }) {
        const auto file = fileInside(model, relative, FilesFrom::Anywhere);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_TRUE(fs::equivalent(*file, folder / "outside.txt"));
    }
}

TEST_F(PathInside, AMissingFileIsNotFound) {
    EXPECT_EQ(fileInside(model, "missing").error().code, ErrorCode::NotFound);
    EXPECT_EQ(fileInside(folder / "missing", "file").error().code, ErrorCode::NotFound);
}

} // namespace
} // namespace filament_core::assets
