// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ToneMapPass.h"

namespace filament::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

struct Chosen {
    PipelineHandle pipeline;
    BindGroupHandle input;
};

Chosen choose(PassContext& pass, FrameContext const& context, ToneMapMaterials materials, TextureId color) {
    const bool merged = pass.isMerged(color);
    scene::Material& material = merged ? *materials.merged : *materials.sampled;
    const uint32_t slot = context.pipelines->slot(fullScreenSlot(pass.passLayout(), pass.subpass()));
    std::array<BindGroupEntry, 2> entries{};
    entries[0] = { .binding = material.package.findParameter("color")->binding,
                   .texture = pass.texture(color),
                   .sampler = merged ? SamplerHandle{} : context.nearestSampler };
    size_t count = 1;
    if (materials.table) {
        entries[count++] = { .binding = material.package.findParameter("table")->binding,
                             .texture = materials.table,
                             .sampler = context.nearestSampler };
    }
    return { context.pipelines->fullscreenPipeline(pass.commands(), slot, material),
             pass.bindGroup(material.package.layout[shader::kGroupMaterial], std::span(entries).first(count),
                            "tone map") };
}

} // namespace

framegraph::PassId addToneMapPass(FrameGraph& graph, FrameContext const* context, ToneMapMaterials materials,
                                  TextureId color, TextureId display) {
    return graph.addPass(
            "tone map",
            [&](PassBuilder& pass) {
                pass.readInput(color);
                pass.writeColor(0, display, { .overwrites = true });
            },
            [=](PassContext& pass) { return choose(pass, *context, materials, color); },
            [=](PassContext& pass, Chosen const& chosen) {
                CommandBuffer& commands = pass.commands();
                commands.record(CmdBindPipeline{ chosen.pipeline });
                commands.record(CmdBindGroup{ context->postGroup, shader::kGroupView, 1, {} });
                commands.record(CmdBindGroup{ chosen.input, shader::kGroupMaterial });
                commands.record(CmdDraw{ 3 });
            });
}

} // namespace filament::passes
