// SPDX-License-Identifier: Apache-2.0
// The viewer without a window: events in, documents and images out, on both APIs.
#include "tools/view/app/Viewer.h"
#include "tests/base/ScopedVariable.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/tools/view/app/HeadlessViewer.h"

#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace filament_core::view {
namespace {

class ViewerTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, ViewerTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& tested) { return std::string(toString(tested.param)); });

TEST_P(ViewerTest, DrawsNothingWhileNothingChanges) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.settle();
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(headless.viewer->step(0.1));
    headless.viewer->handle(MouseMoveEvent{ { 300, 200 } });
    EXPECT_TRUE(headless.viewer->step(0.01));
    headless.settle();
    EXPECT_FALSE(headless.viewer->step(0.1));
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, DragsTurnTheCameraAndKeysMoveIt) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.viewer->panels().state.showsPanels = false;
    const Image before = headless.picture();
    headless.viewer->handle(MouseMoveEvent{ { 300, 200 } });
    headless.viewer->step(0.01);
    headless.viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
    headless.viewer->handle(MouseMoveEvent{ { 360, 220 } });
    headless.viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
    const Image turned = headless.picture();
    EXPECT_NE(turned.pixels, before.pixels);
    headless.press(268); // Home
    EXPECT_EQ(headless.picture().pixels, before.pixels) << "back to the beginning";
    headless.viewer->handle(KeyEvent{ 'W', true, {} });
    EXPECT_TRUE(headless.viewer->step(0.1));
    headless.viewer->handle(KeyEvent{ 'W', false, {} });
    EXPECT_NE(headless.picture().pixels, before.pixels);
}

TEST_P(ViewerTest, ClicksSelectWhatIsUnderThem) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.viewer->panels().state.showsPanels = false;
    headless.settle();
    headless.click({ 320, 200 });
    headless.settle();
    ASSERT_TRUE(headless.viewer->panels().state.selectedNode.has_value());
    const Image selected = headless.picture();
    headless.press('H'); // hides it
    EXPECT_NE(headless.picture().pixels, selected.pixels);
    headless.press('Z', { .control = true });
    EXPECT_EQ(headless.picture().pixels, selected.pixels) << "undone";
    headless.press(256); // Esc
    EXPECT_FALSE(headless.viewer->panels().state.selectedNode.has_value());
}

TEST_P(ViewerTest, EveryActionLeavesAViewerThatDraws) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    for (Shortcut const& shortcut : shortcuts()) {
        const bool hasOwnTest = shortcut.action == Action::SaveFrame || shortcut.action == Action::CompareWith;
        if (shortcut.action == Action::Quit || hasOwnTest) continue;
        headless.viewer->perform(shortcut.action);
        const Image image = headless.picture(labelOf(shortcut));
        EXPECT_EQ(uint2(image.width, image.height), kSmallPicture) << labelOf(shortcut);
        EXPECT_FALSE(headless.viewer->isClosed());
    }
    headless.viewer->perform(Action::Quit);
    EXPECT_TRUE(headless.viewer->isClosed());
}

/// For as long as it lives, Vulkan's loader finds no driver.
struct WithoutVulkan {
    test::ScopedVariable oldName{ "VK_ICD_FILENAMES", "/nowhere/driver.json" };
    test::ScopedVariable driverFiles{ "VK_DRIVER_FILES", "/nowhere/driver.json" };
};

TEST(Viewer, WithoutAnyDeviceItKeepsTheDocumentInAFileAndCloses) {
    ViewerOptions options = testOptions(Backend::Vulkan);
    options.out = test::folderOfThisTest();
    std::filesystem::remove_all(options.out);
    Headless headless(options);
    if (!headless.viewer) return;
    headless.settle();
    setMorph(headless.viewer->document(), "smile", 0.25f);
    {
        const WithoutVulkan gone;
        headless.viewer->panels().state.recordsJobs = true; // the engine is opened again
        EXPECT_FALSE(headless.viewer->step(0.01));
    }
    EXPECT_TRUE(headless.viewer->isClosed());
    const Result<Document> kept = loadDocument(options.out / "viewer-1.json");
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    EXPECT_TRUE(*kept == headless.viewer->document());
    EXPECT_THAT(headless.viewer->takeMessages(), testing::Contains(testing::HasSubstr("saved")));
    headless.viewer->handle(MouseMoveEvent{ { 3, 4 } });
    headless.press('B');
    EXPECT_FALSE(headless.viewer->step(0.01)) << "nothing happens any more";
    EXPECT_FALSE(headless.viewer->isLoading());
    EXPECT_FALSE(headless.viewer->screenshot().ok());
}

TEST_P(ViewerTest, PicturesFollowTheSizeOfTheWindow) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.settle();
    for (uint2 size : { uint2(1, 1), uint2(200, 700), uint2(1031, 77), kPictureSize }) {
        headless.viewer->handle(ResizeEvent{ size, 1 });
        const Image image = headless.picture();
        EXPECT_EQ(uint2(image.width, image.height), size);
    }
    headless.viewer->handle(ResizeEvent{ uint2(0), 1 }); // minimised
    EXPECT_FALSE(headless.viewer->step(0.1));
    EXPECT_GT(headless.viewer->idleSeconds(), 0.1) << "nobody sees what changes";
    headless.viewer->handle(ResizeEvent{ kPictureSize, 2 }); // a dense display
    EXPECT_EQ(headless.picture().width, kPictureSize.x);
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, DroppedFilesAreShownOrNamed) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    const Image before = headless.picture();
    headless.viewer->handle(DropEvent{ { "/nowhere/at.all", "/nowhere/model.glb" } });
    headless.settle();
    const std::vector<std::string> messages = headless.viewer->takeMessages();
    EXPECT_THAT(messages, testing::Contains(testing::HasSubstr("/nowhere/at.all")));
    EXPECT_THAT(messages, testing::Contains(testing::HasSubstr("/nowhere/model.glb")));
    EXPECT_EQ(uint2(before.width, before.height), kSmallPicture);
    headless.viewer->handle(DropEvent{ { showcaseFiles().model } });
    headless.settle();
    EXPECT_EQ(headless.viewer->stage().shownFile(), showcaseFiles().model);
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, TheOtherApiShowsTheSamePixelsLive) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.settle();
    for (CompareMode mode : { CompareMode::Wipe, CompareMode::Difference }) {
        headless.viewer->perform(Action::Compare);
        headless.settle();
        ASSERT_TRUE(headless.viewer->compared().result().has_value()) << toString(mode);
        EXPECT_EQ(headless.viewer->compared().result()->percentage(), "100.0000 %");
    }
    headless.viewer->document().view.camera.worldFromView[3] += double4(0.1, 0.05, 0, 0);
    headless.viewer->handle(MouseMoveEvent{ { 300, 200 } });
    headless.settle();
    EXPECT_EQ(headless.viewer->compared().result()->percentage(), "100.0000 %");
}

TEST_P(ViewerTest, TheLineOfAWipeIsDraggedAndTheCameraStays) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.viewer->panels().state.showsPanels = false;
    headless.viewer->perform(Action::Compare);
    headless.settle();
    const double4x4 before = headless.viewer->document().view.camera.worldFromView;
    const auto drag = [&](float from, float to) {
        headless.viewer->handle(MouseMoveEvent{ { from, 100 } });
        headless.viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
        headless.viewer->handle(MouseMoveEvent{ { to, 120 } });
        headless.viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
        headless.settle();
    };
    drag(320, 160);
    EXPECT_EQ(headless.viewer->compared().wipePosition, 0.25f);
    EXPECT_EQ(headless.viewer->document().view.camera.worldFromView, before);
    EXPECT_FALSE(headless.viewer->panels().state.selectedNode.has_value());
    drag(400, 420); // beside the line
    EXPECT_EQ(headless.viewer->compared().wipePosition, 0.25f);
    EXPECT_NE(headless.viewer->document().view.camera.worldFromView, before);
}

TEST_P(ViewerTest, ThePathTracerDrawsBesideTheViewer) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.viewer->handle(ResizeEvent{ { 96, 54 }, 1 });
    headless.settle();
    headless.viewer->perform(Action::CompareWith);
    ASSERT_TRUE(headless.stepUntil([&] { return headless.viewer->compared().result().has_value(); }))
            << "after its first pass";
    EXPECT_EQ(headless.viewer->compared().result()->pixels, 96u * 54);
    EXPECT_LT(headless.viewer->compared().result()->identical, 96u * 54) << "it sees what the engine approximates";
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, WhatItIsComparedWithMayChangeWhileThatStarts) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.settle();
    headless.viewer->perform(Action::Compare);
    for (int i = 0; i < 6; ++i) { // the path tracer, which loads its scene, and the other API
        headless.viewer->perform(Action::CompareWith);
        headless.viewer->step(0.01);
    }
    ASSERT_EQ(headless.viewer->compared().with, CompareWith::OtherApi);
    headless.settle();
    ASSERT_TRUE(headless.viewer->compared().result().has_value());
    EXPECT_EQ(headless.viewer->compared().result()->percentage(), "100.0000 %");
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, ChangingTheApiKeepsThePicture) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.viewer->panels().state.showsPanels = false; // they name the device
    const Image before = headless.picture();
    headless.press('B');
    EXPECT_NE(headless.viewer->stage().engine().device().backend, GetParam());
    EXPECT_EQ(headless.picture().pixels, before.pixels);
    headless.press('B');
    EXPECT_EQ(headless.viewer->stage().engine().device().backend, GetParam());
    EXPECT_EQ(headless.picture().pixels, before.pixels);
    EXPECT_THAT(headless.viewer->takeMessages(), testing::IsEmpty());
}

TEST_P(ViewerTest, SavedFramesDrawThemselvesAgain) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.settle();
    headless.viewer->perform(Action::SaveFrame);
    headless.settle(); // busy until it is saved
    const std::vector<std::string> messages = headless.viewer->takeMessages();
    ASSERT_THAT(messages, testing::Contains(testing::HasSubstr("filament-replay draws it again")));
    EXPECT_EQ(messages.size(), 2u) << messages.back(); // and that it began
}

} // namespace
} // namespace filament_core::view
