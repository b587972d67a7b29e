// SPDX-License-Identifier: Apache-2.0
/// Textures and samplers: storage, uploads, sampling state.
///   Thread  the driver thread.
///   Memory  immutable storage; attachments are textures as well (multisampled ones too), so that any can be sampled.
///   Fails   out of memory or a format that the device lacks is reported; the texture stays in the table with name 0,
///           and what uses it is skipped.
#pragma once

#include "backend/gles/Device.h"
#include "backend/gles/Table.h"

namespace filament::backend::gles {

struct Texture {
    GLuint name = 0; ///< 0: creation failed
    GLenum target = GL_TEXTURE_2D;
    TextureDesc desc{}; ///< without the debug name, which lived in the command
    uint64_t bytes = 0;
};

/// Bytes of all levels, layers and samples.
uint64_t textureBytes(TextureDesc const& desc);

class Textures {
public:
    explicit Textures(Device& device) : mDevice(device) {}
    ~Textures();

    void create(TextureHandle handle, TextureDesc const& desc);
    std::unique_ptr<Texture> take(TextureHandle handle) { return mTextures.remove(handle); }
    void destroy(Texture const& texture);
    void upload(CmdUploadTexture const& command);
    /// Null if it does not exist or could not be made.
    Texture const* find(TextureHandle handle) const;

    void createSampler(SamplerHandle handle, SamplerDesc const& desc);
    void destroySampler(SamplerHandle handle);
    /// 0 if it does not exist.
    GLuint findSampler(SamplerHandle handle) const;

private:
    void allocate(Texture const& texture);

    Device& mDevice;
    Table<TextureTag, Texture> mTextures;
    Table<SamplerTag, GLuint> mSamplers;
};

} // namespace filament::backend::gles
