// SPDX-License-Identifier: Apache-2.0
/// VirtualDisplay: an X server without a screen (Xvfb) for one test, and windows on it.
///   Out     Display* of Xlib, whose threads are initialised. pixels(): what a window shows, as RGB, top row first.
///   Life    the server ends with the object, and with this process.
///   Thread  one.
///   Fails   start(): nothing, and a test failure that says what to install.
#pragma once

#include "base/math/Math.h"

#include <gtest/gtest.h>

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using Display = struct _XDisplay;

namespace filament_core::test {

class VirtualDisplay {
public:
    static std::unique_ptr<VirtualDisplay> start(uint2 size = { 1920, 1200 });
    ~VirtualDisplay();
    VirtualDisplay(VirtualDisplay const&) = delete;
    VirtualDisplay& operator=(VirtualDisplay const&) = delete;

    Display* display() const { return mDisplay; }
    std::string const& name() const { return mName; } ///< ":7"

    /// Windows that overlap hide each other's pixels.
    unsigned long openWindow(uint2 size, int2 place = int2(0));
    void closeWindow(unsigned long window);
    void resize(unsigned long window, uint2 size);
    void hide(unsigned long window);
    void show(unsigned long window);
    /// Three bytes a pixel.
    std::vector<uint8_t> pixels(unsigned long window, uint2 size) const;

private:
    VirtualDisplay() = default;

    pid_t mServer = -1;
    Display* mDisplay = nullptr;
    std::string mName;
};

} // namespace filament_core::test
