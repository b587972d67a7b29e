// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Context.h"

namespace filament_core::backend::gles {
namespace {

struct ContextRequest {
    EGLint minor;     // of ES 3.x
    bool resetNotice; // tells a lost device from a defective one; not every driver has it
};

EGLContext createContext(Egl const& egl, EGLDisplay display, ContextRequest request, bool debug) {
    std::vector<EGLint> attributes{ EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, request.minor };
    if (request.resetNotice) {
        attributes.insert(attributes.end(),
                          { EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT, EGL_LOSE_CONTEXT_ON_RESET_EXT });
    }
    if (debug) attributes.insert(attributes.end(), { EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE });
    attributes.push_back(EGL_NONE);
    return egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

} // namespace

Result<Context> Context::create(Egl const& egl, DisplaySource source, bool debug) {
    Result<HeldDisplay> opened = HeldDisplay::open(egl, source);
    if (!opened) return opened.error();
    const EGLDisplay display = opened->get();
    const char* extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (!hasExtension(extensions, "EGL_KHR_surfaceless_context") || !egl.BindAPI(EGL_OPENGL_ES_API)) {
        return fail(ErrorCode::Unsupported, "this EGL display has no OpenGL ES without a surface");
    }
    const bool reset = hasExtension(extensions, "EGL_EXT_create_context_robustness");
    EGLContext context = EGL_NO_CONTEXT;
    // The newest version first, and each with the notice of a reset before the one without.
    for (ContextRequest request : { ContextRequest{ 2, true }, { 2, false }, { 1, true }, { 1, false } }) {
        if (context == EGL_NO_CONTEXT && (reset || !request.resetNotice)) {
            context = createContext(egl, display, request, debug);
        }
    }
    if (context == EGL_NO_CONTEXT) {
        return fail(ErrorCode::Unsupported, "this EGL display offers no OpenGL ES 3.1 context (EGL error {:#x})",
                    egl.GetError());
    }
    Context made(egl, std::move(*opened), context);
    if (!egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return fail(ErrorCode::DeviceUnavailable, "the OpenGL ES context cannot be made current (EGL error {:#x})",
                    egl.GetError());
    }
    return made;
}

Context::~Context() {
    if (mContext == EGL_NO_CONTEXT) return;
    // A context that is current would only be marked for destruction.
    mEgl->MakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    mEgl->DestroyContext(display(), mContext);
    mEgl->ReleaseThread();
}

void Context::makeCurrent() const {
    if (mEgl->GetCurrentContext() == mContext) return;
    mEgl->BindAPI(EGL_OPENGL_ES_API);
    mEgl->MakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, mContext);
}

bool Context::makeCurrent(EGLSurface surface) const {
    if (mEgl->GetCurrentContext() == mContext && mEgl->GetCurrentSurface(EGL_DRAW) == surface) return true;
    mEgl->BindAPI(EGL_OPENGL_ES_API);
    return mEgl->MakeCurrent(display(), surface, surface, mContext) == EGL_TRUE;
}

} // namespace filament_core::backend::gles
