// SPDX-License-Identifier: Apache-2.0
// The command line of filament-view: what it takes, and one line for what it does not.
#include "tools/view/app/ViewerOptions.h"

#include <gmock/gmock.h>

namespace filament_core::view {
namespace {

Result<std::optional<ViewerOptions>> parse(std::vector<const char*> words) {
    words.insert(words.begin(), "filament-view");
    return parseViewerOptions(static_cast<int>(words.size()), words.data());
}

TEST(ViewerOptions, TakesTheWordsOfScripts) {
    const auto options =
            parse({ "model.glb", "--backend", "gles",    "--size",   "640x360", "--frames",  "3",   "--screenshot",
                    "shot.png",  "--present", "mailbox", "--panels", "off",     "--workers", "0",   "--panel",
                    "Motion",    "--panel",   "Log",     "--select", "torus",   "--compare", "flip" });
    ASSERT_TRUE(options.ok()) << options.error().message;
    ViewerOptions const& found = **options;
    EXPECT_EQ(found.model, "model.glb");
    EXPECT_EQ(found.backend, Backend::Gles);
    EXPECT_EQ(found.view.size, uint2(640, 360));
    EXPECT_EQ(found.frames, 3u);
    EXPECT_EQ(found.screenshot, "shot.png");
    EXPECT_EQ(found.presentMode, PresentMode::Mailbox);
    EXPECT_FALSE(found.panels);
    EXPECT_EQ(found.workers, 0);
    EXPECT_EQ(found.openPanels, (std::vector<std::string>{ "Motion", "Log" }));
    EXPECT_EQ(found.select, "torus");
    EXPECT_EQ(found.compare, CompareMode::Flip);
}

TEST(ViewerOptions, TakesTheWordsOfCameraPaths) {
    const auto shown = parse({ "--camera-path", "p.json" });
    ASSERT_TRUE(shown.ok()) << shown.error().message;
    EXPECT_EQ((*shown)->cameraPath, "p.json");
    EXPECT_FALSE((*shown)->drawsPath()) << "a window opens";
    const auto drawn = parse({ "--camera-path", "p.json", "--frames-to", "frames", "--fps", "29.97", "--frame-format",
                               "exr", "--video", "a.mp4" });
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    EXPECT_TRUE((*drawn)->drawsPath());
    EXPECT_EQ((*drawn)->series.folder, "frames");
    EXPECT_EQ((*drawn)->series.video, "a.mp4");
    EXPECT_EQ((*drawn)->series.framesPerSecond, 29.97);
    EXPECT_EQ((*drawn)->series.format, PictureFormat::Exr);
}

TEST(ViewerOptions, NamesWhatIsWrong) {
    const std::pair<std::vector<const char*>, const char*> cases[] = {
        { { "--backend", "metal" }, "--backend" },
        { { "--present", "soon" }, "--present" },
        { { "--frames", "-1" }, "--frames" },
        { { "--panels", "maybe" }, "--panels" },
        { { "--compare", "twice" }, "--compare" },
        { { "--workers", "many" }, "--workers" },
        { { "--screenshot", "a.png" }, "--frames" },
        { { "--frames", "1", "--screenshot", "a.gif" }, ".png" },
        { { "--size", "0x0" }, "--size" },
        { { "--frames-to", "frames" }, "--camera-path" },
        { { "--video", "a.mp4" }, "--camera-path" },
        { { "--frames-to", "frames", "--camera-path", "p.json", "--frames", "3" }, "--frames" },
        { { "--fps", "0" }, "--fps" },
        { { "--panel", "Kitchen" }, "one of Scene, Materials" },
        { { "--fps", "fast" }, "--fps" },
        { { "--frame-format", "gif" }, "png or exr" },
    };
    for (auto const& [words, part] : cases) {
        const auto options = parse(words);
        ASSERT_FALSE(options.ok()) << words[0];
        EXPECT_THAT(options.error().message, testing::HasSubstr(part));
        EXPECT_EQ(options.error().message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace filament_core::view
