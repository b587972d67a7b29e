// SPDX-License-Identifier: Apache-2.0
/// VirtualCompositor: a Wayland compositor without a screen (Weston) for one test, and one window that fills its
/// output.
///   Out     wl_display*, wl_surface*; picture(): the output, as its own tool photographs it.
///   Life    the compositor ends with the object, and with this process.
///   Thread  one.
///   Fails   start(): nothing, and a test failure that says what to install.
#pragma once

#include "base/math/Math.h"

#include <filament_core/Image.h>

#include <gtest/gtest.h>

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

struct wl_display;
struct wl_surface;

namespace filament_core::test {

class VirtualCompositor {
public:
    static std::unique_ptr<VirtualCompositor> start(uint2 size);
    ~VirtualCompositor();
    VirtualCompositor(VirtualCompositor const&) = delete;
    VirtualCompositor& operator=(VirtualCompositor const&) = delete;

    wl_display* display() const { return mDisplay; }
    wl_surface* surface() const;
    /// That no window shows: it has no role, and the compositor never wants an image of it.
    wl_surface* hiddenSurface();
    /// Answers the compositor's questions until nothing is on its way: after something was presented, say.
    void settle();
    std::optional<Image> picture() const;

    struct Window; ///< the objects of the protocol

private:
    VirtualCompositor() = default;
    bool startServer(uint2 size);
    bool connect();

    std::filesystem::path mFolder; ///< of the socket and of images
    pid_t mServer = -1;
    wl_display* mDisplay = nullptr;
    std::unique_ptr<Window> mWindow;
};

} // namespace filament_core::test
