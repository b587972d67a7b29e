// SPDX-License-Identifier: Apache-2.0
/// PipelineCache: which device pipeline draws a material with a geometry in a pass. Programs and pipelines are made
/// here, when first asked for, and never inside a pass: passes choose their pipelines before they record.
///   Thread  the app thread. find(): any number at a time, while nothing is made.
///   Memory  one table entry a combination, and what was made of each material, until forget(): a material itself holds
///           nothing of it, and several caches may share one. Lookups allocate nothing.
///   Fails   a material without the variant that is asked for, or of another domain, gives no pipeline, and once a line
///           in takeRefusals() that says what is missing.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/PassSlot.h"
#include "filament_core/passes/PipelineTable.h"
#include "filament_core/scene/SceneData.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace filament_core::passes {

/// The line for a variant (a set of VariantBits) that a package lacks, naming both and the filter.
std::string missingVariant(std::string_view material, shader::MaterialPackage const& package, uint32_t variant);

class PipelineCache {
public:
    PipelineCache(backend::CommandStream& stream, scene::GeometryLayouts const& layouts)
            : mStream(stream), mLayouts(layouts) {}

    /// Interns a pass; the result goes into pipelineFor(). Cheap for the few passes of a frame. What has a stencil
    /// state gets slots of its own, because there are too many states for a key.
    uint32_t slot(PassSlot const& slot);
    /// Where draws with an irradiance field go: the same place, lit by that.
    uint32_t slotOfFields(uint32_t slot);
    std::span<const PassSlot> slots() const { return mSlots; }

    /// What pipelineFor() answers, if it has answered that before.
    std::optional<backend::PipelineHandle> find(uint32_t slot, PipelineUse const& use) const;

    /// Records creation into `setup` when the pipeline does not exist yet. None: the draw must be skipped.
    backend::PipelineHandle pipelineFor(backend::CommandBuffer& setup, uint32_t slot, PipelineUse const& use);

    /// For full-screen materials: no vertices, no depth test unless the material asks for one.
    backend::PipelineHandle fullscreenPipeline(backend::CommandBuffer& setup, uint32_t slot,
                                               scene::Material const& material);

    std::optional<backend::PipelineHandle> findFullscreen(uint32_t slot, scene::Material const& material) const;

    /// The program alone, for a pass; made if it does not exist yet.
    void prepareProgram(backend::CommandBuffer& setup, uint32_t slot, scene::Material const& material, uint8_t variant);
    bool hasProgram(uint32_t slot, scene::Material const& material, uint8_t variant) const;

    /// What could not be drawn since the last call, a line each.
    std::vector<std::string> takeRefusals() { return std::exchange(mRefusals, {}); }

    /// Destroys programs and pipelines of one material.
    void forget(backend::CommandBuffer& commands, scene::Material const& material);

    /// Pipelines, those that could not be made included.
    size_t size() const { return mPipelines.size(); }
    size_t programCount(scene::Material const& material) const;

private:
    struct Program {
        uint64_t key = 0; ///< variant and shading
        backend::ProgramHandle handle;
    };
    /// What was made of one material, and what could not be.
    struct MaterialState {
        std::vector<Program> programs;         // a few: searched
        std::vector<uint16_t> refusedVariants; // asked for and not there: told once
    };
    Program const* findProgram(scene::Material const& material, uint64_t key) const;

    struct ProgramChoice {
        uint16_t variant = 0;
        ShadingKey shading = 0;
    };
    ProgramChoice choose(uint32_t slot, scene::Material const& material, uint8_t variant) const;
    ProgramChoice chooseWithTextures(uint32_t slot, scene::Material const& material, uint8_t variant) const;
    /// `edges`: whose fragment stage follows instead of the variant's own; null: that.
    backend::ProgramHandle programFor(backend::CommandBuffer& setup, scene::Material const& material, uint16_t variant,
                                      ShadingKey shading, scene::Material const* edges = nullptr);
    backend::ProgramHandle createProgram(backend::CommandBuffer& setup, scene::Material const& material,
                                         shader::Variant const& code, ShadingKey shading,
                                         shader::Variant const& fragment);
    backend::PipelineHandle create(backend::CommandBuffer& setup, uint64_t key, backend::PipelineDesc const& desc,
                                   uint32_t material);

    std::optional<uint32_t> findSlot(PassSlot const& slot) const;

    backend::ProgramHandle surfaceProgram(backend::CommandBuffer& setup, uint32_t slot, scene::Material const& material,
                                          uint8_t variant);
    backend::ProgramHandle refuse(scene::Material const& material, uint16_t variant, std::string why);

    backend::CommandStream& mStream;
    scene::GeometryLayouts const& mLayouts;
    std::vector<PassSlot> mSlots;
    PipelineTable mPipelines;
    std::unordered_map<uint32_t, MaterialState> mMaterials; // by scene::Material::id
    std::vector<std::string> mRefusals;
};

} // namespace filament_core::passes
