// SPDX-License-Identifier: Apache-2.0
/// WindowSpaces: the colour spaces of windows of EGL, by its extensions and the configurations of its display.
///   Never   one that encodes: what is copied is encoded already. So P3 is its pass-through variant.
///   Thread  any; pure.   Fails: never.
#pragma once

#include "backend/gles/Egl.h"

#include <filament_core/OutputSpace.h>

#include <vector>

namespace filament_core::backend::gles {

/// What the configuration of a window must have.
struct WindowChannels {
    EGLint bits = 8; ///< of green
    bool isFloat = false;
};
WindowChannels channelsOf(OutputSpace space);

/// For EGL_GL_COLORSPACE_KHR; EGL_NONE: without the attribute.
EGLint colorSpaceOf(OutputSpace space);

/// `extensions`: of the display; `hasTenBits`, `hasHalf`: windows may have such configurations.
std::vector<OutputSpace> spacesOf(const char* extensions, bool hasTenBits, bool hasHalf);

} // namespace filament_core::backend::gles
