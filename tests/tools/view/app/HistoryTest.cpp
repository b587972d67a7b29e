// SPDX-License-Identifier: Apache-2.0
// Undo and redo walk through what was edited, and leave the camera where it is.
#include "tools/view/app/History.h"

#include <gtest/gtest.h>

namespace filament_core::view {
namespace {

TEST(History, UndoAndRedoWalkThroughTheEdits) {
    Document document;
    History history(document);
    for (int i = 1; i <= 5; ++i) {
        setMorph(document, "smile", static_cast<float>(i));
        history.note(document, false);
        history.note(document, false); // nothing has changed
    }
    EXPECT_EQ(history.undoSteps(), 5u);
    for (int i = 4; i >= 1; --i) {
        EXPECT_TRUE(history.undo(document));
        EXPECT_EQ(document.morphs.front().weight, static_cast<float>(i));
    }
    EXPECT_TRUE(history.undo(document));
    EXPECT_TRUE(document.morphs.empty());
    EXPECT_FALSE(history.undo(document));
    for (int i = 1; i <= 5; ++i) EXPECT_TRUE(history.redo(document));
    EXPECT_EQ(document.morphs.front().weight, 5);
    EXPECT_FALSE(history.redo(document));
}

TEST(History, ADragIsOneStep) {
    Document document;
    History history(document);
    for (int i = 1; i <= 30; ++i) {
        setMorph(document, "smile", static_cast<float>(i) / 30);
        history.note(document, true);
    }
    history.note(document, false);
    EXPECT_EQ(history.undoSteps(), 1u);
    EXPECT_TRUE(history.undo(document));
    EXPECT_TRUE(document.morphs.empty());
}

TEST(History, CameraSizeAndTimeAreNotEdits) {
    Document document;
    History history(document);
    document.view.camera.worldFromView[3] = double4(1, 2, 3, 1);
    document.view.size = { 11, 12 };
    document.playback.seconds = 4;
    history.note(document, false);
    EXPECT_EQ(history.undoSteps(), 0u);
    setMorph(document, "smile", 1);
    history.note(document, false);
    document.view.camera.worldFromView[3] = double4(7, 8, 9, 1);
    EXPECT_TRUE(history.undo(document));
    EXPECT_EQ(document.view.camera.position(), double3(7, 8, 9));
    EXPECT_EQ(document.view.size, uint2(11, 12));
    EXPECT_TRUE(document.morphs.empty());
}

TEST(History, ANewEditForgetsWhatWasUndone) {
    Document document;
    History history(document);
    setMorph(document, "a", 1);
    history.note(document, false);
    EXPECT_TRUE(history.undo(document));
    setMorph(document, "b", 1);
    history.note(document, false);
    EXPECT_FALSE(history.redo(document));
    EXPECT_EQ(document.morphs.front().target, "b");
}

TEST(History, RedoDoesNotWriteOverAnEditThatWasNotNotedYet) {
    Document document;
    History history(document);
    setMorph(document, "a", 1);
    history.note(document, false);
    EXPECT_TRUE(history.undo(document));
    setMorph(document, "b", 1);
    EXPECT_FALSE(history.redo(document));
    EXPECT_EQ(document.morphs.front().target, "b");
    EXPECT_TRUE(history.undo(document)) << "it has become a step";
    EXPECT_TRUE(document.morphs.empty());
}

TEST(History, ThePlaybackComesBackWithItsModel) {
    Document document;
    document.model.file = "fox.glb";
    document.playback = { .animation = 2, .seconds = 1, .isPlaying = true };
    History history(document);
    document.playback.seconds = 3;
    Document other;
    other.model.file = "helmet.glb";
    document = other;
    history.note(document, false);
    EXPECT_TRUE(history.undo(document));
    EXPECT_EQ(document.model.file, "fox.glb");
    EXPECT_EQ(document.playback.animation, 2u);
    EXPECT_TRUE(history.redo(document));
    EXPECT_FALSE(document.playback.animation.has_value()) << "that of the helmet";
}

TEST(History, KeepsTheLastSteps) {
    Document document;
    History history(document);
    for (size_t i = 0; i < History::kSteps + 20; ++i) {
        setMorph(document, "a", static_cast<float>(i + 1));
        history.note(document, false);
    }
    EXPECT_EQ(history.undoSteps(), History::kSteps);
    for (size_t i = 0; i < History::kSteps; ++i) EXPECT_TRUE(history.undo(document));
    EXPECT_EQ(document.morphs.front().weight, 20);
}

} // namespace
} // namespace filament_core::view
