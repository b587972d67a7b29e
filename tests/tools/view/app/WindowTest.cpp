// SPDX-License-Identifier: Apache-2.0
// The viewer in a real window on Xvfb: hands by xdotool, pictures read back from the X server.
#include "tools/view/app/Window.h"
#include "tests/tools/view/app/TestScene.h"
#include "tests/windows/VirtualDisplay.h"
#include "tools/view/app/Viewer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>

namespace filament::view {
namespace {

using Clock = std::chrono::steady_clock;
constexpr uint2 kWindowSize{ 640, 400 };

class WindowTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mServer = test::VirtualDisplay::start();
        if (!mServer) return;
        setenv("DISPLAY", mServer->name().c_str(), 1);
        auto window = Window::open("viewer test", kWindowSize);
        ASSERT_TRUE(window.ok()) << window.error().message;
        mWindow = std::move(*window);
        const ViewerTarget target{ mWindow->display(), mWindow->native(), mWindow->pixels(), mWindow->scale() };
        auto viewer = Viewer::create(testOptions(GetParam()), showcaseDocument(kWindowSize), target);
        ASSERT_TRUE(viewer.ok()) << viewer.error().message;
        mViewer = std::move(*viewer);
        settle();
    }
    void TearDown() override {
        mViewer.reset();
        mWindow.reset();
    }
    bool isReady() const { return mServer && mWindow && mViewer; }

    /// Runs the loop until nothing changes any more.
    void settle() {
        const Clock::time_point end = Clock::now() + std::chrono::seconds(180);
        int quiet = 0;
        while (quiet < 3 && Clock::now() < end) {
            const std::vector<InputEvent> events = mWindow->takeEvents(0.01);
            for (InputEvent const& event : events) mViewer->handle(event);
            const bool drew = mViewer->step(0.01);
            quiet = events.empty() && !drew && !mViewer->isLoading() && mViewer->idleSeconds() > 0.1 ? quiet + 1 : 0;
        }
        mViewer->stage().engine().waitIdle();
    }
    void hands(std::string const& words) {
        ASSERT_EQ(std::system(fmt::format("xdotool {} >/dev/null 2>&1", words).c_str()), 0) << words;
        settle();
    }
    /// The window shows what the viewer has drawn, texel by texel.
    void expectShown(std::string const& when) {
        Result<Image> drawn = mViewer->screenshot();
        ASSERT_TRUE(drawn.ok()) << when;
        std::vector<uint8_t> colors;
        for (size_t i = 0; i + 3 < drawn->pixels.size(); i += 4)
            for (size_t c = 0; c < 3; ++c) colors.push_back(static_cast<uint8_t>(drawn->pixels[i + c]));
        const uint2 size(drawn->width, drawn->height);
        EXPECT_EQ(size, mWindow->pixels()) << when;
        EXPECT_EQ(mServer->pixels(static_cast<unsigned long>(mWindow->native().handle), size), colors) << when;
    }
    void expectNoMessages(std::string const& when) {
        for (std::string const& message : mViewer->takeMessages()) ADD_FAILURE() << when << ": " << message;
    }

    std::unique_ptr<test::VirtualDisplay> mServer;
    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Viewer> mViewer;
};

INSTANTIATE_TEST_SUITE_P(Apis, WindowTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& info) { return std::string(toString(info.param)); });

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
} // namespace filament::view
