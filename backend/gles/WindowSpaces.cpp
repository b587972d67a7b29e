// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/WindowSpaces.h"

namespace filament_core::backend::gles {

WindowChannels channelsOf(OutputSpace space) {
    if (space == OutputSpace::Rec2020Pq) return { .bits = 10 };
    if (space == OutputSpace::LinearRec709) return { .bits = 16, .isFloat = true };
    return {};
}

EGLint colorSpaceOf(OutputSpace space) {
    switch (space) {
    case OutputSpace::LinearRec709:
        return EGL_GL_COLORSPACE_SCRGB_LINEAR_EXT;
    case OutputSpace::DisplayP3:
        return EGL_GL_COLORSPACE_DISPLAY_P3_PASSTHROUGH_EXT;
    case OutputSpace::Rec2020Pq:
        return EGL_GL_COLORSPACE_BT2020_PQ_EXT;
    case OutputSpace::Srgb:
        break;
    }
    return EGL_NONE; // EGL's default does not convert
}

std::vector<OutputSpace> spacesOf(const char* extensions, bool hasTenBits, bool hasHalf) {
    std::vector<OutputSpace> spaces{ OutputSpace::Srgb };
    if (!hasExtension(extensions, "EGL_KHR_gl_colorspace")) return spaces;
    if (hasHalf && hasExtension(extensions, "EGL_EXT_gl_colorspace_scrgb_linear"))
        spaces.push_back(OutputSpace::LinearRec709);
    if (hasExtension(extensions, "EGL_EXT_gl_colorspace_display_p3_passthrough"))
        spaces.push_back(OutputSpace::DisplayP3);
    if (hasTenBits && hasExtension(extensions, "EGL_EXT_gl_colorspace_bt2020_pq"))
        spaces.push_back(OutputSpace::Rec2020Pq);
    return spaces;
}

} // namespace filament_core::backend::gles
