// SPDX-License-Identifier: Apache-2.0
// The viewer in a real window on Xvfb: hands by xdotool, images read back from the X server.
#include "tools/view/app/Window.h"
#include "tests/tools/view/app/WindowStage.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

namespace filament_core::view {
namespace {

class WindowTest : public WindowStage {};

INSTANTIATE_TEST_SUITE_P(Apis, WindowTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(WindowTest, HandsOfXdotoolReachTheViewer) {
    if (!isReady()) return;
    expectShown("at the start");
    const double4x4 before = mViewer->document().view.camera.worldFromView;
    hands("key Tab"); // no panels
    EXPECT_FALSE(mViewer->panels().state.showsPanels);
    hands("mousemove 300 200 mousedown 1 mousemove 340 220 mouseup 1");
    EXPECT_NE(mViewer->document().view.camera.worldFromView, before);
    expectShown("after a drag");
    hands("mousemove 320 220 click 1");
    EXPECT_TRUE(mViewer->panels().state.selectedNode.has_value());
    expectShown("after a click");
    hands("mousemove 320 220 click 4 click 4"); // the wheel
    hands("key Home");
    EXPECT_EQ(mViewer->document().view.camera.worldFromView, before);
    hands("key F1");
    EXPECT_TRUE(mViewer->panels().state.showsShortcuts);
    expectShown("with the list of keys");
    expectNoMessages("hands");
    EXPECT_GT(mViewer->latency().count, 0u);
}

TEST_P(WindowTest, BackendsChangeInOneWindow) {
    if (!isReady()) return;
    for (int i = 0; i < 4; ++i) {
        hands("key b");
        expectShown(fmt::format("change {}", i));
        expectNoMessages(fmt::format("change {}", i));
    }
}

TEST(Window, WithoutADisplaySaysWhatToDo) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const auto window = Window::open("none", { 10, 10 });
    ASSERT_FALSE(window.ok());
    EXPECT_THAT(window.error().message, testing::HasSubstr("set DISPLAY"));
    EXPECT_EQ(window.error().message.find('\n'), std::string::npos);
}

} // namespace
} // namespace filament_core::view
