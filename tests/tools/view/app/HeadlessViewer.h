// SPDX-License-Identifier: Apache-2.0
/// HeadlessViewer: a viewer of the showcase without a window, and hands for it.
#pragma once

#include "tests/tools/view/app/TestScene.h"
#include "tools/view/app/Viewer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

namespace filament_core::view {

inline constexpr int kEscape = 256; ///< of GLFW
inline constexpr uint2 kPictureSize{ 640, 360 };
inline constexpr uint2 kSmallPicture{ 192, 108 }; ///< less to shade, for tests that need no positions

struct Headless {
    std::unique_ptr<Viewer> viewer;

    explicit Headless(Backend backend, uint2 size = kPictureSize) : Headless(testOptions(backend), size) {}
    explicit Headless(ViewerOptions const& options, uint2 size = kPictureSize) {
        auto made = Viewer::create(options, showcaseDocument(size), { .pixels = size });
        if (!made) ADD_FAILURE() << made.error().message;
        if (made) viewer = std::move(*made);
    }
    void stepOrWait() {
        if (!viewer->step(0.01)) letOthersWork();
    }
    void settle(std::string const& when = "settle") {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        stepOrWait();
        while ((viewer->isLoading() || viewer->idleSeconds() < 0.1) && std::chrono::steady_clock::now() < end)
            stepOrWait();
        if (std::chrono::steady_clock::now() < end) return;
        ADD_FAILURE() << when << ": still busy after a minute; loading: " << viewer->stage().progress().what;
    }
    /// Steps until it is so, at most that long.
    template <class Condition>
    bool stepUntil(Condition&& isSo, std::chrono::seconds most = std::chrono::seconds(60)) {
        const auto end = std::chrono::steady_clock::now() + most;
        while (!isSo() && std::chrono::steady_clock::now() < end) stepOrWait();
        return isSo();
    }
    Image picture(std::string const& when = "picture") {
        settle(when);
        auto image = viewer->screenshot();
        EXPECT_TRUE(image.ok());
        return image ? std::move(*image) : Image{};
    }
    void press(int key, Modifiers modifiers = {}) {
        viewer->handle(KeyEvent{ key, true, modifiers });
        viewer->handle(KeyEvent{ key, false, {} });
    }
    /// From one pixel to another, with so many moves of the pointer. `seconds`: what passes after each, with a frame;
    /// 0: only the last one is drawn.
    void drag(float2 from, float2 to, int moves = 1, double seconds = 0) {
        viewer->handle(MouseMoveEvent{ from });
        viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
        for (int i = 1; i <= moves; ++i) {
            const float share = static_cast<float>(i) / static_cast<float>(moves);
            viewer->handle(MouseMoveEvent{ i == moves ? to : from + (to - from) * share });
            if (seconds > 0) viewer->step(seconds);
        }
        viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
        viewer->step(0.01);
    }
    void click(float2 pixel) {
        viewer->handle(MouseMoveEvent{ pixel });
        viewer->step(0.01);
        viewer->handle(MouseButtonEvent{ MouseButton::Left, true, {} });
        viewer->step(0.01);
        viewer->handle(MouseButtonEvent{ MouseButton::Left, false, {} });
        viewer->step(0.01);
    }
};

} // namespace filament_core::view
