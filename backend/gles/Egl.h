// SPDX-License-Identifier: Apache-2.0
/// Egl: libEGL opened at run time, and the displays of the process.
///   Why     a machine without libEGL must still start and run another backend.
///   Thread  any; the library is opened once and stays open, its displays are counted under a lock.
///   Fails   load(): DeviceUnavailable with the package to install.
#pragma once

#include "filament_core/base/Result.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string_view>
#include <utility>
#include <vector>

namespace filament::backend::gles {

// Every EGL function the driver calls.
#define FILAMENT_EGL_FUNCTIONS(X)                                                                              \
    X(BindAPI) X(CreateContext) X(DestroyContext) X(GetCurrentContext) X(GetCurrentDisplay) X(GetCurrentSurface) \
    X(GetError) X(GetProcAddress) X(Initialize) X(MakeCurrent) X(QueryAPI) X(QueryString) X(ReleaseThread)     \
    X(Terminate)

/// One place to look for devices.
struct DisplaySource {
    EGLenum platform = EGL_PLATFORM_SURFACELESS_MESA;
    void* native = nullptr; ///< EGL_DEFAULT_DISPLAY, or an EGLDeviceEXT
};

class Egl {
public:
    /// The library of this process.
    static Result<Egl const*> load();

    /// The surfaceless platform first, then the devices that EGL enumerates. Nothing here opens a window system.
    std::vector<DisplaySource> displaySources() const;
    /// Not initialised yet; EGL_NO_DISPLAY if the platform refuses.
    EGLDisplay display(DisplaySource source) const;

#define X(name) decltype(&::egl##name) name = nullptr;
    FILAMENT_EGL_FUNCTIONS(X)
#undef X

private:
    bool open();
    PFNEGLGETPLATFORMDISPLAYEXTPROC mGetPlatformDisplay = nullptr;
    PFNEGLQUERYDEVICESEXTPROC mQueryDevices = nullptr; // null without EGL_EXT_device_enumeration
    bool mSurfaceless = false;
    bool mDevicePlatform = false;
};

/// True if the space-separated list names this extension, whole.
bool hasExtension(const char* list, std::string_view name);

/// An initialised display. EGL displays are shared by the whole process and terminating one ends every context on it,
/// so only the last reference of this process terminates it.
class DisplayReference {
public:
    static Result<DisplayReference> acquire(Egl const& egl, EGLDisplay display);
    ~DisplayReference();
    DisplayReference(DisplayReference&& other) noexcept
            : mEgl(other.mEgl), mDisplay(std::exchange(other.mDisplay, EGL_NO_DISPLAY)) {}
    DisplayReference& operator=(DisplayReference&&) = delete;

    EGLDisplay get() const { return mDisplay; }

private:
    DisplayReference(Egl const& egl, EGLDisplay display) : mEgl(&egl), mDisplay(display) {}
    Egl const* mEgl;
    EGLDisplay mDisplay;
};

/// Keeps what EGL remembers per thread (client API, current context) and puts it back.
class ThreadBindingGuard {
public:
    explicit ThreadBindingGuard(Egl const& egl);
    ~ThreadBindingGuard();
    ThreadBindingGuard(ThreadBindingGuard const&) = delete;
    ThreadBindingGuard& operator=(ThreadBindingGuard const&) = delete;

private:
    Egl const& mEgl;
    EGLenum mApi;
    EGLDisplay mDisplay;
    EGLContext mContext;
    EGLSurface mDraw, mRead;
};

} // namespace filament::backend::gles
