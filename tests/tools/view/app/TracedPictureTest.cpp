// SPDX-License-Identifier: Apache-2.0
// What the viewer says that the path tracer does not see.
#include "tools/view/app/TracedPicture.h"

#include <gmock/gmock.h>

#include <functional>

namespace filament_core::view {
namespace {

using testing::HasSubstr;

std::string untracedAfter(std::function<void(Document&)> const& edit) {
    Document document;
    edit(document);
    return untracedParts(document);
}

TEST(TracedPicture, NamesWhatThePathTracerDoesNotSee) {
    EXPECT_EQ(untracedParts({}), "");
    EXPECT_THAT(untracedAfter([](Document& d) { d.nodes.push_back({}); }), HasSubstr("edits of nodes"));
    EXPECT_THAT(untracedAfter([](Document& d) { d.view.effects.bloom.enabled = true; }), HasSubstr("bloom"));
    EXPECT_THAT(untracedAfter([](Document& d) { d.view.effects.colorGrading.enabled = true; }), HasSubstr("effects"));
    EXPECT_THAT(untracedAfter([](Document& d) { d.look = "warm.cube"; }), HasSubstr("the look"));
    EXPECT_THAT(untracedAfter([](Document& d) { d.model.options.allLevels = true; }), HasSubstr("levels of detail"));
    EXPECT_THAT(untracedAfter([](Document& d) { d.lights.push_back({ .profileFile = "lamp.ies" }); }),
                HasSubstr("profiles of lights"));
}

TEST(TracedPicture, SaysNothingOfWhatIsTracedOrOff) {
    EXPECT_EQ(untracedAfter([](Document& d) { d.view.effects.fog.enabled = true; }), "");
    EXPECT_EQ(untracedAfter([](Document& d) { d.lights.push_back({ .light = SunLight{} }); }), "");
    EXPECT_EQ(untracedAfter([](Document& d) { d.lights.push_back({ .isOn = false, .profileFile = "lamp.ies" }); }), "");
}

} // namespace
} // namespace filament_core::view
