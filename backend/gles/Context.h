// SPDX-License-Identifier: Apache-2.0
/// Context: one OpenGL ES context. It has a surface only while something is presented.
///   Thread  made, used and destroyed on one thread; several may live on the same thread (makeCurrent() switches).
///   Fails   create(): DeviceUnavailable (no driver) or Unsupported (older than ES 3.1).
///   After   the destructor leaves no context current and releases EGL's data for the thread.
#pragma once

#include "backend/gles/HeldDisplay.h"

#include <utility>

namespace filament_core::backend::gles {

class Context {
public:
    /// Creates a context on the display and makes it current. `debug` requests messages (KHR_debug).
    static Result<Context> create(Egl const& egl, DisplaySource source, bool debug);
    ~Context();
    Context(Context&& other) noexcept
            : mEgl(other.mEgl), mDisplay(std::move(other.mDisplay)),
              mContext(std::exchange(other.mContext, EGL_NO_CONTEXT)) {}
    Context& operator=(Context&&) = delete;

    /// Free if it is already current on this thread, with or without a surface.
    void makeCurrent() const;
    /// Makes it current with this surface as the framebuffer 0; EGL_NO_SURFACE: none. False: EGL refuses.
    bool makeCurrent(EGLSurface surface) const;
    Egl const& egl() const { return *mEgl; }
    EGLDisplay display() const { return mDisplay.get(); }

private:
    Context(Egl const& egl, HeldDisplay display, EGLContext context)
            : mEgl(&egl), mDisplay(std::move(display)), mContext(context) {}
    Egl const* mEgl;
    HeldDisplay mDisplay;
    EGLContext mContext;
};

} // namespace filament_core::backend::gles
