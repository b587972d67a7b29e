// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/Frame.h"

#include "filament_core/passes/ColorPass.h"
#include "filament_core/passes/ToneMapPass.h"

namespace filament::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;

PassSettings settingsOf(View const& view, FrameResources const& resources,
                        prepare::EnvironmentPacket const& environment) {
    FILAMENT_ASSERT(view.samples == 1 || view.samples == 4, "a view has 1 or 4 samples a pixel");
    return { .size = view.size,
             .samples = view.samples,
             .clearColor = view.clearColor,
             .shading = shadingKey(view.quality, environment.storage),
             .depthRange = view.quality.depthRange,
             .precision = resources.hasHalfFloats ? view.quality.shadingPrecision : ShadingPrecision::Full,
             .textureFilter = view.quality.textureFilter };
}

FrameTargets beginFrame(FrameGraph& graph, PassSettings const& settings, FrameOutput const& output) {
    FrameTargets targets;
    targets.output = graph.importTexture(
            output.texture,
            { .width = output.width, .height = output.height, .format = output.format, .name = "output" },
            framegraph::InitialContents::Undefined);
    targets.color = output.isSceneLinear() ? targets.output
                                           : graph.createTexture({ .width = settings.size.x,
                                                                   .height = settings.size.y,
                                                                   .format = Format::RGBA16F,
                                                                   .name = "color" });
    return targets;
}

} // namespace

FrameContext* makeFrameContext(Arena& arena, prepare::FramePacket const& packet, FrameResources const& resources,
                               View const& view) {
    FrameContext* context = arena.make<FrameContext>();
    context->packet = packet;
    context->resources = resources;
    context->settings = settingsOf(view, resources, packet.environment);
    context->view = &view;
    context->arena = &arena;
    return context;
}

FrameTargets describeFrame(FrameGraph& graph, FrameContext const& context, FrameOutput const& output) {
    FrameTargets targets = beginFrame(graph, context.settings, output);
    addColorPass(graph, context, targets);
    if (targets.color != targets.output) addToneMapPass(graph, context, targets);
    return targets;
}

} // namespace filament::passes
