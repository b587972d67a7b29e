// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Against.h"
#include "tests/toolkit/pictures/Pictures.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filament_core::conformance {
namespace {

using testing::HasSubstr;
using Path = std::filesystem::path;

class Against : public testing::Test {
protected:
    void SetUp() override {
        const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
        mFolder = tools::buildDir() / "conformance-against-tests" / test;
        std::filesystem::remove_all(mFolder);
        for (Path const& folder : { here(), there() }) std::filesystem::create_directories(folder / "images");
    }

    Path here() const { return mFolder / "here"; }
    Path there() const { return mFolder / "debian-13"; }

    /// A case whose image has one grey, except for a pixel.
    CaseResult drawn(Path const& folder, const char* name, uint8_t pixel,
                     std::vector<AttachmentHash> attachments = {}) {
        Image image = grey(100, 4);
        image.pixels[4 * 6] = std::byte{ pixel }; // red of (2, 1)
        const std::string file = std::string("images/") + name + ".png";
        EXPECT_TRUE(savePng(folder / file, image));
        return { .name = name,
                 .status = Status::Passed,
                 .hash = std::to_string(pixel),
                 .image = file,
                 .attachments = std::move(attachments) };
    }

    /// This run, after its comparison with the report of `theirs`.
    Results compared(std::vector<CaseResult> mine, std::vector<CaseResult> theirs) {
        EXPECT_TRUE(writeReport(there(), { .build = "other", .cases = std::move(theirs) }));
        Results results{ .build = "this", .cases = std::move(mine) };
        const Result<void> done = compareWithReport(here(), results, there());
        EXPECT_TRUE(done) << done.error().message;
        return results;
    }

    Path mFolder;
};

TEST_F(Against, TheSameBitsPassAndOthersFailWithTheirPixelsAndTheFirstPass) {
    const AttachmentHash depth{ "1", "pass 'shadows', depth" }, hdr{ "2", "pass 'opaque', color 0" },
            otherHdr{ "3", hdr.where }, bytes{ "4", "pass 'tone', color 0" };
    const Results results = compared({ drawn(here(), "a", 7), drawn(here(), "b", 8, { depth, hdr, bytes }) },
                                     { drawn(there(), "a", 7), drawn(there(), "b", 11, { depth, otherHdr, bytes }) });
    EXPECT_EQ(results.cases[0].status, Status::Passed);
    EXPECT_TRUE(results.cases[0].comparisons.at(0).isIdentical());
    ASSERT_EQ(results.cases[1].status, Status::Failed);
    Comparison const& found = results.cases[1].comparisons.at(0);
    EXPECT_EQ(found.configuration, "against debian-13");
    EXPECT_EQ(found.differing, 1u);
    EXPECT_EQ(found.maxDifference, 3u);
    EXPECT_THAT(found.first, HasSubstr("pixel (2, 1)"));
    EXPECT_THAT(found.first, HasSubstr("first in pass 'opaque', color 0"));
    EXPECT_THAT(results.cases[1].reasons.at(0), HasSubstr("against debian-13: 1 pixels differ, by 3/255 at most"));
    EXPECT_TRUE(std::filesystem::exists(here() / found.image));
    EXPECT_TRUE(std::filesystem::exists(here() / found.difference));
    EXPECT_EQ(againstLine(results, there()),
              "against debian-13: 1 of 2 cases have the same bits; 0 have no picture there\n");
}

TEST_F(Against, BitsThatNoPictureShowsAreFoundByTheirHashes) {
    CaseResult mine = drawn(here(), "a", 7), theirs = drawn(there(), "a", 7);
    theirs.hash = "of half floats";
    const Results results = compared({ mine }, { theirs });
    EXPECT_EQ(results.cases[0].status, Status::Failed);
    EXPECT_THAT(results.cases[0].reasons.at(0), HasSubstr("1 pixels differ, by 0/255 at most"));
}

TEST_F(Against, AReportWithoutPicturesStillSaysWhichCaseAndPass) {
    CaseResult mine = drawn(here(), "a", 7, { { "1", "pass 'opaque', color 0" } });
    CaseResult theirs = drawn(there(), "a", 9, { { "2", "pass 'opaque', color 0" } });
    theirs.image.clear();
    const Results results = compared({ mine }, { theirs });
    EXPECT_THAT(results.cases[0].reasons.at(0), HasSubstr("--pictures all"));
    EXPECT_THAT(results.cases[0].reasons.at(0), HasSubstr("first in pass 'opaque'"));
}

TEST_F(Against, PassesThatOnlyOneReportHasAreNamed) {
    const AttachmentHash depth{ "1", "pass 'shadows', depth" }, hdr{ "2", "pass 'opaque', color 0" };
    const auto reason = [&](std::vector<AttachmentHash> mine, std::vector<AttachmentHash> theirs) {
        return compared({ drawn(here(), "a", 1, std::move(mine)) }, { drawn(there(), "a", 2, std::move(theirs)) })
                .cases[0]
                .reasons.at(0);
    };
    EXPECT_THAT(reason({ depth }, { depth, hdr }), HasSubstr("in pass 'opaque', color 0, which only the other"));
    EXPECT_THAT(reason({ depth, hdr }, { depth }), HasSubstr("in pass 'opaque', color 0, which only this"));
    EXPECT_THAT(reason({ depth, hdr }, { hdr }), HasSubstr("from pass 'shadows', depth on, where"));
    EXPECT_THAT(reason({ depth }, { depth }), HasSubstr("after the last pass"));
}

TEST_F(Against, CasesThatOneReportLacksAreCountedAndPass) {
    const Results results = compared({ drawn(here(), "a", 1), drawn(here(), "b", 1) }, { drawn(there(), "b", 1) });
    EXPECT_EQ(results.cases[0].status, Status::Passed);
    EXPECT_TRUE(results.cases[0].comparisons.empty());
    EXPECT_THAT(againstLine(results, there() / ""),
                HasSubstr("1 of 1 cases have the same bits; 1 have no picture there"));
}

TEST_F(Against, PicturesOfOtherSizesDiffer) {
    CaseResult theirs = drawn(there(), "a", 2);
    ASSERT_TRUE(savePng(there() / theirs.image, grey(100, 8)));
    const Results results = compared({ drawn(here(), "a", 1) }, { theirs });
    EXPECT_EQ(results.cases[0].status, Status::Failed);
    EXPECT_FALSE(results.cases[0].comparisons.at(0).fault.empty());
}

TEST_F(Against, AFolderWithoutAReportIsAnErrorWithItsPath) {
    Results results;
    const Result<void> done = compareWithReport(here(), results, mFolder / "nothing");
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr((mFolder / "nothing").string()));
}

} // namespace
} // namespace filament_core::conformance
