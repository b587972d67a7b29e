// SPDX-License-Identifier: Apache-2.0
/// Quirks: differences between implementations; the only code that reads extension strings.
///   A false bit has a workaround, named here. Remove a bit when every supported device has it.
#pragma once

#include "backend/api/Driver.h"
#include "backend/gles/Api.h"
#include "base/Result.h"

namespace filament_core::backend::gles {

struct Quirks {
    bool baseVertex = false;       ///< ES 3.2; else vertex buffers are bound at an offset (Vertices.cpp)
    bool baseInstance = false;     ///< implies baseVertex; else per-instance buffers are bound at an offset
    bool readDepth = false;        ///< NV_read_depth; else depth is drawn into an R32F texture first (Readback.cpp)
    bool indexedBlend = false;     ///< ES 3.2; else every attachment blends and masks like the first
    bool framebufferFetch = false; ///< needed for merged passes
    bool textureViews = false;     ///< else a bind group shows whole textures only
    bool timers = false;           ///< else a timer answers 0
    bool blockCompression = false; ///< BC1..BC7 complete, or not offered
    bool exactSrgbBlocks = false;  ///< else BC7Srgb has other bits than its texels: see vulkan::Quirks
    bool srgbWriteControl = false; ///< else textures of sRGB are no attachments
    bool cubeArrays = false;
    bool primitiveIds = false;  ///< gl_PrimitiveID in fragment shaders
    bool depthClamp = false;    ///< else geometry in front of the near plane is clipped
    bool anisotropy = false;    ///< else samplers are isotropic
    bool debugMessages = false; ///< KHR_debug or ES 3.2
    bool resetStatus = false;   ///< else a lost context shows as GL_CONTEXT_LOST from glGetError only

    /// Queries the current context. Unsupported names what this driver is missing.
    static Result<Quirks> probe(Api const& gl);
};

/// The properties of the current context.
DeviceInfo describeDevice(Api const& gl, Quirks const& quirks);

} // namespace filament_core::backend::gles
