// SPDX-License-Identifier: Apache-2.0
/// WindowStage: a viewer of the showcase in a window on an X server of its own, on the API of the test.
///   Hands    by xdotool, or as events.
///   Fails    without Xvfb a test failure that says what to install; tests return where isReady() is false.
#pragma once

#include "tests/tools/view/app/TestScene.h"
#include "tests/windows/VirtualDisplay.h"
#include "tools/view/app/Viewer.h"
#include "tools/view/app/Window.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::view {

class WindowStage : public testing::TestWithParam<Backend> {
protected:
    static constexpr uint2 kFirstSize{ 640, 400 };

    void SetUp() override {
        mServer = test::VirtualDisplay::start();
        if (!mServer) return;
        setenv("DISPLAY", mServer->name().c_str(), 1);
        auto window = Window::open("viewer test", kFirstSize);
        ASSERT_TRUE(window.ok()) << window.error().message;
        mWindow = std::move(*window);
        const ViewerTarget target{ mWindow->display(), mWindow->native(), mWindow->pixels(), mWindow->scale() };
        auto viewer = Viewer::create(testOptions(GetParam()), showcaseDocument(kFirstSize), target);
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
        const std::chrono::steady_clock::time_point end = std::chrono::steady_clock::now() + std::chrono::seconds(180);
        int quiet = 0;
        while (quiet < 3 && std::chrono::steady_clock::now() < end) {
            const std::vector<InputEvent> events = mWindow->takeEvents(0.01);
            for (InputEvent const& event : events) mViewer->handle(event);
            const bool drew = mViewer->step(0.01);
            quiet = events.empty() && !drew && !mViewer->isLoading() && mViewer->idleSeconds() > 0.1 ? quiet + 1 : 0;
        }
        EXPECT_EQ(quiet, 3) << "still busy after three minutes";
        mViewer->stage().engine().waitIdle();
    }
    void handle(InputEvent const& event) {
        mViewer->handle(event);
        settle();
    }
    unsigned long window() const { return static_cast<unsigned long>(mWindow->native().handle); }
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
        EXPECT_EQ(mServer->pixels(window(), size), colors) << when;
    }
    void expectNoMessages(std::string const& when) {
        for (std::string const& message : mViewer->takeMessages()) ADD_FAILURE() << when << ": " << message;
    }

    std::unique_ptr<test::VirtualDisplay> mServer;
    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Viewer> mViewer;
};

} // namespace filament_core::view
