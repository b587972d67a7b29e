// SPDX-License-Identifier: Apache-2.0
/// FrameTarget: the textures that a frame draws to, of a swap chain or of a render target.
///   Thread  the app thread.   Memory: none.   Life: that of the objects that it refers to.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/passes/Frame.h"
#include "filament_core/prepare/FramePacket.h"

#include <filament_core/MeshPass.h>

#include <array>

namespace filament_core::engine {

struct FrameTarget {
    TextureState& color;
    TextureState* depth = nullptr;      ///< none: unused
    RenderTargetState* state = nullptr; ///< none: an image of a swap chain
    bool isAlone = false;               ///< drawn to by a pass of the app, without a view
    MeshPass const* meshes = nullptr;   ///< of isAlone: a pass over a scene; none: without one

    uint8_t level() const { return state ? state->level : uint8_t{ 0 }; }
    uint16_t layer() const { return state ? state->layer : uint16_t{ 0 }; }
    uint2 size() const;
    /// Whether other layers and levels of the texture keep what they hold.
    bool isPart() const { return color.desc.type != TextureKind::Texture2D || level() > 0; }
    size_t colors() const { return isAlone ? 1 + state->others.size() : 1; }
    bool generatesMips() const { return state && state->generateMips; }
    bool isSrgb() const { return backend::formatInfo(color.desc.format).isSrgb; }
    /// Something was drawn to it, or to the depth.
    void keepContents(Engine::Impl& engine) const;
};

inline constexpr size_t kMostOthers = 3; ///< RenderTargetDesc::others

FrameTarget targetOf(Engine::Impl& engine, RenderTarget target);

passes::FrameOutput outputOf(FrameTarget const& target);
/// Of RenderTargetDesc::others.
std::array<passes::FrameOutput, kMostOthers> otherOutputsOf(Engine::Impl& engine, FrameTarget const& target);
/// All that is drawn to.
std::array<backend::TextureHandle, kMostOthers + 2> texturesOf(Engine::Impl& engine, FrameTarget const& target);

/// The material that samples the frame's own target; null: none does.
scene::MaterialInstance const* samplerOf(prepare::FramePacket const& packet, FrameTarget const& target);

/// Why such a frame is left out.
Error samplesTarget(scene::MaterialInstance const& material, FrameTarget const& target);
Error dirtIsTarget(FrameTarget const& target);

} // namespace filament_core::engine
