// SPDX-License-Identifier: Apache-2.0
/// Egl: libEGL opened at run time, and where it finds displays.
///   Why     a machine without libEGL must still start and run another backend.
///   Thread  any; the library is opened once and stays open.
///   Fails   load(), findDisplay(), initialize(): DeviceUnavailable with the packages to install.
#pragma once

#include "base/Result.h"

#include <filament_core/NativeWindow.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string_view>
#include <vector>

namespace filament_core::backend::gles {

// Every EGL function the driver calls.
// clang-format off
#define FILAMENT_EGL_FUNCTIONS(X)                                                                              \
    X(BindAPI) X(ChooseConfig) X(CreateContext) X(CreateWindowSurface) X(DestroyContext) X(DestroySurface)       \
    X(GetConfigAttrib) X(GetCurrentContext) X(GetCurrentDisplay) X(GetCurrentSurface) X(GetError)                \
    X(GetProcAddress) X(Initialize) X(MakeCurrent) X(QueryAPI) X(QueryString) X(QuerySurface) X(ReleaseThread)  \
    X(SurfaceAttrib) X(SwapBuffers) X(SwapInterval) X(Terminate)
// clang-format on

/// One place to look for devices.
struct DisplaySource {
    EGLenum platform = EGL_PLATFORM_SURFACELESS_MESA;
    void* native = nullptr; ///< EGL_DEFAULT_DISPLAY, an EGLDeviceEXT, or the display of a window system
};

class Egl {
public:
    /// The library of this process.
    static Result<Egl const*> load();

    /// The surfaceless platform first, then the devices that EGL enumerates. Nothing here opens a window system.
    std::vector<DisplaySource> displaySources() const;
    /// The display of a window system that the app has opened. Unsupported: this EGL does not know that system.
    Result<DisplaySource> displaySource(NativeDisplay const& display) const;
    /// The display of the source, which may not be initialised; the same one every time. Hold it by a HeldDisplay.
    Result<EGLDisplay> findDisplay(DisplaySource source) const;
    /// No effect if it is initialised already: EGL does not count.
    Result<void> initialize(EGLDisplay display) const;

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

/// True if the space-separated list contains this whole extension name.
bool hasExtension(const char* list, std::string_view name);

/// Saves EGL's per-thread state (client API, current context) and restores it.
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

} // namespace filament_core::backend::gles
