// SPDX-License-Identifier: Apache-2.0
/// Textures: storage and uploads.
///   Thread  the driver thread.
///   Memory  immutable storage; attachments are textures too (also multisampled ones), so that all can be sampled.
///   Fails   out of memory or an unsupported format is reported; the texture stays in the table with name 0, and
///           commands that use it are skipped.
#pragma once

#include "backend/api/Slots.h"
#include "backend/gles/Device.h"

namespace filament::backend::gles {

struct Texture {
    GLuint name = 0; ///< 0: creation failed
    GLenum target = GL_TEXTURE_2D;
    DeviceTextureDesc desc{}; ///< without the debug name, which lived in the command
    uint64_t bytes = 0;
};

/// Bytes of all levels, layers and samples.
uint64_t textureBytes(DeviceTextureDesc const& desc);

class Textures {
public:
    explicit Textures(Device& device) : mDevice(device) {}
    ~Textures();

    void create(TextureHandle handle, DeviceTextureDesc const& desc);
    std::unique_ptr<Texture> take(TextureHandle handle) { return mTextures.take(handle); }
    void destroy(Texture const& texture);
    void upload(CmdUploadTexture const& command);
    /// Null if it does not exist or could not be created.
    Texture const* find(TextureHandle handle) const;

private:
    void allocate(Texture const& texture);

    Device& mDevice;
    Slots<TextureHandle, Texture> mTextures;
};

} // namespace filament::backend::gles
