// SPDX-License-Identifier: Apache-2.0
// What the panel of camera paths does to keys and to time.
#include "tools/view/panels/PathModel.h"
#include "tools/view/camera/PathSampling.h"
#include "tools/view/document/TextForms.h"

#include <gtest/gtest.h>

#include <limits>

namespace filament_core::view {
namespace {

Camera at(double x) { return Camera::lookAt({ x, 0, 5 }, { x, 0, 0 }); }
double placeOf(Camera const& camera) { return camera.position().x; }

std::vector<double> timesOf(CameraPath const& path) {
    std::vector<double> times;
    for (CameraKey const& key : path.keys) times.push_back(key.seconds);
    return times;
}
std::vector<double> placesOf(CameraPath const& path) {
    std::vector<double> places;
    for (CameraKey const& key : path.keys) places.push_back(placeOf(key.camera));
    return places;
}

/// Three keys, at 0, 2 and 4 s, at x = 0, 1 and 2.
struct Recorded {
    Document document;
    PathState state;

    Recorded() {
        for (int i = 0; i < 3; ++i) addKey(path(), state, at(i));
    }
    CameraPath& path() { return shownPath(document, state); }
};

using Reals = std::vector<double>;

TEST(PathModel, KeysAreAddedAfterTheSelectedOne) {
    Recorded recorded;
    EXPECT_EQ(timesOf(recorded.path()), (Reals{ 0, 2, 4 }));
    recorded.state.key = 0;
    addKey(recorded.path(), recorded.state, at(7));
    EXPECT_EQ(timesOf(recorded.path()), (Reals{ 0, 1, 2, 4 }));
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 0, 7, 1, 2 }));
    EXPECT_EQ(recorded.state.key, 1u);
    recorded.state.key.reset();
    addKey(recorded.path(), recorded.state, at(8));
    EXPECT_EQ(timesOf(recorded.path()).back(), 6);
    EXPECT_TRUE(check(recorded.document));
}

TEST(PathModel, HalvingAGapEndsAtTheLeastOne) {
    Recorded recorded;
    for (int i = 0; i < 200; ++i) {
        recorded.state.key = 0;
        addKey(recorded.path(), recorded.state, at(1));
        ASSERT_TRUE(check(recorded.document)) << i;
    }
    const Reals times = timesOf(recorded.path());
    for (size_t i = 1; i < times.size(); ++i) EXPECT_GE(times[i] - times[i - 1], kLeastKeySeconds) << i;
    EXPECT_GT(times.size(), 8u) << "and not before";
}

TEST(PathModel, KeysAreRemovedMovedAndRetimed) {
    Recorded recorded;
    recorded.state.key = 2;
    moveKey(recorded.path(), recorded.state, 2, -1);
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 0, 2, 1 }));
    EXPECT_EQ(timesOf(recorded.path()), (Reals{ 0, 2, 4 })) << "cameras move, times stay";
    EXPECT_EQ(recorded.state.key, 1u) << "what is selected stays selected";
    moveKey(recorded.path(), recorded.state, 0, -1);
    moveKey(recorded.path(), recorded.state, 2, 1);
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 0, 2, 1 })) << "at the ends nothing happens";
    retimeKey(recorded.path(), 1, 3.5);
    EXPECT_EQ(timesOf(recorded.path()), (Reals{ 0, 3.5, 4 }));
    retimeKey(recorded.path(), 1, 100);
    EXPECT_EQ(recorded.path().keys[1].seconds, 4 - kLeastKeySeconds) << "no farther than the next one";
    retimeKey(recorded.path(), 1, -std::numeric_limits<double>::infinity());
    retimeKey(recorded.path(), 1, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(recorded.path().keys[1].seconds, 4 - kLeastKeySeconds);
    recorded.state.key = 2;
    removeKey(recorded.path(), recorded.state, 0);
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 2, 1 }));
    EXPECT_EQ(recorded.state.key, 1u);
    removeKey(recorded.path(), recorded.state, 1);
    EXPECT_FALSE(recorded.state.key.has_value());
    removeKey(recorded.path(), recorded.state, 5);
    EXPECT_EQ(recorded.path().keys.size(), 1u);
}

TEST(PathModel, TheSelectedKeyTakesAnotherView) {
    Recorded recorded;
    recorded.state.key = 1;
    replaceKey(recorded.path(), recorded.state, at(9));
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 0, 9, 2 }));
    recorded.state.key.reset();
    replaceKey(recorded.path(), recorded.state, at(5));
    EXPECT_EQ(placesOf(recorded.path()), (Reals{ 0, 9, 2 }));
}

TEST(PathModel, ScrubbingLooksThroughThePath) {
    Recorded recorded;
    scrubPath(recorded.document, recorded.state, 3);
    EXPECT_TRUE(isEqual(recorded.document.view.camera, sampled(recorded.path(), 3)));
    scrubPath(recorded.document, recorded.state, 99);
    EXPECT_EQ(recorded.state.seconds, 4);
    EXPECT_EQ(placeOf(recorded.document.view.camera), 2);
    selectKey(recorded.document, recorded.state, 1);
    EXPECT_EQ(recorded.state.seconds, 2);
    EXPECT_EQ(placeOf(recorded.document.view.camera), 1);
}

TEST(PathModel, PlayingEndsAtTheEndOrGoesRound) {
    Recorded recorded;
    EXPECT_FALSE(playPath(recorded.document, recorded.state, 1)) << "it does not play";
    togglePathPlaying(recorded.document, recorded.state);
    EXPECT_TRUE(playPath(recorded.document, recorded.state, 1.5));
    EXPECT_TRUE(isEqual(recorded.document.view.camera, sampled(recorded.path(), 1.5)));
    EXPECT_TRUE(playPath(recorded.document, recorded.state, 10));
    EXPECT_FALSE(recorded.state.isPlaying);
    EXPECT_EQ(placeOf(recorded.document.view.camera), 2);
    togglePathPlaying(recorded.document, recorded.state);
    EXPECT_EQ(recorded.state.seconds, 0) << "from the start";
    recorded.path().isClosed = true;
    recorded.path().closingSeconds = 1;
    EXPECT_TRUE(playPath(recorded.document, recorded.state, 5 * 3 + 1.25));
    EXPECT_TRUE(recorded.state.isPlaying);
    EXPECT_NEAR(recorded.state.seconds, 1.25, 1e-12);
}

TEST(PathModel, PathsAreAddedAndRemoved) {
    Document document;
    PathState state;
    addPath(document, state);
    addPath(document, state);
    EXPECT_EQ(document.paths[0].name, "path 1");
    EXPECT_EQ(document.paths[1].name, "path 2");
    EXPECT_EQ(state.path, 1u);
    removePath(document, state);
    EXPECT_EQ(shownPath(document, state).name, "path 1");
    state.path = 17; // another document was loaded
    state.seconds = 3;
    EXPECT_EQ(shownPath(document, state).name, "path 1");
    EXPECT_EQ(state.seconds, 0);
    removePath(document, state);
    removePath(document, state);
    EXPECT_TRUE(document.paths.empty());
    togglePathPlaying(document, state);
    EXPECT_FALSE(state.isPlaying) << "there is nothing to play";
    EXPECT_FALSE(playPath(document, state, 1));
    scrubPath(document, state, 1);
    selectKey(document, state, 0);
}

} // namespace
} // namespace filament_core::view
