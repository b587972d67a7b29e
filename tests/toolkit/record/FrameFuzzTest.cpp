// SPDX-License-Identifier: Apache-2.0
// Edits of the files of a real saved frame, without clang and without a device.
#include "tests/fuzz/EditedText.h"
#include "tests/fuzz/FrameFuzzBody.h"
#include "tests/toolkit/record/SmallScene.h"

namespace filament_core {
namespace {

using test::FrameFolder;

class FrameFiles : public ::testing::Test {
protected:
    void SetUp() override {
        record::SaveRequest request = test::spheresRequest(mFolder);
        request.backends = { Backend::Vulkan };
        ASSERT_TRUE(record::saveFrame(request).ok());
        mManifest = test::bytesOf(mFolder.path() / "frame.json");
        mText = test::bytesOf(mFolder.path() / "vulkan.trace");
        mPayload = test::bytesOf(mFolder.path() / "vulkan.trace.bin");
    }

    FrameFolder mFolder;
    std::string mManifest, mText, mPayload;
};

TEST_F(FrameFiles, AreReadAsTheyStand) {
    EXPECT_TRUE(test::fuzzFrame(std::string(1, '\0') + mManifest));
    EXPECT_TRUE(test::fuzzFrame('\1' + mText + '\0' + mPayload));
}

TEST_F(FrameFiles, SurviveEditsAnywhere) {
    std::mt19937 random(20261126);
    size_t refused = 0;
    for (int round = 0; round < 1500; ++round) refused += !test::fuzzManifest(test::editedText(mManifest, random));
    EXPECT_GT(refused, 500u);
    size_t accepted = 0;
    for (int round = 0; round < 450; ++round)
        accepted += test::fuzzFrameTrace(test::editedText(mText, random) + '\0' + mPayload);
    EXPECT_GT(accepted, 10u); // lines that are missing are no error of the text; the validator judges them
}

TEST_F(FrameFiles, AreNotMistakenForEachOther) {
    EXPECT_FALSE(test::fuzzManifest(mText));
    EXPECT_FALSE(test::fuzzFrameTrace(mManifest));
    for (const char* text :
         { "", "{}", "null", "filament-trace 1\n", "filament-trace 1\nStream\nBeginFrame frame=1\n" })
        test::fuzzManifest(text), test::fuzzFrameTrace(text);
}

} // namespace
} // namespace filament_core
