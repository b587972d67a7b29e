// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ToneMapPass.h"

#include "filament_core/passes/PassGroup.h"
#include "shaders/interface/ShaderInterface.h"

namespace filament::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

struct Chosen {
    PipelineHandle pipeline;
    BindGroupHandle pass, input;
};

Chosen choose(PassContext& pass, FrameContext const& context, TextureId color, PassBlock target) {
    FrameResources const& resources = context.resources;
    ToneMapMaterials const& materials = resources.toneMap;
    const bool merged = pass.isMerged(color);
    scene::Material const& material = merged ? *materials.merged : *materials.sampled;
    const uint32_t slot = resources.pipelines.slot(fullScreenSlot(pass.passLayout(), pass.subpass()));
    std::array<BindGroupEntry, 2> entries{};
    entries[0] = { .binding = material.package.findParameter("color")->binding,
                   .texture = pass.texture(color),
                   .sampler = merged ? SamplerHandle{} : resources.nearestSampler };
    size_t count = 1;
    if (materials.table) {
        entries[count++] = { .binding = material.package.findParameter("table")->binding,
                             .texture = materials.table,
                             .sampler = resources.nearestSampler };
    }
    return { resources.pipelines.fullscreenPipeline(pass.commands(), slot, material),
             passGroup(pass, context, shader::PassKind::Picture, target),
             pass.bindGroup(material.package.layout[shader::kGroupMaterial], std::span(entries).first(count),
                            "tone map") };
}

} // namespace

void addToneMapPass(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    const TextureId color = targets.color;
    const PassBlock target = declareTarget(context, graph.texture(targets.output).desc);
    graph.addPass(
            "tone map",
            [&](PassBuilder& pass) {
                pass.readInput(color);
                pass.writeColor(0, targets.output, { .overwrites = true });
            },
            [of = &context, color, target](PassContext& pass) { return choose(pass, *of, color, target); },
            [of = &context](PassContext& pass, Chosen const& chosen) {
                CommandBuffer& commands = pass.commands();
                commands.record(CmdBindPipeline{ chosen.pipeline });
                commands.record(of->views[0].bind(0));
                commands.record(CmdBindGroup{ chosen.pass, shader::kGroupPass });
                commands.record(CmdBindGroup{ chosen.input, shader::kGroupMaterial });
                commands.record(CmdDraw{ 3 });
            });
}

} // namespace filament::passes
