// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Egl.h"

#include <dlfcn.h>

#include <array>
#include <map>
#include <mutex>

namespace filament::backend::gles {
namespace {

constexpr const char* kInstall = "install libegl1, libegl-mesa0 and libgl1-mesa-dri";

struct Displays {
    std::mutex mutex;
    std::map<EGLDisplay, uint32_t> references;
};

Displays& displays() {
    static Displays instance;
    return instance;
}

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
#define X(name)                                                                          \
    name = reinterpret_cast<decltype(name)>(dlsym(library, "egl" #name));                \
    if (!name) return false;
    FILAMENT_EGL_FUNCTIONS(X)
#undef X
    const char* client = QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    mSurfaceless = hasExtension(client, "EGL_MESA_platform_surfaceless");
    mDevicePlatform = hasExtension(client, "EGL_EXT_platform_device");
    mGetPlatformDisplay =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(GetProcAddress("eglGetPlatformDisplayEXT"));
    if (hasExtension(client, "EGL_EXT_device_enumeration") || hasExtension(client, "EGL_EXT_device_base")) {
        mQueryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(GetProcAddress("eglQueryDevicesEXT"));
    }
    return mGetPlatformDisplay != nullptr;
}

Result<Egl const*> Egl::load() {
    static Egl library;
    static const bool opened = library.open(); // once per process, whichever thread comes first
    if (opened) return &library;
    return fail(
            ErrorCode::DeviceUnavailable, "OpenGL ES: libEGL.so.1 cannot be opened or is older than 1.5; {}", kInstall);
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

EGLDisplay Egl::display(DisplaySource source) const {
    return mGetPlatformDisplay(source.platform, source.native, nullptr);
}

Result<DisplayReference> DisplayReference::acquire(Egl const& egl, EGLDisplay display) {
    if (display == EGL_NO_DISPLAY) {
        return fail(ErrorCode::DeviceUnavailable, "EGL offers no such display; {}", kInstall);
    }
    const std::lock_guard lock(displays().mutex);
    uint32_t& references = displays().references[display];
    if (references == 0 && !egl.Initialize(display, nullptr, nullptr)) {
        displays().references.erase(display);
        return fail(ErrorCode::DeviceUnavailable, "EGL found no driver for its display (EGL error {:#x}); {}",
                egl.GetError(), kInstall);
    }
    ++references;
    return DisplayReference(egl, display);
}

DisplayReference::~DisplayReference() {
    if (mDisplay == EGL_NO_DISPLAY) return;
    const std::lock_guard lock(displays().mutex);
    auto const entry = displays().references.find(mDisplay);
    if (--entry->second > 0) return;
    displays().references.erase(entry);
    mEgl->Terminate(mDisplay);
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

} // namespace filament::backend::gles
