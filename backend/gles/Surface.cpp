// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Surface.h"

#include "backend/gles/WindowSpaces.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace filament_core::backend::gles {
namespace {

/// libwayland-egl, opened at run time: EGL takes its windows, not those of Wayland.
struct WaylandEgl {
    void* (*create)(void* surface, int width, int height) = nullptr;
    void (*resize)(void* window, int width, int height, int dx, int dy) = nullptr;
    void (*destroy)(void* window) = nullptr;

    WaylandEgl() {
        void* library = dlopen("libwayland-egl.so.1", RTLD_NOW | RTLD_LOCAL);
        if (!library) return;
        create = reinterpret_cast<decltype(create)>(dlsym(library, "wl_egl_window_create"));
        resize = reinterpret_cast<decltype(resize)>(dlsym(library, "wl_egl_window_resize"));
        destroy = reinterpret_cast<decltype(destroy)>(dlsym(library, "wl_egl_window_destroy"));
    }
    bool isComplete() const { return create && resize && destroy; }
};

WaylandEgl const& waylandEgl() {
    static const WaylandEgl library;
    return library;
}

/// EGL returns configs with more bits than requested, and those first.
bool hasBits(Egl const& egl, EGLDisplay display, EGLConfig config, EGLint wanted) {
    EGLint bits = 0;
    return egl.GetConfigAttrib(display, config, EGL_GREEN_SIZE, &bits) && bits == wanted;
}

/// Configurations with these channels for windows: opaque ones first.
std::vector<EGLConfig> windowConfigs(Egl const& egl, EGLDisplay display, WindowChannels channels) {
    const char* const extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (channels.isFloat && !hasExtension(extensions, "EGL_EXT_pixel_format_float")) return {};
    std::vector<EGLConfig> configs;
    for (EGLint alpha : { 0, channels.bits == 10 ? 2 : channels.bits }) {
        const std::array<EGLint, 19> wanted{ EGL_SURFACE_TYPE,
                                             EGL_WINDOW_BIT,
                                             EGL_RENDERABLE_TYPE,
                                             EGL_OPENGL_ES3_BIT,
                                             EGL_RED_SIZE,
                                             channels.bits,
                                             EGL_GREEN_SIZE,
                                             channels.bits,
                                             EGL_BLUE_SIZE,
                                             channels.bits,
                                             EGL_ALPHA_SIZE,
                                             alpha,
                                             EGL_SAMPLES,
                                             0,
                                             EGL_DEPTH_SIZE,
                                             0,
                                             channels.isFloat ? EGL_COLOR_COMPONENT_TYPE_EXT : EGL_NONE,
                                             EGL_COLOR_COMPONENT_TYPE_FLOAT_EXT,
                                             EGL_NONE };
        std::array<EGLConfig, 64> found{};
        EGLint count = 0;
        if (!egl.ChooseConfig(display, wanted.data(), found.data(), found.size(), &count)) continue;
        std::copy_if(found.begin(), found.begin() + count, std::back_inserter(configs),
                     [&](EGLConfig each) { return hasBits(egl, display, each, channels.bits); });
    }
    return configs;
}

} // namespace

Surface::Surface(Context const& context, SurfaceDesc const& desc)
        : mContext(context), mInterval(desc.presentMode == PresentMode::Fifo ? 1 : 0), mName(desc.debugName) {}

Result<std::unique_ptr<Surface>> Surface::create(Context const& context, NativeDisplay const& display,
                                                 SurfaceDesc const& desc) {
    std::unique_ptr<Surface> surface(new Surface(context, desc));
    if (Result<void> opened = surface->open(display, desc); !opened) return opened.error();
    return surface;
}

Result<void> Surface::open(NativeDisplay const& display, SurfaceDesc const& desc) {
    if (display.system == WindowSystem::None) {
        return fail(ErrorCode::Unsupported,
                    "window '{}': the engine was made without a display; set "
                    "EngineOptions::display",
                    mName);
    }
    auto window = static_cast<EGLNativeWindowType>(desc.window);
    if (display.system == WindowSystem::Wayland) {
        if (!waylandEgl().isComplete()) {
            return fail(ErrorCode::Unsupported,
                        "window '{}': libwayland-egl.so.1 cannot be opened; install "
                        "libwayland-egl1",
                        mName);
        }
        mWaylandWindow = waylandEgl().create(reinterpret_cast<void*>(desc.window), 1, 1); // follow() sets the size
        window = reinterpret_cast<EGLNativeWindowType>(mWaylandWindow);
    }
    Egl const& egl = mContext.egl();
    const std::vector<OutputSpace> offered = spaces(mContext);
    if (std::ranges::find(offered, desc.space) == offered.end()) {
        std::string names;
        for (const OutputSpace each : offered) names += (names.empty() ? "" : ", ") + std::string(toString(each));
        return fail(ErrorCode::Unsupported,
                    "window '{}' shows no {}; it has {}: set SwapChainDesc::outputSpace to one of those, which "
                    "Engine::outputSpaces() returns",
                    mName, toString(desc.space), names);
    }
    const EGLint space = colorSpaceOf(desc.space);
    const std::array<EGLint, 3> attributes{ space == EGL_NONE ? EGL_NONE : EGL_GL_COLORSPACE_KHR, space, EGL_NONE };
    for (EGLConfig config : windowConfigs(egl, mContext.display(), channelsOf(desc.space))) {
        mSurface = egl.CreateWindowSurface(mContext.display(), config, window,
                                           space == EGL_NONE ? nullptr : attributes.data());
        if (mSurface == EGL_NO_SURFACE) continue; // X11: a configuration whose visual is that of the window
        if (desc.space == OutputSpace::Rec2020Pq) describePeak(desc.peakNits);
        if (mWaylandWindow && mInterval > 0) {
            mFrames = FrameCallbacks::create(display.handle, reinterpret_cast<void*>(desc.window),
                                             findWindowGate(desc.gate));
        }
        if (mFrames) mInterval = 0;
        return {};
    }
    return fail(ErrorCode::Internal,
                "window '{}': EGL has no surface for it (EGL error {:#x}); is it a window of this "
                "display, and nobody else's to draw to?",
                mName, egl.GetError());
}

std::vector<OutputSpace> Surface::spaces(Context const& context) {
    Egl const& egl = context.egl();
    const EGLDisplay display = context.display();
    const auto has = [&](OutputSpace space) { return !windowConfigs(egl, display, channelsOf(space)).empty(); };
    return spacesOf(egl.QueryString(display, EGL_EXTENSIONS), has(OutputSpace::Rec2020Pq),
                    has(OutputSpace::LinearRec709));
}

/// SMPTE ST 2086 and CTA-861.3: primaries of Rec. 2020, D65, and the brightest pixel.
void Surface::describePeak(float peakNits) const {
    Egl const& egl = mContext.egl();
    const char* const extensions = egl.QueryString(mContext.display(), EGL_EXTENSIONS);
    const auto set = [&](EGLint attribute, float value) {
        egl.SurfaceAttrib(mContext.display(), mSurface, attribute,
                          static_cast<EGLint>(value * EGL_METADATA_SCALING_EXT + 0.5f));
    };
    if (hasExtension(extensions, "EGL_EXT_surface_SMPTE2086_metadata")) {
        set(EGL_SMPTE2086_DISPLAY_PRIMARY_RX_EXT, 0.708f), set(EGL_SMPTE2086_DISPLAY_PRIMARY_RY_EXT, 0.292f);
        set(EGL_SMPTE2086_DISPLAY_PRIMARY_GX_EXT, 0.170f), set(EGL_SMPTE2086_DISPLAY_PRIMARY_GY_EXT, 0.797f);
        set(EGL_SMPTE2086_DISPLAY_PRIMARY_BX_EXT, 0.131f), set(EGL_SMPTE2086_DISPLAY_PRIMARY_BY_EXT, 0.046f);
        set(EGL_SMPTE2086_WHITE_POINT_X_EXT, 0.3127f), set(EGL_SMPTE2086_WHITE_POINT_Y_EXT, 0.3290f);
        set(EGL_SMPTE2086_MAX_LUMINANCE_EXT, peakNits), set(EGL_SMPTE2086_MIN_LUMINANCE_EXT, 0);
    }
    if (hasExtension(extensions, "EGL_EXT_surface_CTA861_3_metadata"))
        set(EGL_CTA861_3_MAX_CONTENT_LIGHT_LEVEL_EXT, peakNits);
}

Surface::~Surface() {
    Egl const& egl = mContext.egl();
    mFrames.reset();
    if (mSurface != EGL_NO_SURFACE) {
        // A surface that is current would stay until the context lets go of it.
        mContext.makeCurrent(EGL_NO_SURFACE);
        egl.DestroySurface(mContext.display(), mSurface);
    }
    if (mWaylandWindow) waylandEgl().destroy(mWaylandWindow);
}

/// A window of Wayland is as large as its images; windows of X11 have a size of their own.
void Surface::follow(Texture const& texture) {
    if (!mWaylandWindow) return;
    waylandEgl().resize(mWaylandWindow, static_cast<int>(texture.desc.width), static_cast<int>(texture.desc.height), 0,
                        0);
}

void Surface::copy(Device& device, Framebuffers& framebuffers, Texture const& texture) {
    const auto imageWidth = static_cast<GLint>(texture.desc.width),
               imageHeight = static_cast<GLint>(texture.desc.height);
    EGLint width = imageWidth, height = imageHeight;
    if (!mWaylandWindow) { // else EGL tells the size of the last image, not of this one
        mContext.egl().QuerySurface(mContext.display(), mSurface, EGL_WIDTH, &width);
        mContext.egl().QuerySurface(mContext.display(), mSurface, EGL_HEIGHT, &height);
    }
    const GLint right = std::min(imageWidth, width), rows = std::min(imageHeight, height);
    device.state.bindFramebuffers(0, framebuffers.single(Framebuffers::Side::Read, texture, 0, 0));
    const GLenum back = GL_BACK;
    device.gl.DrawBuffers(1, &back); // none after a start without a surface
    device.state.setScissor({});
    if (imageWidth < width || imageHeight < height) {
        constexpr std::array<GLfloat, 4> kBlack{ 0, 0, 0, 1 };
        device.state.allowClears(1);
        device.gl.ClearBufferfv(GL_COLOR, 0, kBlack.data());
    }
    device.gl.BlitFramebuffer(0, 0, right, rows, 0, height, right, height - rows, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

bool Surface::present(Device& device, Framebuffers& framebuffers, Texture const& texture) {
    // Before anything is drawn: the back buffer takes its size with the first call.
    follow(texture);
    if (!mContext.makeCurrent(mSurface)) {
        if (mFrames) mFrames->allowAnother();
        reportOnce(device, "cannot be drawn to");
        return false;
    }
    Egl const& egl = mContext.egl();
    // The interval belongs to the surface that is current, so it can be set only now.
    if (!mHasInterval) mHasInterval = egl.SwapInterval(mContext.display(), mInterval) == EGL_TRUE;
    copy(device, framebuffers, texture);
    if (mFrames) mFrames->request();
    if (egl.SwapBuffers(mContext.display(), mSurface)) return true;
    if (mFrames) mFrames->allowAnother(); // nothing was committed
    reportOnce(device, "does not take the image");
    return false;
}

void Surface::reportOnce(Device& device, const char* what) {
    const EGLint error = mContext.egl().GetError();
    if (std::exchange(mIsReported, true)) return;
    device.error(DriverErrorKind::Other,
                 "window '{}' {} (EGL error {:#x}); was it closed before its swap chain was "
                 "destroyed?",
                 mName, what, error);
}

} // namespace filament_core::backend::gles
