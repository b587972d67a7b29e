// SPDX-License-Identifier: Apache-2.0
/// DrawState: what the stream has bound; prepareDraw() sets the parts that a draw needs and the context lacks.
///   Thread  the driver thread, context current.
///   Fails   prepareDraw() returns false if something that the pipeline needs is missing or could not be created.
///   Cost    a few compares for a draw without changes: ContextState knows the state of the context.
#pragma once

#include "backend/gles/Descriptors.h"
#include "backend/gles/Pipeline.h"
#include "backend/gles/Vertices.h"

#include <array>

namespace filament_core::backend::gles {

class DrawState {
public:
    DrawState(ContextState& context, Vertices& vertices)
            : mContext(context), mVertices(vertices), mDescriptors(context) {}

    /// A new subpass: nothing bound, the stencil reference is 0.
    void beginSubpass();

    void setStencilReference(uint8_t front, uint8_t back);
    void setPipeline(Pipeline const* pipeline);
    void setGroup(uint32_t index, BindGroup const* group,
                  std::array<uint32_t, kMaxDynamicOffsets> const& dynamicOffsets);
    void setVertexBuffer(uint32_t slot, Buffer const* buffer, uint64_t offset);
    void setIndexBuffer(Buffer const* buffer, uint64_t offset, IndexFormat type);

    /// Prepares the context; false: skip the draw. `base` is what the draw call itself cannot express.
    bool prepareDraw(bool indexed, DrawBase base);

    /// Of the pipeline that the last successful prepareDraw() used.
    GLenum topology() const { return mPipeline->topology; }
    VertexSources const& sources() const { return mSources; }

private:
    ContextState& mContext;
    Vertices& mVertices;
    Descriptors mDescriptors;
    Pipeline const* mPipeline = nullptr;
    bool mPipelineApplied = false;
    VertexSources mSources;
    uint8_t mStencilFront = 0, mStencilBack = 0;
};

} // namespace filament_core::backend::gles
