// SPDX-License-Identifier: Apache-2.0
/// Bind groups, which OpenGL ES lacks: lists on the CPU, applied to numbered slots when a draw needs them.
///   Numbers depend on the program (flatBinding), so a group is applied lazily: when it was bound again, or when the
///   program's numbers for it differ from those it was applied with.
///   Thread  the driver thread.
///   Fails   a group with a buffer, texture or sampler that could not be created is unusable; draws with it are
///           skipped.
#pragma once

#include "backend/gles/Buffer.h"
#include "backend/gles/Program.h"
#include "backend/gles/Sampler.h"
#include "backend/gles/Texture.h"

namespace filament_core::backend::gles {

struct BindGroup {
    struct Slot {
        BindingType type = BindingType::UniformBuffer;
        GLuint object = 0; ///< buffer or texture
        GLenum target = 0; ///< textures
        GLuint sampler = 0;
        GLintptr offset = 0;
        GLsizeiptr size = 0;
    };
    std::vector<Slot> slots; ///< in the order of the layout
    bool isUsable = true;
};

BindGroup makeBindGroup(BindGroupDesc const& desc, Buffers const& buffers, Textures& textures,
                        Samplers const& samplers);

/// The groups bound in a pass.
class Descriptors {
public:
    explicit Descriptors(ContextState& state) : mState(state) {}

    /// Unbinds everything: at the start of a pass or subpass.
    void reset();
    void bind(uint32_t index, BindGroup const* group, std::array<uint32_t, kMaxDynamicOffsets> const& dynamicOffsets);
    void setProgram(Program const& program);
    /// Binds what the program reads to its slots. False if a group is unusable or missing.
    bool apply();

private:
    struct Bound {
        BindGroup const* group = nullptr;
        std::array<uint32_t, kMaxDynamicOffsets> dynamicOffsets{};
    };
    bool isNeeded(uint32_t index) const;
    void applyGroup(uint32_t index);

    ContextState& mState;
    std::array<Bound, kMaxBindGroups> mBound{};
    FlatBindings mBindings{};
    uint32_t mPending = 0; // bit i: group i is not in its slots
};

} // namespace filament_core::backend::gles
