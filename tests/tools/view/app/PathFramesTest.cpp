// SPDX-License-Identifier: Apache-2.0
// A camera path drawn to files, on both APIs.
#include "tools/view/app/PathFrames.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/FakeFfmpeg.h"
#include "tests/tools/view/app/TestScene.h"
#include "tools/view/camera/PathSampling.h"
#include "tools/view/stage/Stage.h"

#include <gmock/gmock.h>

#include <thread>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

constexpr uint2 kFrameSize{ 96, 54 };

CameraPath shortPath() {
    CameraPath path{ .name = "round" };
    for (int i = 0; i < 3; ++i)
        path.keys.push_back({ .seconds = 0.5 * i, .camera = Camera::lookAt({ 1.2 - 0.8 * i, 0.6, 1.5 }, double3(0)) });
    return path;
}

/// Of 5 frames.
PathRequest requestFor(fs::path const& folder, Backend backend) {
    PathRequest request{ .document = showcaseDocument(kFrameSize), .path = shortPath() };
    request.document.view.quality.antiAliasing = AntiAliasing::Taa; // accumulates frames
    request.document.view.effects.autoExposure.enabled = true;      // adapts with the time
    request.series = { .folder = folder, .framesPerSecond = 4 };
    request.engine = { .backend = backend, .workers = 1, .validation = true };
    return request;
}

PathResult drawn(PathRequest const& request) {
    PathProgress progress;
    const Result<PathResult> result = drawPath(request, progress);
    EXPECT_TRUE(result.ok()) << (result ? "" : result.error().message);
    if (!result) return {};
    EXPECT_EQ(progress.done, result->frames);
    EXPECT_EQ(progress.total, result->frames);
    return *result;
}

std::vector<std::string> namesIn(fs::path const& folder) {
    std::vector<std::string> names;
    for (auto const& each : fs::directory_iterator(folder)) names.push_back(each.path().filename().string());
    std::ranges::sort(names);
    return names;
}

fs::path emptyFolder() {
    const fs::path folder = test::folderOfThisTest();
    fs::remove_all(folder);
    return folder;
}

TEST(PathFrames, AreTheSameBitsOnBothApisAndAgain) {
    const fs::path folder = emptyFolder();
    for (const PictureFormat format : { PictureFormat::Png, PictureFormat::Exr }) {
        const std::string ending = endingOf(format);
        const auto draw = [&](const char* name, Backend backend) {
            PathRequest request = requestFor(folder / (name + ending), backend);
            request.series.format = format;
            const PathResult result = drawn(request);
            EXPECT_EQ(result.frames, 5u);
            EXPECT_THAT(result.messages, testing::IsEmpty());
        };
        draw("vulkan", Backend::Vulkan);
        draw("again", Backend::Vulkan);
        draw("gles", Backend::Gles);
        EXPECT_EQ(namesIn(folder / ("gles" + ending)).size(), 5u);
        std::string last;
        for (uint32_t frame = 0; frame < 5; ++frame) {
            const std::string name = frameName(frame, format);
            const std::string bytes = textOfFile(folder / ("vulkan" + ending) / name);
            EXPECT_GT(bytes.size(), 1000u) << name;
            EXPECT_NE(bytes, last) << name << ": the camera moves";
            EXPECT_EQ(bytes, textOfFile(folder / ("gles" + ending) / name)) << name;
            EXPECT_EQ(bytes, textOfFile(folder / ("again" + ending) / name)) << name;
            last = bytes;
        }
    }
}

TEST(PathFrames, FramesLookThroughTheKeys) {
    const fs::path folder = emptyFolder();
    PathRequest request = requestFor(folder, Backend::Vulkan);
    request.document.view.quality.antiAliasing = AntiAliasing::Off;
    request.document.view.effects.autoExposure.enabled = false;
    drawn(request);
    auto stage = Stage::create({ .engine = request.engine });
    ASSERT_TRUE(stage.ok());
    for (uint32_t key = 0; key < 3; ++key) {
        Document document = request.document;
        document.view.camera = request.path.keys[key].camera;
        (*stage)->apply(document);
        (*stage)->finishLoading();
        const Result<Image> expected = (*stage)->renderToImage();
        const Result<Image> frame =
                loadImage(folder / frameName(2 * key, PictureFormat::Png), { .content = ImageContent::Data });
        ASSERT_TRUE(expected.ok() && frame.ok());
        EXPECT_EQ(expected->pixels, frame->pixels) << "key " << key;
    }
}

TEST(PathFrames, CancellingEndsTheLoadOfTheFilesToo) {
    const fs::path folder = emptyFolder();
    PathProgress progress;
    progress.isCancelled = true;
    const Result<PathResult> result = drawPath(requestFor(folder, Backend::Vulkan), progress);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
    EXPECT_THAT(result.error().message, testing::HasSubstr("being loaded"));
    EXPECT_EQ(progress.total, 0u) << "no frame was begun";
}

TEST(PathFrames, RequestsThatMakeNoSenseAreRefusedBeforeAnythingIsDrawn) {
    const fs::path folder = emptyFolder();
    const PathRequest good = requestFor(folder, Backend::Vulkan);
    EXPECT_TRUE(check(good).ok());
    const auto refusal = [&](auto const& spoil) {
        PathRequest request = good;
        spoil(request);
        PathProgress progress;
        const Result<PathResult> result = drawPath(request, progress);
        EXPECT_FALSE(result.ok());
        EXPECT_FALSE(fs::exists(folder));
        return result ? "" : result.error().message;
    };
    using testing::HasSubstr;
    EXPECT_THAT(refusal([](PathRequest& r) { r.path.keys.clear(); }), HasSubstr("has no keys"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.path.keys[1].seconds = 0; }), HasSubstr("path.keys[1].seconds"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.path.keys[2].seconds = 1e8; }),
                HasSubstr("at most 100000 are recorded"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.series.framesPerSecond = std::nan(""); }), HasSubstr("frames a second"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.series.framesPerSecond = 0; }), HasSubstr("frames a second"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.series.folder.clear(); }), HasSubstr("to a folder, to a video"));
    EXPECT_THAT(refusal([](PathRequest& r) { r.series.video = "a.gif"; }), HasSubstr(".mp4"));
    EXPECT_THAT(refusal([](PathRequest& r) {
                    r.series.video = "a.mp4";
                    r.series.format = PictureFormat::Exr;
                }),
                HasSubstr("PNG"));
}

TEST(PathFrames, FailuresNameTheirFile) {
    const fs::path folder = emptyFolder();
    fs::create_directories(folder);
    std::ofstream(folder / "taken") << "a file";
    PathProgress progress;
    Result<PathResult> result = drawPath(requestFor(folder / "taken", Backend::Vulkan), progress);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, testing::HasSubstr((folder / "taken").string()));
    PathRequest missing = requestFor(folder / "frames", Backend::Vulkan);
    missing.document.model.file = "/nowhere/model.glb";
    result = drawPath(missing, progress);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, testing::HasSubstr("/nowhere/model.glb"));
    fs::create_directories(folder / "blocked" / frameName(3, PictureFormat::Png));
    result = drawPath(requestFor(folder / "blocked", Backend::Vulkan), progress);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, testing::HasSubstr("frame-00003.png"));
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
}

TEST(PathFrames, AVideoAloneLeavesNoFrames) {
    const fs::path folder = emptyFolder();
    // It looks at the frames that it is given.
    const std::string counts =
            "n=0; for f in \"$(dirname \"$last\")\"/.*.frames/frame-*.png; do n=$((n+1)); done; echo $n > \"$last\"";
    const FakeFfmpeg ffmpeg(folder / "bin", scriptThatKeepsWords(folder / "words") + "\n" + counts);
    PathRequest request = requestFor({}, Backend::Gles);
    request.series.video = folder / "videos/round.mp4";
    drawn(request);
    EXPECT_EQ(textOfFile(request.series.video), "5\n");
    EXPECT_THAT(namesIn(folder / "videos"), testing::ElementsAre("round.mp4"));
    EXPECT_THAT(textOfFile(folder / "words"), testing::HasSubstr("-framerate\n4\n"));
}

TEST(PathRecorder, DrawsBesideItsCallerAndStops) {
    const fs::path folder = emptyFolder();
    PathRecorder recorder;
    ASSERT_TRUE(recorder.start(requestFor(folder / "all", Backend::Vulkan)));
    EXPECT_FALSE(recorder.start(requestFor(folder / "second", Backend::Vulkan))) << "one at a time";
    const auto lines = [&] {
        for (int i = 0; i < 60'000; ++i) {
            if (auto found = recorder.poll()) return *found;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return std::vector<std::string>{ "it does not end" };
    };
    EXPECT_THAT(lines(), testing::ElementsAre(testing::HasSubstr("recorded 5 frames to")));
    PathRequest lasting = requestFor(folder / "some", Backend::Vulkan);
    lasting.series.framesPerSecond = 1000;
    ASSERT_TRUE(recorder.start(lasting));
    while (recorder.progress().done < 2) letOthersWork();
    recorder.cancel();
    EXPECT_THAT(lines(), testing::ElementsAre(testing::HasSubstr("stopped after")));
    EXPECT_FALSE(recorder.isBusy());
}

} // namespace
} // namespace filament_core::view
