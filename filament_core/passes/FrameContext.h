// SPDX-License-Identifier: Apache-2.0
/// FrameContext: what every pass may read: the packet, the settings of the view, and where things are on the device.
///   Life    in the frame arena, together with the packet: passes keep a pointer to it until the graph is recorded.
///   A pass is one function: it declares itself into the graph, and says what to do before and inside of its backend
///   pass.
#pragma once

#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/Pipelines.h"
#include "filament_core/prepare/FramePacket.h"
#include "framegraph/FrameGraph.h"

namespace filament::passes {

struct PassSettings {
    uint2 size{ 1, 1 };
    uint8_t samples = 1;
    float4 clearColor{ 0, 0, 0, 1 };
    ShadingKey shading = 0;
    DepthRange depthRange = DepthRange::Reversed;
    ShadingPrecision precision = ShadingPrecision::Full;
};

/// Where the scene's surfaces are drawn / a picture is drawn over the whole target.
inline PassSlot slotOf(PassSettings const& settings, backend::PassLayout const& layout, uint8_t subpass) {
    return { layout, subpass, settings.shading, settings.depthRange, settings.precision };
}
inline PassSlot fullScreenSlot(backend::PassLayout const& layout, uint8_t subpass) {
    return { .layout = layout, .subpass = subpass, .isFullScreen = true };
}

struct FrameContext {
    prepare::FramePacket packet{};
    PassSettings settings{};
    Arena* arena = nullptr;
    PipelineCache* pipelines = nullptr;
    std::span<const ViewGroup> views; ///< by view of the packet
    backend::BindGroupHandle postGroup;
    backend::BufferHandle instanceIds;
    std::span<const backend::CmdBindGroup> deformations; ///< by DrawCall::deformation
    backend::SamplerHandle nearestSampler;
    scene::Material* skybox = nullptr; ///< full-screen material; used when the packet has a sky
};

} // namespace filament::passes
