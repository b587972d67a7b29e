// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Report.h"
#include "tests/toolkit/pictures/Pictures.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Baselines.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace filament_core::conformance {
namespace {

using Path = std::filesystem::path;

Path freshFolder(const char* name) {
    const Path folder = tools::buildDir() / "conformance-report-tests" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

std::string textOfFile(Path const& path) {
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

size_t countOf(std::string const& text, std::string_view part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// One case of each status; the failed one differs in an image and missed a mutant.
Results mixedResults() {
    const Comparison equal{ .configuration = "gles", .passed = true };
    const Comparison differs{ .configuration = "gles",
                              .differing = 3,
                              .maxDifference = 12,
                              .first = "pixel (1, 2) <after draw 7>",
                              .image = "test.png",
                              .difference = "difference.png" };
    return { .build = "Release & more",
             .reference = "vulkan",
             .devices = { { "vulkan", "llvmpipe" } },
             .cases = { { .name = "a", .status = Status::Passed, .comparisons = { equal, equal } },
                        { .name = "b\"c",
                          .status = Status::Failed,
                          .reasons = { "gles differs", "a mutant was not noticed" },
                          .image = "reference.png",
                          .attachments = { { "0123456789abcdef", "pass 'opaque', color 0" } },
                          .comparisons = { differs },
                          .kills = { { "oneLightOff", false, 0 }, { "depthCompare", true, 5 } } },
                        { .name = "d", .status = Status::Skipped, .reasons = { "no asset" } } },
             .seconds = { { "a", 1.5 }, { "b\"c", 0.25 } } };
}

TEST(JUnit, HasEachCaseItsTimeAndWhyItFailedWithNothingUnescaped) {
    EXPECT_EQ(junitOf(mixedResults()), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites><testsuite name="conformance" tests="3" failures="1" skipped="1" errors="0" time="1.750">
<testcase classname="conformance.Release &amp; more" name="a" time="1.500"></testcase>
<testcase classname="conformance.Release &amp; more" name="b&quot;c" time="0.250"><failure message="gles differs">gles differs
a mutant was not noticed</failure></testcase>
<testcase classname="conformance.Release &amp; more" name="d" time="0.000"><skipped message="no asset"/></testcase>
</testsuite></testsuites>
)");
}

TEST(Html, HoldsItsPicturesAndNeedsNothingElse) {
    const Path folder = freshFolder("html");
    for (const char* name : { "reference.png", "test.png", "difference.png" })
        ASSERT_TRUE(savePng(folder / name, grey(100, 4)).ok());
    const std::string html = htmlOf(mixedResults(), folder);
    // Reference, test and difference, and both images in turn.
    EXPECT_EQ(countOf(html, "<img "), 5u);
    EXPECT_EQ(countOf(html, "src=\"data:image/png;base64,iVBORw0KGgo"), 5u) << "every picture is a PNG in the page";
    EXPECT_EQ(html.find("http"), std::string::npos);
    EXPECT_EQ(html.find("<link"), std::string::npos);
    EXPECT_EQ(countOf(html, "class=\"blink\""), 1u);
    EXPECT_NE(html.find("first: pixel (1, 2) &lt;after draw 7&gt;"), std::string::npos);
    EXPECT_LT(html.find("b&quot;c"), html.find("<h3>a")) << "what failed comes first";
    EXPECT_NE(html.find("1 of 2 noticed"), std::string::npos);
    EXPECT_NE(html.find("2 configurations: the same bits"), std::string::npos);
}

TEST(Html, LeavesAPictureOutThatIsNotThere) {
    EXPECT_EQ(countOf(htmlOf(mixedResults(), freshFolder("empty")), "<img "), 0u);
}

TEST(Report, IsReadBackAsItWasWritten) {
    const Path folder = freshFolder("round-trip");
    const Results results = mixedResults();
    ASSERT_TRUE(writeReport(folder, results).ok());
    const Result<Results> again = readResults(folder);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(toJson(*again), toJson(results));
    EXPECT_EQ(again->seconds, results.seconds);
    EXPECT_EQ(textOfFile(folder / "junit.xml"), junitOf(results));
    EXPECT_EQ(textOfFile(folder / "report.html"), htmlOf(results, folder));
}

TEST(Report, ThatIsDamagedOrMissingIsAnErrorWithItsPath) {
    const Path folder = freshFolder("damaged");
    EXPECT_NE(readResults(folder).error().message.find(folder.string()), std::string::npos);
    std::ofstream(folder / "times.json") << "{}";
    std::ofstream(folder / "results.json") << R"({ "cases": 7 })";
    EXPECT_EQ(readResults(folder).error().code, ErrorCode::Corrupt);
    EXPECT_NE(readResults(folder).error().message.find(folder.string()), std::string::npos);
}

TEST(Merge, RefusesACaseThatTwoShardsHave) {
    const Result<Results> merged = merge({ mixedResults(), mixedResults() });
    ASSERT_FALSE(merged.ok());
    EXPECT_NE(merged.error().message.find("'a'"), std::string::npos) << merged.error().message;
}

TEST(Report, WithoutPassedPicturesHasThoseOfFailuresOnly) {
    const Path folder = freshFolder("failures");
    Results results = mixedResults();
    results.cases[0].image = "passed.png";
    for (const char* name : { "passed.png", "reference.png", "test.png", "difference.png" })
        ASSERT_TRUE(savePng(folder / name, grey(100, 4)).ok());
    dropPassedPictures(folder, results);
    EXPECT_EQ(toJson(results), toJson(mixedResults()));
    EXPECT_FALSE(std::filesystem::exists(folder / "passed.png"));
    EXPECT_EQ(countOf(htmlOf(results, folder), "<img "), 5u);
}

Results shardWith(tools::Shard shard, const char* name) {
    Results results = mixedResults();
    results.cases = { { .name = name, .status = Status::Passed } };
    results.seconds.clear();
    results.shard = { shard, 1 };
    return results;
}

TEST(Merge, OfAllShardsInAnyOrderIsOneRunAndNoShard) {
    Results whole = mixedResults();
    whole.cases = { { .name = "a", .status = Status::Passed }, { .name = "b", .status = Status::Passed } };
    whole.seconds.clear();
    const Result<Results> merged = merge({ shardWith({ 1, 2 }, "b"), shardWith({ 0, 2 }, "a") });
    ASSERT_TRUE(merged.ok()) << merged.error().message;
    EXPECT_EQ(toJson(*merged).dump(), toJson(whole).dump());
}

TEST(Merge, NamesShardsThatAreMissingTwiceOrUnfinished) {
    const auto messageOf = [](std::vector<Results> parts) {
        const Result<Results> merged = merge(std::move(parts));
        return merged ? std::string() : merged.error().message;
    };
    EXPECT_EQ(messageOf({ shardWith({ 2, 4 }, "a"), shardWith({ 0, 4 }, "b") }),
              "missing: shard 1/4, 3/4; run --shard 1/4 and merge again");
    EXPECT_EQ(messageOf({ shardWith({ 0, 2 }, "a"), shardWith({ 0, 2 }, "a") }),
              "shard 0/2 is there twice; merge each shard once");
    EXPECT_EQ(messageOf({ shardWith({ 0, 2 }, "a"), shardWith({ 1, 3 }, "b") }),
              "shard 0/2 and shard 1/3 are of two divisions; merge one");
    Results unfinished = shardWith({ 1, 2 }, "b");
    unfinished.cases.clear();
    EXPECT_EQ(messageOf({ shardWith({ 0, 2 }, "a"), unfinished }), "shard 1/2 has 0 of 1 cases; run it again");
    EXPECT_EQ(messageOf({ shardWith({ 5, 2 }, "a") }), "there is no shard 5/2; run it again");
}

TEST(Report, OfAShardIsReadBackWithItsShard) {
    const Path folder = freshFolder("shard");
    const Results results = shardWith({ 1, 2 }, "b");
    ASSERT_TRUE(writeReport(folder, results).ok());
    const Result<Results> again = readResults(folder);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(toJson(*again), toJson(results));
}

const Machine kHere{ .device = "llvmpipe", .driver = "Mesa 22.3.6", .cpuFeatures = "avx fma" };
const Machine kThere{ .device = "llvmpipe", .driver = "Mesa 24.0", .cpuFeatures = "avx fma" };

Baselines stored(Image const& image) {
    Baselines baselines;
    baselines.store("case", image, kHere);
    return baselines;
}

TEST(Baselines, FailACaseThatTheyDoNotHave) {
    const BaselineVerdict verdict = Baselines().check("case", grey(1), kHere);
    EXPECT_FALSE(verdict.passed);
    EXPECT_NE(verdict.text.find("missing"), std::string::npos);
}

TEST(Baselines, DemandTheSameBitsOnTheSameMachine) {
    Image image = grey(100);
    EXPECT_TRUE(stored(image).check("case", image, kHere).passed);
    const Baselines baselines = stored(image);
    image.pixels[5] ^= std::byte{ 1 };
    EXPECT_FALSE(baselines.check("case", image, kHere).passed);
}

TEST(Baselines, GoByTheThumbnailOnAnotherMachineAndSaySo) {
    Image image = grey(100);
    const Baselines baselines = stored(image);
    image.pixels[5] ^= std::byte{ 1 };
    const BaselineVerdict close = baselines.check("case", image, kThere);
    EXPECT_TRUE(close.passed);
    EXPECT_NE(close.text.find("made on llvmpipe, Mesa 22.3.6"), std::string::npos) << close.text;
    EXPECT_FALSE(baselines.check("case", grey(110), kThere).passed);
}

/// With another version of Mesa that draws the same bits, except for one case.
TEST(Baselines, HoldBitForBitForTheVersionsThatTheyList) {
    const Path file = freshFolder("versions") / "baselines.json";
    Baselines baselines = stored(grey(100));
    baselines.store("other", grey(100), kHere);
    ASSERT_TRUE(baselines.write(file));
    Json json = Json::parse(textOfFile(file));
    json["versions"]["25.0.7"] = { { "other", hashOf(grey(101)) } };
    std::ofstream(file) << json.dump();
    Result<Baselines> listed = Baselines::read(file);
    ASSERT_TRUE(listed) << listed.error().message;
    ASSERT_TRUE(listed->write(file));
    listed = Baselines::read(file);
    ASSERT_TRUE(listed) << listed.error().message;
    const Machine newer{ "llvmpipe (LLVM 19.1.7, 256 bits)", "OpenGL ES 3.2 Mesa 25.0.7-2", kHere.cpuFeatures };
    Machine unlisted = newer, weaker = newer;
    unlisted.driver = "OpenGL ES 3.2 Mesa 25.1.0", weaker.cpuFeatures = "avx no-fma";
    Image image = grey(100);
    EXPECT_EQ(listed->check("case", image, newer).text, "equal");
    image.pixels[5] ^= std::byte{ 1 };
    EXPECT_FALSE(listed->check("case", image, newer).passed);
    EXPECT_FALSE(listed->check("other", grey(100), newer).passed);
    EXPECT_EQ(listed->check("other", grey(101), newer).text, "equal");
    EXPECT_EQ(listed->check("other", grey(100), kHere).text, "equal");
    EXPECT_TRUE(listed->check("case", image, unlisted).passed) << "by its thumbnail";
    EXPECT_TRUE(listed->check("case", image, weaker).passed) << "by its thumbnail";
}

TEST(Baselines, OfAnotherMachineAreForgottenWhenOneIsStored) {
    Baselines baselines = stored(grey(100));
    baselines.store("other", grey(50), kThere);
    EXPECT_FALSE(baselines.check("case", grey(100), kThere).passed);
    EXPECT_TRUE(baselines.check("other", grey(50), kThere).passed);
}

TEST(Baselines, AreReadBackAsTheyWereWritten) {
    const Path file = freshFolder("baselines") / "baselines.json";
    ASSERT_TRUE(stored(grey(100)).write(file).ok());
    const Result<Baselines> again = Baselines::read(file);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_TRUE(again->check("case", grey(100), kHere).passed);
    EXPECT_TRUE(again->check("case", grey(100), kThere).passed) << "the thumbnail came back, too";
    std::ofstream(file) << "{ \"machine\": 3 }";
    EXPECT_EQ(Baselines::read(file).error().code, ErrorCode::Corrupt);
}

TEST(Baselines, HaveThumbnailsOfTheMeanColour) {
    Image image = grey(0, 64);
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = y % 2; x < 64; x += 2) image.pixels[(y * 64 + x) * 4] = std::byte{ 200 }; // half of the red
    }
    const Image small = thumbnailOf(image);
    ASSERT_EQ(small.pixels.size(), kThumbnail * kThumbnail * 4);
    for (size_t i = 0; i < small.pixels.size(); i += 4) EXPECT_EQ(small.pixels[i], std::byte{ 100 });
}

} // namespace
} // namespace filament_core::conformance
