// SPDX-License-Identifier: Apache-2.0
/// describeFrame: the passes of a frame and their order, one line per pass. The table of contents of this room.
///   In      the packet and the engine's resources, as a FrameContext; where the image goes.
///   Out     declarations in the graph. No GPU work: framegraph::record() draws them, framegraph::rehearse() only asks
///           them what they need.
///   Thread  the app thread.   Memory: the arena of the graph, and of the context.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// One layer of a level of a larger texture, whose others keep what they hold.
struct OutputPart {
    bool isOne = false;
    backend::TextureKind kind = backend::TextureKind::Texture2D;
    uint32_t width = 1, height = 1; ///< of level 0 of the texture
    uint8_t level = 0, levels = 1;
    uint16_t layer = 0, layers = 1;
};

/// The destination of the image: a texture of the engine, one sample per pixel. `format`: its attachmentFormat().
struct FrameOutput {
    backend::TextureHandle texture;
    uint32_t width = 1, height = 1;
    backend::Format format = backend::Format::RGBA8;
    uint8_t srgbLevels = 1;   ///< of sRGB codes, whose levels 1.. the frame draws, too
    bool hasContents = false; ///< it was drawn to before
    OutputPart part{};
    backend::TextureHandle depth{}; ///< RenderTargetDesc::depth, of the same size; none: unused
    bool hasDepths = false;         ///< `depth` was drawn to before

    /// Takes light as it is, without a tone mapper.
    bool isSceneLinear() const { return format == backend::Format::RGBA16F || format == backend::Format::RGBA32F; }
};

/// In the arena: passes keep a pointer to it. Results of uploads (FrameContext::views and the members after it) are set
/// later, before the graph is recorded.
FrameContext* makeFrameContext(Arena& arena, prepare::FramePacket const& packet, FrameResources const& resources);

/// A pass of the app alone: FrameContext::appPasses has one, which reads nothing of a frame.
/// `others`: the attachments 1, 2, ...
void describeAppPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                     std::span<const FrameOutput> others);

FrameTargets describeFrame(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output);

} // namespace filament_core::passes
