// SPDX-License-Identifier: Apache-2.0
// What a viewer reads and writes: images, recordings, the clipboard, recent files; and where its image is.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/HeadlessViewer.h"
#include "tools/view/camera/PathSampling.h"
#include "tools/view/document/TextForms.h"

#include <gmock/gmock.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

double threadSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

constexpr int kF12 = 301, kEnter = 257; // of GLFW

class ViewerFiles : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        folder = test::folderOfThisTest();
        fs::remove_all(folder);
        fs::create_directories(folder);
        ViewerOptions options = testOptions(GetParam());
        options.out = folder;
        options.recentFiles = folder / "state/recent.json";
        headless.emplace(options);
        ASSERT_TRUE(headless->viewer);
    }
    Viewer& viewer() { return *headless->viewer; }
    PanelState& state() { return viewer().panels().state; }
    /// Settles, with time for threads.
    void settle() {
        headless->settle();
        std::this_thread::yield();
        headless->settle();
    }
    std::vector<std::byte> pixelsOf(fs::path const& file) {
        const Result<Image> image = loadImage(file, { .content = ImageContent::Data });
        EXPECT_TRUE(image.ok()) << (image ? "" : image.error().message);
        return image ? image->pixels : std::vector<std::byte>{};
    }
    fs::path folder;
    std::optional<Headless> headless;
};
INSTANTIATE_TEST_SUITE_P(Apis, ViewerFiles, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(ViewerFiles, F12SavesWhatIsShownAndIsNotWaitedFor) {
    state().showsPanels = false;
    const Image shown = headless->picture();
    headless->press(kF12);
    headless->press(kF12); // at once: another file
    EXPECT_FALSE(fs::exists(folder / "viewer-1.png")) << "a key draws and writes nothing by itself";
    EXPECT_LT(viewer().idleSeconds(), 0.1);
    settle();
    EXPECT_THAT(viewer().takeMessages(), testing::ElementsAre(HasSubstr("viewer-1.png"), HasSubstr("viewer-2.png")));
    EXPECT_EQ(pixelsOf(folder / "viewer-1.png"), shown.pixels);
    EXPECT_EQ(pixelsOf(folder / "viewer-2.png"), shown.pixels);
    state().pictureKind = FrameKind::Exr;
    headless->press(kF12);
    settle();
    const Result<Image> light = loadImage(folder / "viewer-1.exr");
    ASSERT_TRUE(light.ok()) << light.error().message;
    EXPECT_EQ(uint2(light->width, light->height), kPictureSize);
    EXPECT_EQ(light->format, Format::RGBA16F);
    EXPECT_EQ(viewer().takeMessages().size(), 1u);
}

TEST_P(ViewerFiles, SavedPicturesHaveNoPanels) {
    headless->settle();
    headless->press(kF12);
    settle();
    const Result<Image> saved = loadImage(folder / "viewer-1.png");
    ASSERT_TRUE(saved.ok());
    EXPECT_EQ(uint2(saved->width, saved->height), viewer().document().view.size);
    EXPECT_LT(saved->width, kPictureSize.x);
}

TEST_P(ViewerFiles, PicturesThatCannotBeWrittenOrReadSaySo) {
    headless->settle();
    fs::remove_all(folder);
    headless->press(kF12);
    settle();
    const std::vector<std::string> messages = viewer().takeMessages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0], HasSubstr("viewer-1.png"));
    headless->press(kF12);
    viewer().setBackend(GetParam() == Backend::Vulkan ? Backend::Gles : Backend::Vulkan); // before it is there
    settle();
    EXPECT_THAT(viewer().takeMessages(), testing::Contains(HasSubstr("the engine that drew it ended")));
}

TEST_P(ViewerFiles, ThePictureLiesBetweenThePanels) {
    headless->settle();
    const PanelRect place = viewer().panels().layout().picture;
    ASSERT_GT(place.position.x, 0);
    EXPECT_EQ(viewer().document().view.size, uint2(place.size));
    const Image window = headless->picture();
    EXPECT_EQ(uint2(window.width, window.height), kPictureSize);
    const Result<Image> alone = viewer().stage().renderToImage();
    ASSERT_TRUE(alone.ok());
    ASSERT_EQ(uint2(alone->width, alone->height), uint2(place.size));
    size_t different = 0;
    for (uint32_t y = 0; y < alone->height; ++y)
        different +=
                std::memcmp(&alone->pixels[size_t{ y } * alone->width * 4],
                            &window.pixels[(size_t{ y } * window.width + static_cast<uint32_t>(place.position.x)) * 4],
                            size_t{ alone->width } * 4) != 0;
    EXPECT_EQ(different, 0u) << "rows, to the bit";
    headless->press(258); // Tab
    headless->settle();
    EXPECT_EQ(viewer().document().view.size, kPictureSize);
}

TEST_P(ViewerFiles, ClicksBetweenThePanelsSelectWhatTheyShow) {
    headless->settle();
    const PanelRect place = viewer().panels().layout().picture;
    // A pixel of the image, at the same place of the scene as without panels.
    headless->click(place.position + place.size * float2(0.5f, 0.55f));
    headless->settle();
    const std::optional<uint32_t> found = state().selectedNode;
    ASSERT_TRUE(found.has_value());
    const PickTicket ticket = viewer().stage().renderer().pick(viewer().stage().scene(), viewer().stage().view(),
                                                               uint2(place.size * float2(0.5f, 0.55f)));
    const Result<PickHit> hit = viewer().stage().renderer().waitPick(ticket);
    ASSERT_TRUE(hit.ok() && *hit);
    EXPECT_EQ(viewer().stage().indexOf(hit->node), found);
}

TEST_P(ViewerFiles, TheLineOfAWipeLiesInThePicture) {
    headless->settle();
    viewer().perform(Action::Compare);
    headless->settle();
    ASSERT_TRUE(viewer().compared().result().has_value());
    EXPECT_EQ(viewer().compared().result()->percentage(), "100.0000 %") << "of the picture, not of the window";
    const PanelRect place = viewer().panels().layout().picture;
    EXPECT_EQ(viewer().compared().result()->pixels, static_cast<uint64_t>(place.size.x * place.size.y));
    const auto at = [&](float share) { return float2(place.position.x + place.size.x * share, 200); };
    viewer().handle(MouseMoveEvent{ at(0.5f) });
    viewer().handle(MouseButtonEvent{ MouseButton::Left, true, {} });
    viewer().handle(MouseMoveEvent{ at(0.25f) });
    viewer().handle(MouseButtonEvent{ MouseButton::Left, false, {} });
    headless->settle();
    EXPECT_NEAR(viewer().compared().wipePosition, 0.25f, 1e-5f);
}

TEST_P(ViewerFiles, FlipIsComputedBesideTheViewer) {
    state().showsPanels = false;
    headless->settle();
    for (int i = 0; i < 3; ++i) viewer().perform(Action::Compare);
    ASSERT_EQ(viewer().compared().mode, CompareMode::Flip);
    double worst = 0; // of the processor time that this thread spends in a step
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (viewer().compared().isWaiting() && std::chrono::steady_clock::now() < end) {
        const double before = threadSeconds();
        viewer().step(0.01);
        worst = std::max(worst, threadSeconds() - before);
    }
    const Result<Image> image = viewer().stage().renderToImage();
    ASSERT_TRUE(image.ok());
    const double before = threadSeconds();
    ASSERT_TRUE(flipMap(*image, *image).ok());
    EXPECT_LT(worst, (threadSeconds() - before) / 2) << "what a map takes";
    ASSERT_TRUE(viewer().compared().result().has_value());
    EXPECT_FALSE(viewer().compared().isWaiting());
    EXPECT_EQ(viewer().compared().result()->percentage(), "100.0000 %");
}

TEST_P(ViewerFiles, DocumentsAndCamerasTravelAsText) {
    headless->settle();
    viewer().document().view.camera = Camera::lookAt({ 2, 1, 2 }, double3(0));
    const Camera copied = viewer().document().view.camera;
    headless->press('C', { .shift = true, .control = true });
    viewer().document().view.camera = Camera::lookAt({ -2, 1, 2 }, double3(0));
    headless->press('V', { .control = true });
    EXPECT_TRUE(isEqual(viewer().document().view.camera, copied));
    setMorph(viewer().document(), "smile", 0.5f);
    headless->press('C', { .control = true });
    setMorph(viewer().document(), "smile", 1);
    headless->press('V', { .control = true });
    EXPECT_EQ(viewer().document().morphs.front().weight, 0.5f);
    ImGui::SetClipboardText("a shopping list");
    viewer().takeMessages();
    headless->press('V', { .control = true });
    EXPECT_THAT(viewer().takeMessages(), testing::ElementsAre(HasSubstr("the clipboard: this is no JSON text")));
}

TEST_P(ViewerFiles, EditsThatWereNotSavedAreKept) {
    const fs::path last = folder / "state/last.json";
    settle();
    viewer().document().view.camera.exposure.iso *= 2; // no edit
    viewer().keepEdits();
    EXPECT_FALSE(fs::exists(last));
    viewer().document().view.effects.bloom.enabled = true;
    viewer().perform(Action::SaveDocument);
    viewer().keepEdits();
    EXPECT_FALSE(fs::exists(last)) << "a file has it";
    viewer().document().view.effects.bloom.strength = 0.7f;
    viewer().perform(Action::Quit);
    viewer().keepEdits();
    const Result<Document> kept = loadDocument(last);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    EXPECT_EQ(*kept, viewer().document());
    EXPECT_THAT(viewer().takeMessages(), testing::Contains(HasSubstr(last.string())));
    fs::remove_all(folder / "state");
    std::ofstream(folder / "state") << "in the way";
    viewer().keepEdits();
    EXPECT_THAT(viewer().takeMessages(), testing::Contains(HasSubstr("last.json"))) << "not kept, and said so";
}

TEST_P(ViewerFiles, ControlOOpensTheDialogAndKeysAreItsOwn) {
    headless->settle();
    headless->press('O', { .control = true });
    headless->press('B'); // not the other API
    settle();
    EXPECT_EQ(viewer().stage().engine().device().backend, GetParam());
    ASSERT_TRUE(viewer().panels().fileDialog.isOpen());
    headless->press(kEscape);
    settle();
    EXPECT_FALSE(viewer().panels().fileDialog.isOpen());
    headless->press('O', { .control = true });
    viewer().panels().fileDialog.goTo(showcaseFiles().model.parent_path());
    settle();
    for (const char c : showcaseFiles().model.filename().string())
        viewer().handle(TextEvent{ static_cast<uint32_t>(c) });
    settle();
    headless->press(kEnter);
    settle();
    EXPECT_FALSE(viewer().panels().fileDialog.isOpen());
    ASSERT_EQ(viewer().panels().fileDialog.recent.size(), 1u);
    EXPECT_EQ(viewer().panels().fileDialog.recent[0], showcaseFiles().model);
    EXPECT_EQ(RecentFiles(folder / "state/recent.json").files().size(), 1u) << "for the next run";
}

TEST_P(ViewerFiles, TheEndingOfASavedPictureSaysItsFormatInAnyCase) {
    headless->settle();
    for (const char* name : { "small.exr", "LARGE.EXR", "small.png", "LARGE.PNG" }) {
        viewer().panels().fileDialog.goTo(folder);
        viewer().panels().fileDialog.open(FilePurpose::SavePicture, name);
        settle();
        headless->press(kEnter);
        settle();
        const Result<Image> image = loadImage(folder / name, { .content = ImageContent::Data });
        ASSERT_TRUE(image.ok()) << name << ": " << image.error().message;
        const bool isLight = std::string_view(name).ends_with(".exr") || std::string_view(name).ends_with(".EXR");
        EXPECT_EQ(image->format, isLight ? Format::RGBA16F : Format::RGBA8) << name;
    }
}

TEST_P(ViewerFiles, PathsAreRecordedPlayedSavedAndLoaded) {
    headless->settle();
    const auto look = [&](double x) {
        viewer().document().view.camera = Camera::lookAt({ x, 0.6, 1.5 }, double3(0));
        headless->press('K');
    };
    look(0.9);
    look(0);
    look(-0.9);
    ASSERT_EQ(viewer().document().paths.size(), 1u);
    const CameraPath path = viewer().document().paths[0];
    ASSERT_EQ(path.keys.size(), 3u);
    headless->press(' ', { .shift = true });
    EXPECT_LT(viewer().idleSeconds(), 0.1);
    state().path.seconds = 0;
    ASSERT_TRUE(state().path.isPlaying);
    viewer().step(1.25);
    EXPECT_TRUE(isEqual(viewer().document().view.camera, sampled(path, 1.25)));
    headless->press(' ', { .shift = true });
    viewer().panels().fileDialog.goTo(folder);
    viewer().panels().fileDialog.open(FilePurpose::SavePath, "mine.json");
    settle();
    headless->press(kEnter);
    settle();
    const Result<CameraPath> saved = loadCameraPath(folder / "mine.json");
    ASSERT_TRUE(saved.ok()) << saved.error().message;
    EXPECT_TRUE(*saved == path);
    viewer().handle(DropEvent{ { folder / "mine.json" } });
    settle();
    ASSERT_EQ(viewer().document().paths.size(), 2u);
    EXPECT_TRUE(viewer().document().paths[1] == path);
    EXPECT_EQ(state().path.path, 1u) << "the panel shows it";
}

TEST_P(ViewerFiles, RecordingGoesOnBesideTheViewer) {
    state().showsPanels = false;
    headless->settle();
    for (double x : { 0.9, 0.8 }) {
        viewer().document().view.camera = Camera::lookAt({ x, 0.6, 1.5 }, double3(0));
        headless->press('K');
    }
    viewer().document().paths[0].keys[1].seconds = 0.1;
    viewer().handle(ResizeEvent{ { 96, 54 }, 1 });
    state().recording.framesPerSecond = 20;
    viewer().panels().requests.recordsPath = true;
    viewer().redraw();
    viewer().step(0.01);
    EXPECT_LT(viewer().idleSeconds(), 0.1);
    settle();
    EXPECT_THAT(viewer().takeMessages(), testing::Contains(HasSubstr("recorded 3 frames to")));
    EXPECT_TRUE(fs::exists(folder / "viewer-1.frames/frame-00002.png"));
    EXPECT_FALSE(viewer().panels().inputs.recording.isRunning);
}

TEST_P(ViewerFiles, LatenciesAreMeasured) {
    headless->settle();
    for (int i = 0; i < 10; ++i) {
        viewer().handle(MouseMoveEvent{ { 300.0f + static_cast<float>(i), 200 } });
        viewer().step(0.01);
        viewer().step(0.01);
    }
    EXPECT_GE(viewer().latency().count, 10u);
    EXPECT_GT(viewer().latency().median, 0);
    EXPECT_GE(viewer().latency().p95, viewer().latency().median);
    EXPECT_GE(viewer().panels().latency.inFlight().count, 10u);
}

} // namespace
} // namespace filament_core::view
