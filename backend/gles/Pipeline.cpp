// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Pipeline.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

bool providesLocation(VertexLayout const& layout, uint8_t location) {
    const auto end = layout.attributes.begin() + layout.attributeCount;
    return std::any_of(layout.attributes.begin(), end,
                       [=](VertexAttribute const& at) { return at.location == location; });
}

std::vector<ProgramInput> inputsWithoutArray(Program const& program, VertexLayout const& layout) {
    std::vector<ProgramInput> missing;
    for (ProgramInput const& input : program.inputs()) {
        if (!providesLocation(layout, input.location)) missing.push_back(input);
    }
    return missing;
}

DepthStencilState allowedTests(PipelineDesc const& desc, SubpassDesc const& subpass) {
    DepthStencilState state = desc.depthStencil;
    if (desc.pass.depthFormat == Format::None || !subpass.usesDepth) {
        state.depthCompare = CompareOp::None;
        state.stencilTest = false;
    }
    state.stencilTest = state.stencilTest && hasStencil(desc.pass.depthFormat);
    return state;
}

} // namespace

Pipeline makePipeline(PipelineDesc const& desc, std::shared_ptr<Program const> program, Vertices& vertices) {
    Pipeline pipeline;
    if (program && program->isCompute()) {
        pipeline.program = std::move(program);
        return pipeline;
    }
    SubpassDesc const& subpass = desc.pass.subpasses[desc.subpass];
    pipeline.vertices = &vertices.get(desc.vertices);
    if (program) pipeline.constantInputs = inputsWithoutArray(*program, desc.vertices);
    const uint32_t written = subpass.colorMask & (program ? program->outputMask() : 0);
    pipeline.program = std::move(program);
    pipeline.raster = desc.raster;
    pipeline.topology = glTopology(desc.raster.topology);
    pipeline.depthStencil = allowedTests(desc, subpass);
    pipeline.colorCount = desc.pass.colorCount;
    for (uint32_t i = 0; i < desc.pass.colorCount; ++i) {
        pipeline.blend[i] = desc.blend[i];
        if (!((written >> i) & 1)) pipeline.blend[i].writeMask = 0;
    }
    return pipeline;
}

void applyPipeline(ContextState& state, Pipeline const& pipeline, uint8_t frontReference, uint8_t backReference) {
    state.useProgram(pipeline.program->name());
    state.setRaster(pipeline.raster);
    state.setDepthStencil(pipeline.depthStencil, frontReference, backReference);
    for (uint32_t i = 0; i < pipeline.colorCount; ++i) state.setBlend(i, pipeline.blend[i]);
    for (ProgramInput const& input : pipeline.constantInputs) {
        state.setConstantAttribute(input.location, input.scalarType);
    }
}

} // namespace filament_core::backend::gles
