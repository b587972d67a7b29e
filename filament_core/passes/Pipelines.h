// SPDX-License-Identifier: Apache-2.0
/// PipelineCache: which device pipeline draws a material with a geometry in a pass. Programs and pipelines are made
/// here, when first asked for, and never inside a pass: passes choose their pipelines before they record.
///   Thread  the app thread. find(): any number at a time, while nothing is made.
///   Memory  one table entry a combination; lookups allocate nothing.
///   Fails   a variant that the material filtered out gives no pipeline and one warning naming material and variant.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/PipelineTable.h"
#include "filament_core/passes/ShadingKey.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/scene/SceneData.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace filament::passes {

/// Where a pipeline draws, and how lit materials are shaded there.
struct PassSlot {
    backend::PassLayout layout{};
    uint8_t subpass = 0;
    ShadingKey shading = 0;
    DepthRange depthRange = DepthRange::Reversed;
    ShadingPrecision precision = ShadingPrecision::Full;
    friend bool operator==(PassSlot const&, PassSlot const&) = default;
};

/// What a pipeline is chosen by, besides where it draws.
struct PipelineUse {
    scene::MaterialInstance const& instance;
    uint32_t geometryLayout = 0; ///< into GeometryLayouts
    uint8_t variant = 0;         ///< VariantBits that the scene selects
    bool mirrored = false;
    prepare::DrawPass pass = prepare::DrawPass::Only;
};

class PipelineCache {
public:
    PipelineCache(backend::CommandStream& stream, scene::GeometryLayouts const& layouts)
            : mStream(stream), mLayouts(layouts) {}

    /// Interns a pass; the result goes into pipelineFor(). Cheap for the few passes of a frame.
    uint32_t slot(PassSlot const& slot);

    /// What pipelineFor() answers, if it has answered that before.
    std::optional<backend::PipelineHandle> find(uint32_t slot, PipelineUse const& use) const;

    /// Records creation into `setup` when the pipeline does not exist yet. None: the draw must be skipped.
    backend::PipelineHandle pipelineFor(backend::CommandBuffer& setup, uint32_t slot, PipelineUse const& use);

    /// For full-screen materials: no vertices, no depth test unless the material asks for one.
    backend::PipelineHandle fullscreenPipeline(backend::CommandBuffer& setup, uint32_t slot, scene::Material& material);

    /// Destroys programs and pipelines of one material.
    void forget(backend::CommandBuffer& commands, scene::Material& material);

    size_t size() const { return mPipelines.size(); }

private:
    backend::ProgramHandle programFor(backend::CommandBuffer& setup, scene::Material& material, uint16_t variant,
                                      ShadingKey shading);
    backend::ProgramHandle createProgram(backend::CommandBuffer& setup, scene::Material const& material,
                                         shader::Variant const& code, ShadingKey shading);
    backend::PipelineDesc describe(PassSlot const& slot, scene::Material const& material, bool cullingDisabled,
                                   uint32_t geometryLayout, bool mirrored) const;
    backend::PipelineHandle create(backend::CommandBuffer& setup, uint64_t key, backend::PipelineDesc const& desc,
                                   uint32_t material);

    backend::CommandStream& mStream;
    scene::GeometryLayouts const& mLayouts;
    std::vector<PassSlot> mSlots;
    PipelineTable mPipelines;
};

} // namespace filament::passes
