// SPDX-License-Identifier: Apache-2.0
// The report's images are files in a folder with the page's name: every image that a page shows exists, and those
// of an earlier report are deleted.
#include "tools/accuracy/Page.h"
#include "toolkit/paths/Paths.h"
#include "tools/accuracy/PagePictures.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <set>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string textOf(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

void write(fs::path const& path, std::string const& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

std::set<std::string> filesIn(fs::path const& folder) {
    std::set<std::string> names;
    if (!fs::exists(folder)) return names;
    for (auto const& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
}

Results resultsOf(std::string const& name) {
    const auto effects = readEffects(tools::sourceDir() / "tools/accuracy/effects.json");
    EXPECT_TRUE(effects) << effects.error().message;
    EffectResult result{ .effect = effects->front() };
    result.effect.name = name;
    for (Value const& value : result.effect.values) result.values.push_back({ .value = value });
    return { .effects = { std::move(result) } };
}

class ReportPictures : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(mFolder);
        write(mOut / "other/frames.svg", "<svg>frames</svg>");
        write(mOut / "other.fragment.html", R"(<section id="o"><h2>Other</h2><img src="other/frames.svg"></section>)");
        write(mOut / "comparison/chart-engine.png", "a picture");
        write(mOut / "comparison.fragment.html", R"(<p><img alt="a" src="comparison/chart-engine.png"></p>)");
    }
    void TearDown() override { fs::remove_all(mFolder); }

    Result<void> report(std::string const& effect) {
        return writeReport(resultsOf(effect), { .out = mOut, .page = mPage, .include = {}, .plots = false });
    }

    const fs::path mFolder = fs::path(testing::TempDir()) / "report-pictures";
    const fs::path mOut = mFolder / "out", mPage = mFolder / "docs/costs.html";
};

TEST_F(ReportPictures, LieInAFolderOfThePagesNameUnderTheNamesThatThePageShows) {
    const Result<void> written = report("fresnel");
    ASSERT_TRUE(written) << written.error().message;
    const std::string html = textOf(mPage);
    for (auto const& [name, content] :
         { std::pair{ "frames.svg", "<svg>frames</svg>" }, { "chart-engine.png", "a picture" } }) {
        EXPECT_THAT(html, HasSubstr(std::string("src=\"costs/") + name + '"'));
        EXPECT_EQ(textOf(mFolder / "docs/costs" / name), content);
    }
    EXPECT_THAT(filesIn(mFolder / "docs/costs"), ElementsAre("00-comparison.fragment.html", "01-other.fragment.html",
                                                             "chart-engine.png", "frames.svg", "results.json"));
    EXPECT_LT(html.find("chart-engine.png"), html.find("<h2>Other</h2>"));
    EXPECT_EQ(html.find("base64"), std::string::npos);
}

TEST_F(ReportPictures, OfAnEarlierReportAreRemovedAndNothingElseIs) {
    ASSERT_TRUE(report("fresnel"));
    write(mFolder / "docs/costs/mine.png", "not of the report");
    write(mOut / "comparison.fragment.html", "<p>no picture</p>");
    fs::remove(mOut / "other.fragment.html");
    ASSERT_TRUE(report("fresnel"));
    EXPECT_THAT(filesIn(mFolder / "docs/costs"),
                ElementsAre("00-comparison.fragment.html", "mine.png", "results.json"));
}

TEST_F(ReportPictures, MayLieWhereTheyAreShown) {
    const Result<void> written = writeReport(
            resultsOf("fresnel"), { .out = mOut, .page = mOut / "other.html", .include = {}, .plots = false });
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(textOf(mOut / "other/frames.svg"), "<svg>frames</svg>");
    EXPECT_THAT(textOf(mOut / "other.html"), HasSubstr("src=\"other/frames.svg\""));
}

TEST_F(ReportPictures, OfOneNameOrNoneAtAllAreAnErrorThatNamesThem) {
    write(mOut / "second/frames.svg", "<svg>another</svg>");
    write(mOut / "second.fragment.html", R"(<img src="second/frames.svg">)");
    Result<void> written = report("fresnel");
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("second/frames.svg: two pictures of one page need different names"));
    write(mOut / "second.fragment.html", R"(<img src="second/missing.png">)");
    written = report("fresnel");
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("second/missing.png"));
}

} // namespace
} // namespace filament_core::accuracy
