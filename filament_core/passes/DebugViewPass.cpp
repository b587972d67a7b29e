// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DebugViewPass.h"

#include "filament_core/passes/FullScreenDraw.h"
#include "filament_core/passes/PassGroup.h"
#include "filament_core/prepare/ProbePacket.h"
#include "shaders/interface/ShaderInterface.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;

/// What the pass keeps until it is drawn.
struct DebugInputs {
    FrameTargets targets;
    PassBlock target;
    PassShadows shadows;
    PassBlock probes;
};

struct ChosenDebugView {
    PipelineHandle pipeline;
    BindGroupHandle pass, material;
};

/// The program reads the block of shadows, whether there are any or not.
PassShadows shadowsOrNone(FrameContext const& context, FrameTargets const& targets) {
    if (targets.shadowDepths) return declareShadows(context, targets.shadowDepths);
    static constexpr shader::ShadowUniforms kNone{};
    return { {}, context.blocks->add(std::as_bytes(std::span(&kNone, 1))) };
}

PassBlock probesOrNone(FrameContext const& context) {
    if (!context.packet.probes.empty()) return declareProbes(context);
    const shader::ProbeUniforms none = prepare::noProbes();
    return context.blocks->add(std::as_bytes(std::span(&none, 1)));
}

framegraph::TextureId shownDepthOf(FrameTargets const& targets) {
    return targets.sectionDepth ? targets.sectionDepth : targets.depth;
}

BindGroupHandle picturesOf(PassContext& pass, FrameContext const& context, FrameTargets const& targets) {
    shader::MaterialPackage const& package = context.resources.debugView->package;
    const SamplerHandle nearest = context.resources.samplers.nearest;
    const std::array<BindGroupEntry, 4> entries{ {
            { .binding = package.findParameter("picture")->binding,
              .texture = pass.texture(targets.color),
              .sampler = nearest },
            { .binding = package.findParameter("sceneDepth")->binding,
              .texture = pass.texture(shownDepthOf(targets)),
              .sampler = nearest },
            { .binding = package.findParameter("occlusion")->binding,
              .texture = targets.ambientOcclusion ? pass.texture(targets.ambientOcclusion) : context.resources.white,
              .sampler = nearest },
            { .binding = package.findParameter("motion")->binding,
              .texture = targets.motionVectors ? pass.texture(targets.motionVectors) : context.resources.white,
              .sampler = nearest },
    } };
    return pass.bindGroup(package.layout[shader::kGroupMaterial], entries, package.name);
}

ChosenDebugView choose(PassContext& pass, FrameContext const& context, DebugInputs const& inputs) {
    PipelineSource const& pipelines = context.resources.pipelines;
    const uint32_t slot = pipelines.slot(fullScreenSlot(pass.passLayout(), pass.subpass()));
    return { pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.debugView),
             passGroup(pass, context, shader::PassKind::Unlit, inputs.target,
                       { .shadows = inputs.shadows, .fogCells = inputs.targets.fogCells, .probes = inputs.probes }),
             picturesOf(pass, context, inputs.targets) };
}

} // namespace

void addDebugViewPass(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    const DebugInputs inputs{ targets, declareTarget(context, graph.texture(targets.output).desc),
                              shadowsOrNone(context, targets), probesOrNone(context) };
    graph.addPass(
            "debug view",
            [&](PassBuilder& pass) {
                pass.readSampled(targets.color);
                pass.readSampled(shownDepthOf(targets));
                if (targets.shadowDepths) pass.readSampled(targets.shadowDepths);
                if (targets.ambientOcclusion) pass.readSampled(targets.ambientOcclusion);
                if (targets.motionVectors) pass.readSampled(targets.motionVectors);
                if (targets.fogCells) pass.readBuffer(targets.fogCells, framegraph::BufferUse::Storage);
                pass.writeColor(0, targets.output, { .overwrites = true });
            },
            [of = &context, inputs](PassContext& pass) { return choose(pass, *of, inputs); },
            [of = &context](PassContext& pass, ChosenDebugView const& chosen) {
                recordFullScreen(pass.commands(), chosen.pipeline, of->views[0], chosen.pass,
                                 std::span(&chosen.material, 1));
            });
}

} // namespace filament_core::passes
