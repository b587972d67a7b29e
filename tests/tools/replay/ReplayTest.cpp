// SPDX-License-Identifier: Apache-2.0
// filament-replay: its options, what it does with a saved frame, and the program itself.
#include "tests/toolkit/record/SmallScene.h"
#include "toolkit/mutations/Mutations.h"
#include "toolkit/paths/Paths.h"
#include "tools/replay/ReplayFolder.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <sys/wait.h>

namespace filament_core::replay {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result<std::optional<Options>> parsed(std::vector<const char*> words) {
    words.insert(words.begin(), "filament-replay");
    return parseOptions(static_cast<int>(words.size()), words.data());
}

std::string refusal(std::vector<const char*> words) {
    const auto options = parsed(std::move(words));
    return options.ok() ? "accepted" : options.error().message;
}

TEST(ReplayOptions, NameWhatIsWrong) {
    EXPECT_THAT(refusal({}), HasSubstr("FOLDER"));
    EXPECT_THAT(refusal({ "f", "--backend", "metal" }), HasSubstr("vulkan, gles, null or all"));
    EXPECT_THAT(refusal({ "f", "--stop-after-draw", "0" }), HasSubstr("--stop-after-draw: '0'"));
    EXPECT_THAT(refusal({ "f", "--stop-after-draw", "x" }), HasSubstr("number of a draw"));
    EXPECT_THAT(refusal({ "f", "--frame", "-1" }), HasSubstr("--frame"));
    EXPECT_THAT(refusal({ "f", "--stop-after-draw", "1", "--stop-after-pass", "1" }), HasSubstr("without"));
    EXPECT_THAT(refusal({ "f", "--stop-after-draw", "1", "--step", "d" }), HasSubstr("without"));
    const auto good = parsed({ "f", "--backend", "gles", "--frame", "2", "--stop-after-pass", "color", "--step", "d" });
    ASSERT_TRUE(good.ok()) << good.error().message;
    EXPECT_EQ((*good)->backends, std::vector{ Backend::Gles });
    EXPECT_EQ((*good)->frame, 2u);
    EXPECT_EQ((*good)->stopAfterPass, "color");
    EXPECT_EQ((*good)->step, "d");
    EXPECT_FALSE((*good)->list);
}

class ReplayFolder : public ::testing::Test {
protected:
    void SetUp() override {
        const Result<record::Manifest> saved = record::saveFrame(test::spheresRequest(mFolder));
        ASSERT_TRUE(saved.ok()) << saved.error().message;
        ASSERT_EQ(saved->traces.size(), 2u);
        mOptions.folder = mFolder.path();
        const auto trace = record::loadTrace(mFolder.path(), saved->traces[0]);
        ASSERT_TRUE(trace.ok());
        mFrame = trace->frames.back();
    }

    Report report(Edits const& edits = {}) {
        Result<Report> result = replayFolder(mOptions, edits);
        EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
        return result.ok() ? std::move(*result) : Report{ .isEqual = false };
    }
    std::string error() {
        const Result<Report> result = replayFolder(mOptions);
        return result.ok() ? "no error: " + result->text : result.error().message;
    }

    test::FrameFolder mFolder;
    Options mOptions;
    record::ListedFrame mFrame;
};

TEST_F(ReplayFolder, DrawsTheRecordedBitsOnBothApis) {
    mOptions.out = mFolder.path() / "out";
    const Report drawn = report();
    EXPECT_TRUE(drawn.isEqual) << drawn.text;
    for (const char* api : { "vulkan", "gles" }) {
        EXPECT_THAT(drawn.text, HasSubstr(std::string(api) + " "));
        EXPECT_EQ(test::bytesOf(mOptions.out / (std::string(api) + "-picture.png")),
                  test::bytesOf(mFolder.path() / "picture.png"));
    }
}

TEST_F(ReplayFolder, ListsEveryPassAndDrawWithoutADevice) {
    mOptions.list = true;
    mOptions.requireDevice = "no such device";
    const Report listed = report();
    for (record::ListedPass const& pass : mFrame.passes) EXPECT_THAT(listed.text, HasSubstr("'" + pass.name + "'"));
    EXPECT_THAT(listed.text, HasSubstr("draw " + std::to_string(mFrame.draws.size()) + " '"));
    EXPECT_THAT(listed.text, HasSubstr("gltf_lit_opaque"));
}

TEST_F(ReplayFolder, EveryPassCutOffAfterItsLastDrawIsAsRecorded) {
    for (size_t i = 0; i < mFrame.passes.size(); ++i) {
        mOptions.stopAfterPass = std::to_string(i + 1);
        const Report cut = report();
        EXPECT_TRUE(cut.isEqual) << cut.text;
        EXPECT_THAT(cut.text, HasSubstr(mFrame.passes[i].name));
        EXPECT_THAT(cut.text, HasSubstr(", as recorded"));
        const std::string byNumber = cut.text;
        mOptions.stopAfterPass = mFrame.passes[i].name;
        EXPECT_EQ(report().text, byNumber);
    }
}

TEST_F(ReplayFolder, SteppingThroughAllDrawsEndsWithTheRecordedPicture) {
    mOptions.step = mFolder.path() / "steps";
    const Report stepped = report();
    EXPECT_TRUE(stepped.isEqual) << stepped.text;
    for (size_t i = 1; i <= mFrame.draws.size(); ++i)
        EXPECT_THAT(stepped.text, HasSubstr("after draw " + std::to_string(i) + " '"));
    // The last pass draws the image; its files are in reading order.
    std::string last;
    for (auto const& file : std::filesystem::directory_iterator(mOptions.step)) {
        const std::string name = file.path().filename().string();
        if (name.starts_with("gles") && name.ends_with("pixels.png")) last = std::max(last, file.path().string());
    }
    EXPECT_EQ(test::bytesOf(last), test::bytesOf(mFolder.path() / "picture.png"));
}

TEST_F(ReplayFolder, NamesThePassAndTheDrawOfADefectOfOneApi) {
    const Report broken = report({ { Backend::Gles, [] { return tools::findMutation("depthCompare")->make(); } } });
    EXPECT_FALSE(broken.isEqual);
    EXPECT_THAT(broken.text, HasSubstr("vulkan and gles first disagree in frame 1, pass '"));
    EXPECT_THAT(broken.text, HasSubstr("pipeline 'gltf_lit_opaque'"));
    EXPECT_THAT(broken.text, HasSubstr("first with other bits than when the frame was saved: frame 1, pass "));
    EXPECT_THAT(broken.text, Not(HasSubstr("vulkan  not replayed")));
}

TEST_F(ReplayFolder, KnowsADefectOfBothApisFromOneOfOneApi) {
    const auto edit = [] { return tools::findMutation("depthCompare")->make(); };
    const Report broken = report({ { Backend::Gles, edit }, { Backend::Vulkan, edit } });
    EXPECT_FALSE(broken.isEqual);
    EXPECT_THAT(broken.text, HasSubstr("agree in every attachment: both draw other bits than were shown"));
}

TEST_F(ReplayFolder, ChecksTheCommandsWithoutADevice) {
    mOptions.backends = { Backend::Null };
    const Report checked = report();
    EXPECT_TRUE(checked.isEqual) << checked.text;
    EXPECT_THAT(checked.text, HasSubstr("every command obeys the rules"));
}

TEST_F(ReplayFolder, SaysWhatIsNotThere) {
    mOptions.stopAfterPass = "no such pass";
    EXPECT_THAT(error(), HasSubstr("--stop-after-pass no such pass: the frame has"));
    mOptions.stopAfterPass.reset();
    mOptions.stopAfterDraw = 1000;
    EXPECT_THAT(error(), HasSubstr("--stop-after-draw 1000: the frame has"));
    mOptions.stopAfterDraw = 1;
    mOptions.frame = 9;
    EXPECT_THAT(error(), HasSubstr("--frame 9: vulkan.trace has 1 frames"));
    mOptions = { .folder = mFolder.path(), .requireDevice = "no such device" };
    EXPECT_THAT(error(), HasSubstr("no trace could be replayed"));
    mOptions.requireDevice.clear();
    std::filesystem::remove(mFolder.path() / "gles.trace");
    EXPECT_THAT(error(), HasSubstr("gles.trace' is missing"));
    mOptions.backends = { Backend::Vulkan }; // the other one does not matter then
    EXPECT_TRUE(report().isEqual);
    mOptions.folder = mFolder.path() / "nowhere";
    EXPECT_THAT(error(), HasSubstr("is no saved frame"));
}

TEST_F(ReplayFolder, AsAProgramEndsWithItsVerdict) {
    const auto status = [&](std::string const& arguments) {
        const std::string command = (tools::buildDir() / "bin/filament-replay ").string() + arguments + " >" +
                                    (mFolder.path() / "output").string() + " 2>&1";
        const int ended = std::system(command.c_str());
        return WIFEXITED(ended) ? WEXITSTATUS(ended) : 128;
    };
    const std::string folder = mFolder.path().string();
    EXPECT_EQ(status(folder), 0) << test::bytesOf(mFolder.path() / "output");
    EXPECT_EQ(status("--help"), 0);
    EXPECT_EQ(status(folder + " --stop-after-pass nothing"), 1);
    std::string manifest = test::bytesOf(mFolder.path() / "frame.json");
    const size_t hash = manifest.find("\"hash\": \"") + 9;
    manifest[hash] = manifest[hash] == '0' ? '1' : '0';
    test::writeBytes(mFolder.path() / "frame.json", manifest);
    EXPECT_EQ(status(folder), 1);
    EXPECT_THAT(test::bytesOf(mFolder.path() / "output"), HasSubstr("every attachment is as it was"));
}

} // namespace
} // namespace filament_core::replay
