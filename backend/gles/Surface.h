// SPDX-License-Identifier: Apache-2.0
/// Surface: a window that images are copied to.
///   Rows    the only place that flips an image: row 0 is the top row of a texture, but the bottom row of a
///           window.
///   Thread  the driver thread, context current.
///   Waits   with Fifo as EGL does (X11); on Wayland the app thread waits, for FrameCallbacks.
///   Needs   a context on the display of the window (DriverOptions::display).
///   Fails   create(): Unsupported or Internal, with the window and the error of EGL. present() returns what it did; a
///           window that is gone is reported once.
#pragma once

#include "backend/api/FrameCallbacks.h"
#include "backend/gles/Device.h"
#include "backend/gles/Framebuffers.h"

#include <memory>
#include <string>
#include <vector>

namespace filament_core::backend::gles {

class Surface {
public:
    static Result<std::unique_ptr<Surface>> create(Context const& context, NativeDisplay const& display,
                                                   SurfaceDesc const& desc);
    ~Surface();
    Surface(Surface const&) = delete;
    Surface& operator=(Surface const&) = delete;

    /// What windows of the display can have.
    static std::vector<OutputSpace> spaces(Context const& context);

    /// Copies the texture into the window, and shows it. False: the window did not take it.
    bool present(Device& device, Framebuffers& framebuffers, Texture const& texture);

private:
    Surface(Context const& context, SurfaceDesc const& desc);
    Result<void> open(NativeDisplay const& display, SurfaceDesc const& desc);
    void describePeak(float peakNits) const;
    void follow(Texture const& texture);
    void copy(Device& device, Framebuffers& framebuffers, Texture const& texture);
    void reportOnce(Device& device, const char* what);

    Context const& mContext;
    EGLSurface mSurface = EGL_NO_SURFACE;
    void* mWaylandWindow = nullptr; ///< wl_egl_window*, which has the size of what is presented
    EGLint mInterval;               ///< refreshes of the display between two images
    bool mHasInterval = false;
    std::unique_ptr<FrameCallbacks> mFrames; ///< instead of an interval
    bool mIsReported = false;
    std::string mName;
};

} // namespace filament_core::backend::gles
