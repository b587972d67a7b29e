// SPDX-License-Identifier: Apache-2.0
// Camera paths by the command line: without a window, and the program ends by itself.
#include "tools/view/app/RunViewer.h"
#include "tests/base/ScopedVariable.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/FakeFfmpeg.h"
#include "tests/tools/view/app/TestScene.h"
#include "tests/windows/VirtualDisplay.h"
#include "tools/view/app/RecentFiles.h"
#include "tools/view/document/TextForms.h"

#include <gmock/gmock.h>

#include <fstream>
#include <utility>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

/// The exit status of filament-view; what it says on standard error is kept in `error`.
int statusOf(std::vector<std::string> const& given, std::string& error) {
    std::vector<const char*> words{ "filament-view" };
    for (std::string const& word : given) words.push_back(word.c_str());
    const auto options = parseViewerOptions(static_cast<int>(words.size()), words.data());
    EXPECT_TRUE(options.ok()) << options.error().message;
    testing::internal::CaptureStderr();
    const int status = options ? runViewer(**options) : -1;
    error = testing::internal::GetCapturedStderr();
    return status;
}

class RunViewer : public testing::Test {
protected:
    void SetUp() override {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        folder = test::folderOfThisTest();
        fs::remove_all(folder);
        fs::create_directories(folder);
        CameraPath path;
        for (int i = 0; i < 2; ++i)
            path.keys.push_back({ .seconds = 0.5 * i, .camera = Camera::lookAt({ 0.9 - i, 0.6, 1.5 }, double3(0)) });
        ASSERT_TRUE(saveCameraPath(folder / "path.json", path).ok());
        words = { showcaseFiles().model.string(),
                  "--environment",
                  showcaseFiles().environment.string(),
                  "--workers",
                  "0",
                  "--fps",
                  "4",
                  "--camera-path",
                  (folder / "path.json").string() };
    }
    std::vector<std::string> with(std::vector<std::string> const& more) const {
        std::vector<std::string> all = words;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    fs::path folder;
    std::vector<std::string> words;
    std::string error;
};

TEST_F(RunViewer, DrawsACameraPathWithoutADisplay) {
    for (const char* api : { "vulkan", "gles" }) {
        const fs::path frames = folder / api;
        EXPECT_EQ(statusOf(with({ "--backend", api, "--size", "64x36", "--frames-to", frames.string() }), error), 0)
                << error;
        EXPECT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), 3) << "0, 0.25 and 0.5 s";
        EXPECT_EQ(error, "");
    }
    for (const char* frame : { "frame-00000.png", "frame-00001.png", "frame-00002.png" })
        EXPECT_EQ(textOfFile(folder / "vulkan" / frame), textOfFile(folder / "gles" / frame)) << frame;
}

TEST_F(RunViewer, MakesAVideoAndKeepsTheFramesIfAsked) {
    const FakeFfmpeg ffmpeg(folder / "bin", scriptThatKeepsWords(folder / "words"));
    const fs::path frames = folder / "frames", video = folder / "new folder/round.webm";
    EXPECT_EQ(statusOf(with({ "--size", "64x36", "--frames-to", frames.string(), "--video", video.string() }), error),
              0)
            << error;
    EXPECT_TRUE(fs::exists(frames / "frame-00002.png"));
    EXPECT_EQ(textOfFile(video), "video\n");
}

TEST_F(RunViewer, OpensPanelsAndRemembersItsModel) {
    const auto server = test::VirtualDisplay::start();
    if (!server) return;
    const test::ScopedVariable display("DISPLAY", server->name());
    const test::ScopedVariable stateHome("XDG_STATE_HOME", (folder / "state").string());
    const fs::path picture = folder / "window.png";
    const std::vector<std::string> last{ "--frames", "4",      "--panel",      "Path",           "--panel", "Numbers",
                                         "--select", "nobody", "--screenshot", picture.string(), "--size",  "900x500" };
    EXPECT_EQ(statusOf(with(last), error), 0) << error;
    EXPECT_THAT(error, testing::HasSubstr("--select nobody: the model has no node of this name"));
    EXPECT_TRUE(loadImage(picture).ok());
    EXPECT_THAT(RecentFiles(recentFilesPath()).files(), testing::ElementsAre(showcaseFiles().model));
    EXPECT_FALSE(fs::exists(recentFilesPath().replace_filename("last.json"))) << "nothing was edited";
}

TEST_F(RunViewer, FilesThatCannotBeLoadedAreAStatus) {
    const auto write = [&](const char* name) {
        std::ofstream(folder / name) << "nothing";
        return (folder / name).string();
    };
    const std::string model = write("broken.glb"), sky = write("broken.hdr");
    const auto server = test::VirtualDisplay::start();
    const test::ScopedVariable display("DISPLAY", server ? server->name() : "");
    const test::ScopedVariable stateHome("XDG_STATE_HOME", (folder / "state").string());
    for (size_t word : { 0u, 2u }) {
        const std::string whole = std::exchange(words[word], word == 0 ? model : sky);
        const char* name = word == 0 ? "broken.glb" : "broken.hdr";
        EXPECT_EQ(statusOf(with({ "--size", "64x36", "--frames-to", (folder / "frames").string() }), error), 1) << name;
        EXPECT_THAT(error, testing::HasSubstr(name));
        if (server) {
            EXPECT_EQ(statusOf(with({ "--size", "320x200", "--frames", "2" }), error), 1) << name;
            EXPECT_THAT(error, testing::HasSubstr(name));
        }
        words[word] = whole;
    }
}

TEST_F(RunViewer, FailuresAreOneLineAndAStatus) {
    const FakeFfmpeg none(folder / "bin", "");
    EXPECT_EQ(statusOf(with({ "--video", (folder / "a.mp4").string() }), error), 1);
    EXPECT_THAT(error, testing::HasSubstr("apt-get install ffmpeg"));
    EXPECT_EQ(std::ranges::count(error, '\n'), 1);
    words.back() = (folder / "missing.json").string();
    EXPECT_EQ(statusOf(with({ "--frames-to", (folder / "frames").string() }), error), 1);
    EXPECT_THAT(error, testing::HasSubstr("missing.json"));
    EXPECT_FALSE(fs::exists(folder / "frames"));
}

} // namespace
} // namespace filament_core::view
