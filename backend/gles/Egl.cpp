// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Egl.h"

#include <dlfcn.h>

#include <array>

namespace filament_core::backend::gles {
namespace {

constexpr const char* kInstall = "install libegl1, libegl-mesa0 and libgl1-mesa-dri";

} // namespace

bool hasExtension(const char* list, std::string_view name) {
    std::string_view rest = list ? list : "";
    while (!rest.empty()) {
        const size_t end = rest.find(' ');
        if (rest.substr(0, end) == name) return true;
        if (end == std::string_view::npos) return false;
        rest.remove_prefix(end + 1);
    }
    return false;
}

bool Egl::open() {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) return false;
#define X(name)                                                                                                        \
    name = reinterpret_cast<decltype(name)>(dlsym(library, "egl" #name));                                              \
    if (!name) return false;
    FILAMENT_EGL_FUNCTIONS(X)
#undef X
    const char* client = QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    mSurfaceless = hasExtension(client, "EGL_MESA_platform_surfaceless");
    mDevicePlatform = hasExtension(client, "EGL_EXT_platform_device");
    mGetPlatformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(GetProcAddress("eglGetPlatformDisplayEXT"));
    if (hasExtension(client, "EGL_EXT_device_enumeration") || hasExtension(client, "EGL_EXT_device_base")) {
        mQueryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(GetProcAddress("eglQueryDevicesEXT"));
    }
    return mGetPlatformDisplay != nullptr;
}

Result<Egl const*> Egl::load() {
    static Egl library;
    static const bool opened = library.open(); // once per process, by the first thread
    if (opened) return &library;
    return fail(ErrorCode::DeviceUnavailable, "OpenGL ES: libEGL.so.1 cannot be opened or is older than 1.5; {}",
                kInstall);
}

std::vector<DisplaySource> Egl::displaySources() const {
    std::vector<DisplaySource> sources;
    if (mSurfaceless) sources.push_back({ EGL_PLATFORM_SURFACELESS_MESA, nullptr });
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (mDevicePlatform && mQueryDevices && mQueryDevices(devices.size(), devices.data(), &count)) {
        for (EGLint i = 0; i < count; ++i) sources.push_back({ EGL_PLATFORM_DEVICE_EXT, devices[i] });
    }
    return sources;
}

Result<DisplaySource> Egl::displaySource(NativeDisplay const& display) const {
    const bool isX11 = display.system == WindowSystem::X11;
    const char* client = QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!hasExtension(client, isX11 ? "EGL_EXT_platform_x11" : "EGL_EXT_platform_wayland")) {
        return fail(ErrorCode::Unsupported, "EGL does not know windows of {}; {}", toString(display.system), kInstall);
    }
    return DisplaySource{ static_cast<EGLenum>(isX11 ? EGL_PLATFORM_X11_EXT : EGL_PLATFORM_WAYLAND_EXT),
                          display.handle };
}

Result<EGLDisplay> Egl::findDisplay(DisplaySource source) const {
    const EGLDisplay display = mGetPlatformDisplay(source.platform, source.native, nullptr);
    if (display != EGL_NO_DISPLAY) return display;
    return fail(ErrorCode::DeviceUnavailable, "EGL offers no such display; {}", kInstall);
}

Result<void> Egl::initialize(EGLDisplay display) const {
    if (Initialize(display, nullptr, nullptr)) return {};
    return fail(ErrorCode::DeviceUnavailable, "EGL found no driver for its display (EGL error {:#x}); {}", GetError(),
                kInstall);
}

ThreadBindingGuard::ThreadBindingGuard(Egl const& egl)
        : mEgl(egl), mApi(egl.QueryAPI()), mDisplay(egl.GetCurrentDisplay()), mContext(egl.GetCurrentContext()),
          mDraw(egl.GetCurrentSurface(EGL_DRAW)), mRead(egl.GetCurrentSurface(EGL_READ)) {}

ThreadBindingGuard::~ThreadBindingGuard() {
    mEgl.BindAPI(mApi);
    if (mDisplay != EGL_NO_DISPLAY && mContext != mEgl.GetCurrentContext()) {
        mEgl.MakeCurrent(mDisplay, mDraw, mRead, mContext);
    }
}

} // namespace filament_core::backend::gles
