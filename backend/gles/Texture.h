// SPDX-License-Identifier: Apache-2.0
/// Textures: storage and uploads.
///   Thread  the driver thread.
///   Memory  immutable storage; attachments are textures as well (multisampled ones too), so that any can be sampled.
///           Parts are texture views, made once each: a level range set on the texture itself would show in every
///           group.
///   Fails   out of memory or a format that the device lacks is reported; the texture stays in the table with name 0,
///           and what uses it is skipped.
#pragma once

#include "backend/api/Slots.h"
#include "backend/gles/Device.h"

#include <vector>

namespace filament_core::backend::gles {

struct Texture {
    GLuint name = 0; ///< 0: creation failed
    GLenum target = GL_TEXTURE_2D;
    DeviceTextureDesc desc{}; ///< without the debug name, which lived in the command
    uint64_t bytes = 0;

    struct View {
        TextureRange range;
        GLuint name = 0;
    };
    std::vector<View> views{}; ///< one for each part that a bind group has shown
};

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
    /// The GL name under which shaders see this part of the texture, of the same target; 0 if there is none (reported
    /// under `what`).
    GLuint sampledName(TextureHandle handle, TextureRange const& range, std::string_view what);

private:
    void allocate(Texture const& texture);
    GLuint createView(Texture const& texture, TextureRange const& range, std::string_view what);

    Device& mDevice;
    Slots<TextureHandle, Texture> mTextures;
};

} // namespace filament_core::backend::gles
