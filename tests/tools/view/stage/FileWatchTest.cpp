// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/FileWatch.h"

#include "tests/tools/view/stage/StageFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filament_core::view {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FileWatch, ReportsAChangeOnceItIsTheSameInTwoLooks) {
    const StageFolder folder;
    const auto file = folder.write("watched", "one"), other = folder.write("other", "one");
    FileWatch watch;
    watch.watch({ file, other });
    EXPECT_THAT(watch.changed(), IsEmpty());
    folder.write("watched", "longer");
    EXPECT_THAT(watch.changed(), IsEmpty()) << "it may still be written";
    EXPECT_THAT(watch.changed(), ElementsAre(file));
    EXPECT_THAT(watch.changed(), IsEmpty());
    folder.write("watched", "longer and longer");
    EXPECT_THAT(watch.changed(), IsEmpty());
    folder.write("watched", "longer and longer still");
    EXPECT_THAT(watch.changed(), IsEmpty());
    EXPECT_THAT(watch.changed(), ElementsAre(file));
    std::filesystem::remove(other);
    EXPECT_THAT(watch.changed(), IsEmpty());
    EXPECT_THAT(watch.changed(), ElementsAre(other));
}

TEST(FileWatch, KnowsFilesThatStayFromBefore) {
    const StageFolder folder;
    const auto file = folder.write("watched", "one");
    FileWatch watch;
    watch.watch({ file });
    folder.write("watched", "longer");
    watch.watch({ file, folder / "missing", "" });
    EXPECT_THAT(watch.changed(), IsEmpty());
    EXPECT_THAT(watch.changed(), ElementsAre(file));
    watch.watch({});
    folder.write("watched", "more");
    watch.changed();
    EXPECT_THAT(watch.changed(), IsEmpty());
}

TEST(FileWatch, LongNamesAndSpacesAreNoTrouble) {
    const StageFolder folder;
    folder.write("near.glsl", "");
    const std::string many(2'000'000, ' '), longName(2'000'000, 'a');
    const auto file = folder.write("long.mat", "#" + many + "include" + many + "\"near.glsl\"\n#include \"" + longName +
                                                       "\"\n#include <" + longName);
    EXPECT_THAT(filesOf(file), testing::Contains(folder / "near.glsl"));
}

TEST(FileWatch, FindsTheFilesThatAFileNames) {
    const StageFolder folder;
    folder.write("noise.glsl", "");
    const auto gltf =
            folder.write("named.gltf", R"({ "buffers": [ { "uri": "a%20b.bin" }, { "uri": "data:,x" }, 3, {} ],
        "images": [ { "uri": "textures/wood.png" }, { "uri": 5 } ] })");
    EXPECT_THAT(filesOf(gltf), ElementsAre(gltf, folder / "a b.bin", folder / "textures/wood.png"));
    const auto mat =
            folder.write("named.mat", "material {}\nfragment {\n#include \"noise.glsl\"\n# include <missing.glsl>\n}");
    EXPECT_THAT(filesOf(mat), ElementsAre(mat, folder / "noise.glsl"));
    for (const char* text : { "", "[", "[]", R"({"buffers": 3})", R"({"images": [[]]})" }) {
        const auto broken = folder.write("broken.gltf", text);
        EXPECT_THAT(filesOf(broken), ElementsAre(broken));
    }
    EXPECT_THAT(filesOf(folder / "nothing.gltf"), ElementsAre(folder / "nothing.gltf"));
}

} // namespace
} // namespace filament_core::view
