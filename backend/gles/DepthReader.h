// SPDX-License-Identifier: Apache-2.0
/// DepthReader: makes depth readable on devices without NV_read_depth.
///   The rectangle is blitted into a 2D depth texture of the same format (which also takes it out of arrays and cubes)
///   and drawn from there into an R32F texture, texel by texel; both copies are exact.
///   Thread  the driver thread, outside of passes; ContextState records the bindings that it leaves.
///   Memory  two textures per read-back, deleted when the next one begins.
#pragma once

#include "backend/gles/Framebuffers.h"
#include "backend/gles/FullScreenProgram.h"

namespace filament_core::backend::gles {

class DepthReader {
public:
    DepthReader(Device& device, Framebuffers& framebuffers);
    ~DepthReader() { dropTextures(); }

    /// A framebuffer whose colour image holds the rectangle at (0, 0) as R32F; 0 if it cannot be made (reported).
    GLuint copy(Texture const& texture, uint32_t level, uint32_t layer, Rect const& rect);

private:
    Texture makeTexture(Format format, Rect const& rect);
    void blit(Texture const& source, uint32_t level, uint32_t layer, Rect const& rect);
    void dropTextures();

    Device& mDevice;
    Framebuffers& mFramebuffers;
    FullScreenProgram mProgram;
    Texture mDepth, mFloat;
};

} // namespace filament_core::backend::gles
