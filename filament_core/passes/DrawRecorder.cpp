// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DrawRecorder.h"

#include "filament_core/prepare/PrefetchDraws.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/Package.h"

#include <algorithm>
#include <atomic>
#include <optional>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::PassContext;
using prepare::DrawCall;

/// Tracks what has been bound; records only what differs.
class StateFilter {
public:
    StateFilter(CommandBuffer& commands, DrawContext const& context) : mCommands(commands), mContext(context) {}

    void bind(DrawCall const& draw, PipelineHandle pipeline) {
        if (pipeline != mPipeline) {
            mCommands.record(CmdBindPipeline{ pipeline });
            mPipeline = pipeline;
            mDeformation = {}; // its group does not survive a change of earlier groups
            // Lit, unlit and full-screen programs have different layouts of this group.
            bindPass(draw.material->material->package);
        }
        if (!hasField(draw)) bindWindow(draw);
        const BindGroupHandle material = draw.material->group(mContext.textureFilter);
        if (material != mMaterial) {
            mCommands.record(CmdBindGroup{ material, shader::kGroupMaterial });
            mMaterial = material;
        }
        if (draw.material->raster.stencil) bindReferences(*draw.material->raster.stencil);
        if (draw.deformation != scene::kNotDeformed) bindDeformation(mContext.deformations[draw.deformation]);
        bindGeometry(*draw.geometry);
    }

    /// Into the instance ids.
    uint32_t firstInstance(DrawCall const& draw) const {
        const uint32_t record = draw.firstObject % shader::kObjectsPerWindow;
        return mContext.hasPairs ? kFirstPairId + record / 2 : record;
    }
    bool hasField(DrawCall const& draw) const { return mContext.readsFields && draw.firstField != prepare::kNowhere; }
    /// Of the nth object of a draw that has one.
    void bindField(DrawCall const& draw, uint32_t nth) {
        mCommands.record(viewOf(mContext.channels.of(draw.properties.lightChannels)).bindField(draw.firstField + nth));
        mWindow = ~0u;
    }

private:
    ViewGroup const& viewOf(uint32_t list) const { return list == 0 ? mContext.view : mContext.view.lists[list - 1]; }

    void bindWindow(DrawCall const& draw) {
        const uint32_t window = draw.firstObject / shader::kObjectsPerWindow;
        const uint32_t list = mContext.channels.of(draw.properties.lightChannels);
        if (window == mWindow && list == mList) return;
        mCommands.record(viewOf(list).bind(draw.firstObject));
        mWindow = window;
        mList = list;
    }

    void bindPass(shader::MaterialPackage const& package) {
        const shader::PassKind kind = shader::passKind(package);
        const BindGroupHandle group = mContext.passGroups[static_cast<size_t>(kind)];
        if (group == mPass) return;
        mCommands.record(CmdBindGroup{ group, shader::kGroupPass });
        mPass = group;
    }

    /// Skins of one kind have the same.
    void bindDeformation(CmdBindGroup const& group) {
        if (mDeformation.group == group.group && mDeformation.dynamicOffsets == group.dynamicOffsets) return;
        mCommands.record(group);
        mDeformation = group;
    }

    void bindReferences(StencilState const& state) {
        const CmdSetStencilReference wanted{ state.front.reference, state.back.reference };
        if (mReferences && mReferences->front == wanted.front && mReferences->back == wanted.back) return;
        mCommands.record(wanted);
        mReferences = wanted;
    }

    void bindGeometry(scene::Geometry const& geometry) {
        if (geometry.vertices != mVertices) {
            CmdBindVertexBuffers bound{ { geometry.vertices }, {}, 1 };
            for (const BufferHandle stream : geometry.streams)
                if (stream) bound.buffers[bound.count++] = stream;
            bound.buffers[bound.count++] = mContext.instanceIds; // where withInstanceIndex() puts it
            mCommands.record(bound);
            mVertices = geometry.vertices;
        }
        if (geometry.indices != mIndices || geometry.indexFormat != mIndexType) {
            mCommands.record(CmdBindIndexBuffer{ geometry.indices, 0, geometry.indexFormat });
            mIndices = geometry.indices;
            mIndexType = geometry.indexFormat;
        }
    }

    CommandBuffer& mCommands;
    DrawContext const& mContext;
    PipelineHandle mPipeline;
    uint32_t mWindow = ~0u, mList = 0;
    BindGroupHandle mPass, mMaterial;
    CmdBindGroup mDeformation{};
    std::optional<CmdSetStencilReference> mReferences;
    BufferHandle mVertices, mIndices;
    IndexFormat mIndexType = IndexFormat::UInt16;
};

/// No handle has these bits: marks a pipeline that was never requested.
constexpr PipelineHandle kMissing{ ~0u };

bool isDrawnAlike(DrawCall const& a, DrawCall const& b) {
    return a.material == b.material && a.geometry->layout == b.geometry->layout && a.mirrored == b.mirrored &&
           a.properties == b.properties && a.pass == b.pass && (a.fade == 0) == (b.fade == 0) &&
           (a.deformation == scene::kNotDeformed) == (b.deformation == scene::kNotDeformed) &&
           (a.firstField == prepare::kNowhere) == (b.firstField == prepare::kNowhere);
}

/// What the scene selects for a draw; the geometry adds its own part.
struct DrawVariants {
    uint8_t ofView = 0;
    prepare::ChannelLists const& channels;
    DrawSlots slots, slotsOfFields; ///< of draws without and with an irradiance field

    uint32_t slotOf(DrawCall const& draw) const {
        return (draw.firstField == prepare::kNowhere ? slots : slotsOfFields).of(draw);
    }
};

PipelineUse useOf(DrawCall const& draw, DrawVariants const& variants) {
    const uint8_t own = draw.deformation == scene::kNotDeformed ? 0 : shader::kVariantSkinning;
    const uint8_t variant = variants.channels.variantOf(draw, variants.ofView);
    const int ofView = draw.properties.receivesShadows ? variant : variant & ~shader::kVariantShadowReceiver;
    return { *draw.material, draw.geometry->layout, static_cast<uint8_t>(ofView | own), draw.mirrored, draw.pass };
}

/// Looks pipelines up without changing the cache. Returns false if some are missing.
bool lookUp(std::span<PipelineHandle> chosen, PipelineSource const& pipelines, std::span<const DrawCall> draws,
            DrawVariants const& variants) {
    bool hasAll = true;
    for (size_t i = 0; i < draws.size(); ++i) {
        prepare::prefetchDraw(draws, i);
        DrawCall const& draw = draws[i];
        chosen[i] = i > 0 && isDrawnAlike(draw, draws[i - 1])
                            ? chosen[i - 1]
                            : pipelines.find(variants.slotOf(draw), useOf(draw, variants)).value_or(kMissing);
        hasAll = hasAll && chosen[i] != kMissing;
    }
    return hasAll;
}

/// Creates what lookUp() did not find, in drawing order.
void make(std::span<PipelineHandle> chosen, CommandBuffer& setup, PipelineSource const& pipelines,
          std::span<const DrawCall> draws, DrawVariants const& variants) {
    for (size_t i = 0; i < draws.size(); ++i) {
        if (chosen[i] != kMissing) continue;
        chosen[i] = pipelines.pipelineFor(setup, variants.slotOf(draws[i]), useOf(draws[i], variants));
    }
}

} // namespace

std::span<const PipelineHandle> choosePipelines(PassContext& pass, Arena& arena, PipelineSource const& pipelines,
                                                DrawSlots slots, std::span<const DrawCall> draws, uint8_t variant,
                                                prepare::ChannelLists const& channels) {
    const bool hasFields =
            std::ranges::any_of(draws, [](DrawCall const& draw) { return draw.firstField != prepare::kNowhere; });
    const DrawSlots slotsOfFields =
            hasFields ? DrawSlots(pipelines.slotOfFields(slots.slot), pipelines.slotOfFields(slots.fading)) : slots;
    const DrawVariants variants{ variant, channels, slots, slotsOfFields };
    const std::span<PipelineHandle> chosen = arena.array<PipelineHandle>(draws.size());
    if (pipelines.isRequesting()) return chosen;
    std::atomic<bool> someAreMissing{ false };
    pass.forEachRange(draws.size(), kDrawsPerRange, [&](size_t begin, size_t end) {
        const std::span<PipelineHandle> range = chosen.subspan(begin, end - begin);
        if (!lookUp(range, pipelines, draws.subspan(begin, end - begin), variants))
            someAreMissing.store(true, std::memory_order_relaxed);
    });
    // Jobs only look up. What is missing is created here, in the order of drawing, so that the command stream is the
    // same for any number of workers; after the first frames that is nothing.
    if (someAreMissing.load(std::memory_order_relaxed)) make(chosen, pass.commands(), pipelines, draws, variants);
    return chosen;
}

void recordDraws(CommandBuffer& commands, DrawContext const& context, std::span<const DrawCall> draws,
                 std::span<const PipelineHandle> pipelines) {
    StateFilter state(commands, context);
    for (size_t i = 0; i < draws.size(); ++i) {
        prepare::prefetchDraw(draws, i);
        // A material without the variant, which takeErrors() reports.
        if (!pipelines[i]) continue;
        DrawCall const& draw = draws[i];
        state.bind(draw, pipelines[i]);
        if (state.hasField(draw)) {
            for (uint32_t nth = 0; nth < draw.instanceCount; ++nth) {
                state.bindField(draw, nth);
                commands.record(CmdDrawIndexed{ draw.geometry->indexCount, 1, draw.geometry->firstIndex, 0, 0 });
            }
            continue;
        }
        commands.record(CmdDrawIndexed{ draw.geometry->indexCount, draw.instanceCount, draw.geometry->firstIndex, 0,
                                        state.firstInstance(draw) });
    }
}

void recordDrawRanges(PassContext& pass, DrawContext const& context, std::span<const DrawCall> draws,
                      std::span<const PipelineHandle> pipelines) {
    pass.recordRanges(draws.size(), kDrawsPerRange, [&](CommandBuffer& commands, size_t begin, size_t end) {
        recordDraws(commands, context, draws.subspan(begin, end - begin), pipelines.subspan(begin, end - begin));
    });
}

} // namespace filament_core::passes
