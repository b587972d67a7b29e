// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DrawRecorder.h"

#include "shaders/interface/ShaderInterface.h"

namespace filament::passes {
namespace {

using namespace backend;
using prepare::DrawCall;

/// What the commands so far have bound; records only what differs.
class StateFilter {
public:
    StateFilter(CommandBuffer& commands, DrawContext const& context) : mCommands(commands), mContext(context) {}

    void bind(DrawCall const& draw, PipelineHandle pipeline) {
        if (pipeline != mPipeline) {
            mCommands.record(CmdBindPipeline{ pipeline });
            mPipeline = pipeline;
        }
        const uint32_t window = draw.firstObject / shader::kObjectsPerWindow;
        if (window != mWindow) {
            mCommands.record(FrameData::bindView(mContext.viewGroup, draw.firstObject));
            mWindow = window;
        }
        if (draw.material->group != mMaterial) {
            mCommands.record(CmdBindGroup{ draw.material->group, shader::kGroupMaterial });
            mMaterial = draw.material->group;
        }
        bindGeometry(*draw.geometry);
    }

private:
    void bindGeometry(scene::Geometry const& geometry) {
        if (geometry.vertices != mVertices) {
            mCommands.record(CmdBindVertexBuffers{ { geometry.vertices, mContext.instanceIds }, {}, 2 });
            mVertices = geometry.vertices;
        }
        if (geometry.indices != mIndices || geometry.indexType != mIndexType) {
            mCommands.record(CmdBindIndexBuffer{ geometry.indices, 0, geometry.indexType });
            mIndices = geometry.indices;
            mIndexType = geometry.indexType;
        }
    }

    CommandBuffer& mCommands;
    DrawContext const& mContext;
    PipelineHandle mPipeline;
    uint32_t mWindow = ~0u;
    BindGroupHandle mMaterial;
    BufferHandle mVertices, mIndices;
    IndexType mIndexType = IndexType::UInt16;
};

} // namespace

std::span<const PipelineHandle> choosePipelines(Arena& arena, PipelineCache& pipelines, CommandBuffer& setup,
                                                uint32_t slot, std::span<const DrawCall> draws, uint8_t variant) {
    std::span<PipelineHandle> chosen = arena.array<PipelineHandle>(draws.size());
    for (size_t i = 0; i < draws.size(); ++i) {
        DrawCall const& draw = draws[i];
        const bool asBefore = i > 0 && draws[i - 1].material == draw.material &&
                              draws[i - 1].geometry->layout == draw.geometry->layout &&
                              draws[i - 1].mirrored == draw.mirrored;
        chosen[i] = asBefore ? chosen[i - 1]
                             : pipelines.pipelineFor(setup, slot, *draw.material, draw.geometry->layout, variant,
                                                     draw.mirrored);
    }
    return chosen;
}

void recordDraws(CommandBuffer& commands, DrawContext const& context, std::span<const DrawCall> draws,
                 std::span<const PipelineHandle> pipelines) {
    StateFilter state(commands, context);
    for (size_t i = 0; i < draws.size(); ++i) {
        if (!pipelines[i]) continue;
        DrawCall const& draw = draws[i];
        state.bind(draw, pipelines[i]);
        commands.record(CmdDrawIndexed{ draw.geometry->indexCount, draw.instanceCount, draw.geometry->firstIndex, 0,
                                        draw.firstObject % shader::kObjectsPerWindow });
    }
}

void recordDrawRanges(framegraph::PassContext& pass, DrawContext const& context, std::span<const DrawCall> draws,
                      std::span<const PipelineHandle> pipelines) {
    pass.recordRanges(draws.size(), kDrawsPerRange, [&](CommandBuffer& commands, size_t begin, size_t end) {
        recordDraws(commands, context, draws.subspan(begin, end - begin), pipelines.subspan(begin, end - begin));
    });
}

} // namespace filament::passes
