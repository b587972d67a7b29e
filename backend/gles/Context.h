// SPDX-License-Identifier: Apache-2.0
/// Context: one OpenGL ES context without a surface.
///   Thread  made, used and destroyed on one thread; several may live on the same thread (makeCurrent() switches).
///   Fails   create(): DeviceUnavailable (no driver) or Unsupported (older than ES 3.1).
///   After   the destructor leaves no context current and releases EGL's data for the thread.
#pragma once

#include "backend/gles/Egl.h"

#include <utility>

namespace filament::backend::gles {

class Context {
public:
    /// Creates a context on the display and makes it current. `debug` requests messages (KHR_debug).
    static Result<Context> create(Egl const& egl, DisplaySource source, bool debug);
    ~Context();
    Context(Context&& other) noexcept
            : mEgl(other.mEgl), mDisplay(other.mDisplay), mContext(std::exchange(other.mContext, EGL_NO_CONTEXT)) {}
    Context& operator=(Context&&) = delete;

    /// Free if it is already current on this thread.
    void makeCurrent() const;
    Egl const& egl() const { return *mEgl; }

private:
    Context(Egl const& egl, EGLDisplay display, EGLContext context)
            : mEgl(&egl), mDisplay(display), mContext(context) {}
    Egl const* mEgl;
    EGLDisplay mDisplay;
    EGLContext mContext;
};

} // namespace filament::backend::gles
