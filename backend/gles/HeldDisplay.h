// SPDX-License-Identifier: Apache-2.0
/// HeldDisplay: an initialised EGL display, for as long as it is held.
///   Why     EGL finds a display by the address of the connection to the window system. When a connection is closed and
///           a new one gets its address, a display that was never terminated comes back with the dead connection.
///   Life    a display of a window system is terminated with its last holder, while its connection is still open
///           (EngineOptions::display). One that the app had initialised before us is the app's, and stays. Displays
///           without a window system stay until the process ends: terminating one ends every context on it, including
///           those of other code, and unloads Mesa's driver, which costs the next context 24 ms of 31 (Mesa 22.3.6).
///   Thread  any. Holders of one display may come and go on several threads at once.
///   Memory  an entry for each display of a window system that is held. The table is never destroyed, so that engines
///           of static storage duration may end at any time.
///   Fails   open(): DeviceUnavailable with the packages to install.
#pragma once

#include "backend/gles/Egl.h"

#include <utility>

namespace filament_core::backend::gles {

class HeldDisplay {
public:
    static Result<HeldDisplay> open(Egl const& egl, DisplaySource source);
    ~HeldDisplay();
    HeldDisplay(HeldDisplay&& other) noexcept
            : mEgl(other.mEgl), mDisplay(std::exchange(other.mDisplay, EGL_NO_DISPLAY)) {}
    HeldDisplay& operator=(HeldDisplay&&) = delete;

    EGLDisplay get() const { return mDisplay; }

private:
    HeldDisplay(Egl const& egl, EGLDisplay display) : mEgl(&egl), mDisplay(display) {}

    Egl const* mEgl;
    EGLDisplay mDisplay; ///< none: moved from
};

} // namespace filament_core::backend::gles
