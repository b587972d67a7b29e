// SPDX-License-Identifier: Apache-2.0
/// Pass: load and store operations, resolves and subpasses around the draws.
///   A merged pass is one framebuffer with all colour attachments; its later subpasses read the earlier ones through
///   framebuffer fetch, so going to the next one costs nothing.
///   Thread  the driver thread.
///   Fails   a pass with an attachment that could not be created is skipped with its draws; the creation was reported.
#pragma once

#include "backend/gles/Framebuffers.h"
#include "backend/gles/FullScreenProgram.h"

namespace filament_core::backend::gles {

class Pass {
public:
    Pass(Device& device, Textures const& textures, Framebuffers& framebuffers);

    void begin(PassDesc const& desc);
    void nextSubpass();
    void end();

    bool isOpen() const { return mOpen; }
    bool isUsable() const { return mFramebuffer != 0; } ///< false outside of passes too
    PassLayout const& layout() const { return mDesc.layout; }
    SubpassDesc const& subpass() const { return mDesc.layout.subpasses[mSubpass]; }
    uint32_t subpassIndex() const { return mSubpass; }

private:
    struct Points {
        std::array<GLenum, kMaxColorAttachments + 1> at{};
        GLsizei count = 0;
        void add(GLenum point) { at[static_cast<size_t>(count++)] = point; }
    };

    bool collect(FramebufferKey& key);
    bool add(FramebufferKey& key, Attachment const& attachment, bool isDepth);
    GLenum depthPoint() const;
    void clear();
    void coverArea(); ///< by viewport and scissor
    void clearColor(uint32_t index);
    void clearDepth();
    void invalidate(Points const& points);
    Points discardedByLoad() const;
    Points discardedByStore() const;
    void resolve(uint32_t index);
    void resolveDepth();

    Device& mDevice;
    Textures const& mTextures;
    Framebuffers& mFramebuffers;
    FullScreenProgram mDepthResolve;
    PassDesc mDesc{};
    GLuint mFramebuffer = 0; // 0: skipped
    uint32_t mSubpass = 0;
    bool mCoversAll = false; // the area is all of every attachment
    bool mOpen = false;
};

} // namespace filament_core::backend::gles
