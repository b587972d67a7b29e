// SPDX-License-Identifier: Apache-2.0
/// Pipeline: a program with all fixed-function state, converted once; of a compute program nothing but that.
///   OpenGL ES has no such object: applying one is a few compares against ContextState.
///   Thread  the driver thread.
///   Memory  keeps its program alive, like a Vulkan pipeline.
#pragma once

#include "backend/gles/Program.h"
#include "backend/gles/Vertices.h"

#include <memory>

namespace filament_core::backend::gles {

struct Pipeline {
    std::shared_ptr<Program const> program; ///< null or name 0: draws are skipped
    VertexArray* vertices = nullptr;
    std::vector<ProgramInput> constantInputs; ///< read by the program, not in the layout
    RasterState raster{};
    GLenum topology = GL_TRIANGLES;
    DepthStencilState depthStencil{};                     ///< without the tests that the subpass has no attachment for
    std::array<BlendState, kMaxColorAttachments> blend{}; ///< write masks as the subpass allows
    uint8_t colorCount = 0;

    bool isUsable() const { return program && program->name() != 0; }
};

Pipeline makePipeline(PipelineDesc const& desc, std::shared_ptr<Program const> program, Vertices& vertices);

/// Sets everything except the vertex buffers and bind groups.
void applyPipeline(ContextState& state, Pipeline const& pipeline, uint8_t frontReference, uint8_t backReference);

} // namespace filament_core::backend::gles
