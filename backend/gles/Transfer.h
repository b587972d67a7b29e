// SPDX-License-Identifier: Apache-2.0
/// Copies between textures: blits and mip chains.
///   Both are framebuffer blits, the same fixed-function filter that vkCmdBlitImage runs, so that the bits agree;
///   glGenerateMipmap is free to filter as it likes.
///   Thread  the driver thread.
///   Fails   a format that cannot be rendered to is reported and skipped.
#pragma once

#include "backend/gles/Framebuffers.h"

namespace filament::backend::gles {

class Transfer {
public:
    Transfer(Device& device, Textures const& textures, Framebuffers& framebuffers)
            : mDevice(device), mTextures(textures), mFramebuffers(framebuffers) {}

    void blit(CmdBlit const& command);
    void generateMips(TextureHandle texture);

private:
    struct Image {
        Texture const& texture;
        uint32_t level, layer;
        Rect rect;
    };
    void copy(Image const& source, Image const& target, Filter filter);
    bool canCopy(Texture const& texture, const char* what);

    Device& mDevice;
    Textures const& mTextures;
    Framebuffers& mFramebuffers;
};

} // namespace filament::backend::gles
