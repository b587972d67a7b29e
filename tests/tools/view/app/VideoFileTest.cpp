// SPDX-License-Identifier: Apache-2.0
// Videos by a program named ffmpeg that a test writes.
#include "tools/view/app/VideoFile.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/FakeFfmpeg.h"

#include <gmock/gmock.h>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

class VideoFile : public testing::Test {
protected:
    void SetUp() override {
        folder = test::folderOfThisTest();
        fs::remove_all(folder);
        fs::create_directories(folder / "videos");
    }
    VideoRequest request(std::string const& name = "a.mp4") const {
        return { .file = folder / "videos" / name, .pattern = folder / "frame-%05d.png", .frames = 12 };
    }
    size_t filesOfVideos() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder / "videos"), fs::directory_iterator()));
    }
    fs::path folder;
};

TEST_F(VideoFile, WordsReachFfmpegAsTheyAre) {
    const FakeFfmpeg ffmpeg(folder / "bin", scriptThatKeepsWords(folder / "words"));
    VideoRequest video = request("it's $(touch x); \"a\" & b.mp4");
    const fs::path odd = folder / "100% $HOME 'frames'";
    video.pattern = odd / "frame-%05d.png";
    video.framesPerSecond = 23.976;
    const Result<void> made = makeVideo(video);
    ASSERT_TRUE(made.ok()) << made.error().message;
    EXPECT_EQ(textOfFile(video.file), "video\n");
    EXPECT_EQ(filesOfVideos(), 1u) << "nothing else stays";
    const std::string words = textOfFile(folder / "words");
    const std::string doubled = (folder / "100%% $HOME 'frames'").string() + "/frame-%05d.png";
    EXPECT_THAT(words, testing::HasSubstr("-i\n" + doubled + "\n"));
    EXPECT_THAT(words, testing::HasSubstr("-framerate\n23.976\n"));
    EXPECT_THAT(words, testing::HasSubstr("-frames:v\n12\n")) << "older frames are not taken for those of this path";
    EXPECT_THAT(words, testing::HasSubstr("-nostdin\n"));
}

TEST_F(VideoFile, ItsOutputIsAbsoluteSoThatNoNameIsAnOption) {
    const std::vector<std::string> words = videoWords(request(), "-version.mp4");
    EXPECT_EQ(words.front(), "ffmpeg");
    EXPECT_EQ(words.back(), (fs::current_path() / "-version.mp4").string());
}

TEST_F(VideoFile, WithoutFfmpegTheErrorSaysHowToGetIt) {
    const FakeFfmpeg none(folder / "bin", "");
    for (Result<void> const& refused : { checkVideo("a.mp4"), makeVideo(request()) }) {
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().code, ErrorCode::NotFound);
        EXPECT_THAT(refused.error().message, testing::HasSubstr("apt-get install ffmpeg"));
        EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
    }
}

TEST_F(VideoFile, EndingsThatAreNoVideoAreRefused) {
    const FakeFfmpeg ffmpeg(folder / "bin", scriptThatKeepsWords(folder / "words"));
    for (const char* name : { "a.png", "a", "a.mp4.exe", "" }) EXPECT_FALSE(checkVideo(name).ok()) << name;
    for (const char* name : { "a.mp4", "a.mov", "a.mkv", "a.webm" }) EXPECT_TRUE(checkVideo(name).ok()) << name;
}

TEST_F(VideoFile, FailuresQuoteFfmpegAndKeepTheLastVideo) {
    const FakeFfmpeg ffmpeg(
            folder / "bin",
            "for last; do :; done; echo half > \"$last\"; echo first >&2; echo 'Unknown encoder' >&2; exit 3");
    std::ofstream(request().file) << "old";
    const Result<void> made = makeVideo(request());
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().message, testing::HasSubstr("exit status 3: Unknown encoder"));
    EXPECT_EQ(made.error().message.find('\n'), std::string::npos);
    EXPECT_EQ(textOfFile(request().file), "old");
    EXPECT_EQ(filesOfVideos(), 1u);
}

TEST_F(VideoFile, AProgramThatWritesNothingIsAFailure) {
    const FakeFfmpeg ffmpeg(folder / "bin", "exit 0");
    const Result<void> made = makeVideo(request());
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().message, testing::HasSubstr("wrote no video"));
}

TEST_F(VideoFile, CancellingEndsFfmpeg) {
    const FakeFfmpeg ffmpeg(folder / "bin", "exec sleep 600");
    const Result<void> made = makeVideo(request(), [] { return true; });
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(filesOfVideos(), 0u);
}

} // namespace
} // namespace filament_core::view
