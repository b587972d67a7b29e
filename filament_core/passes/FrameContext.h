// SPDX-License-Identifier: Apache-2.0
/// FrameContext: what every pass may read: the packet with the settings of the view, the engine's resources, and where
/// things are on the device.
///   Life    in the frame arena, together with the packet: passes keep a pointer to it until the graph is recorded.
///   A pass is one function: it declares itself into the graph, and says what to do before and inside of its backend
///   pass.
#pragma once

#include "filament_core/passes/FrameResources.h"
#include "filament_core/passes/PassBlocks.h"
#include "filament_core/prepare/DebugQuads.h"
#include "filament_core/prepare/FramePacket.h"
#include "framegraph/FrameGraph.h"

namespace filament_core::passes {

/// Of an image of the graph.
inline uint2 sizeOf(framegraph::FrameGraph const& graph, framegraph::TextureId texture) {
    framegraph::GraphTextureDesc const& desc = graph.texture(texture).desc;
    return { desc.width, desc.height };
}

/// A texture of the size of `like`.
inline framegraph::TextureId createLike(framegraph::FrameGraph& graph, framegraph::TextureId like,
                                        backend::Format format, uint8_t samples, std::string_view name) {
    const uint2 size = sizeOf(graph, like);
    return graph.createTexture(
            { .width = size.x, .height = size.y, .format = format, .samples = samples, .name = name });
}

/// Where quads are on the device (QuadBuffers.h); empty without any.
struct FrameQuads {
    backend::BufferHandle vertices, indices;
};

/// View::debugDraw.
struct FrameDebugDraw {
    prepare::DebugQuads quads;
    FrameQuads buffers{};
};

struct AppPass;

struct FrameContext {
    prepare::FramePacket packet{};
    FrameResources resources{};
    ShadingKey shading = 0; ///< of what is lit in the main view
    ShadingPrecision precision = ShadingPrecision::Full;
    bool keepsDepth = false; ///< a pass reads FrameTargets::sceneDepth
    Arena* arena = nullptr;
    PassBlocks* blocks = nullptr; ///< passes add theirs while they declare themselves

    FrameDebugDraw debugDraw{};
    std::span<const AppPass> appPasses{}; ///< View::postProcess; none in debug views
    bool followsLast = false;             ///< the last frame showed the same scene, in the same size
    FrameQuads splats{};                  ///< of FramePacket::splats

    // Where FrameData has put the packet on the device:
    std::span<const ViewGroup> views;                     ///< by view of the packet
    std::array<backend::BindGroupEntry, 3> viewBuffers{}; ///< FrameData::viewBuffers()
    std::span<const backend::CmdBindGroup> deformations;  ///< by DrawCall::deformation

    prepare::FrameSettings const& settings() const { return packet.settings; }
};

/// Where the scene's surfaces are drawn / an image is drawn over the whole target.
inline PassSlot slotOf(FrameContext const& context, backend::PassLayout const& layout, uint8_t subpass) {
    return { .layout = layout,
             .subpass = subpass,
             .shading = context.shading,
             .depthRange = context.settings().quality.depthRange,
             .precision = context.precision,
             .cutsSections = context.settings().cutsSections };
}
inline PassSlot fullScreenSlot(backend::PassLayout const& layout, uint8_t subpass) {
    return { .layout = layout, .subpass = subpass, .isFullScreen = true };
}

/// One view of a frame, for passes that draw its surfaces.
struct FrameView {
    prepare::ViewPacket const& packet;
    ViewGroup group;
};
/// In `execute` of a pass, when the packet is on the device.
inline FrameView viewOf(FrameContext const& context, size_t view) {
    FILAMENT_ASSERT(view < context.views.size(), "a view is on the device when passes draw it");
    return { context.packet.views[view], context.views[view] };
}

} // namespace filament_core::passes
