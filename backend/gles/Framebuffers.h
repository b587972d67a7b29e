// SPDX-License-Identifier: Apache-2.0
/// Framebuffers: the framebuffer objects of this context, created once per set of attachments.
///   Thread  the driver thread.
///   Memory  one GL object per set of attachments ever used, dropped when the first of its textures is destroyed.
///   Fails   get() reports a set that the driver refuses, once, and returns 0 for it from then on.
#pragma once

#include "backend/gles/Texture.h"

#include <unordered_map>

namespace filament_core::backend::gles {

/// One image of a texture. All keys here have no padding, so that their bytes can be hashed.
struct ImageKey {
    GLuint texture = 0;
    GLenum target = 0;
    uint16_t layer = 0;
    uint16_t level = 0;
    friend bool operator==(ImageKey const&, ImageKey const&) = default;
};

/// The attachments. Images of textures that could not be created must not be passed.
struct FramebufferKey {
    std::array<ImageKey, kMaxColorAttachments> colors{};
    ImageKey depth{};
    GLenum depthPoint = 0; ///< GL_DEPTH_ATTACHMENT or GL_DEPTH_STENCIL_ATTACHMENT, 0 without depth
    uint32_t colorCount = 0;
    friend bool operator==(FramebufferKey const&, FramebufferKey const&) = default;

    void addColor(Texture const& texture, uint32_t level, uint32_t layer);
    void setDepth(Texture const& texture, uint32_t level, uint32_t layer);
};

class Framebuffers {
public:
    explicit Framebuffers(Device& device) : mDevice(device) {}
    ~Framebuffers();

    /// The object's name; 0 if the driver refuses (reported under `what`). May change the bound framebuffers.
    GLuint get(FramebufferKey const& wanted, std::string_view what);
    /// A colour or depth image alone, to copy from or to. Two objects per kind, attached again for every image, because
    /// an image is seldom copied twice. Valid until the next call for the same side. May change the bound framebuffers.
    enum class Side : uint8_t { Read, Draw };
    GLuint single(Side side, Texture const& texture, uint32_t level, uint32_t layer);
    /// Drops every framebuffer that contains this texture.
    void forget(GLuint texture);

private:
    struct Hash {
        size_t operator()(FramebufferKey const& key) const;
    };
    struct Single {
        GLuint object = 0;
        ImageKey image{};
    };
    GLuint create(FramebufferKey const& wanted, std::string_view what);
    void attach(GLenum point, ImageKey const& image);
    void destroy(GLuint object);

    Device& mDevice;
    std::unordered_map<FramebufferKey, GLuint, Hash> mObjects;
    std::array<Single, 4> mSingles{}; // by side and by colour or depth
};

} // namespace filament_core::backend::gles
