// SPDX-License-Identifier: Apache-2.0
/// PipelineSource: where the passes of a frame get their pipelines. From the cache, which makes what is missing; or,
/// when a frame is only expected, from the cache as it is: missing ones go onto a list of requests. So the passes
/// that draw a frame are the ones that say what it needs.
///   In      the cache, and for an expected frame the list.
///   Limits  pipelines of surfaces are not requested: Engine::compile() asks for those, material by material.
///   Thread  as PipelineCache.   Memory: the list.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/passes/PipelineCache.h"

#include <optional>
#include <vector>

namespace filament_core::passes {

/// A pipeline of a full-screen material.
struct FullScreenRequest {
    uint32_t slot = 0; ///< of PipelineCache
    scene::Material const* material = nullptr;
};

class PipelineSource {
public:
    PipelineSource() = default;
    explicit PipelineSource(PipelineCache& cache, std::vector<FullScreenRequest>* requests = nullptr)
            : mCache(&cache), mRequests(requests) {}

    /// Nothing is made.
    bool isRequesting() const { return mRequests != nullptr; }

    uint32_t slot(PassSlot const& slot) const { return mCache->slot(slot); }
    uint32_t slotOfFields(uint32_t slot) const { return mCache->slotOfFields(slot); }

    /// PipelineCache's functions of these names; none for requests.
    std::optional<backend::PipelineHandle> find(uint32_t slot, PipelineUse const& use) const {
        return mCache->find(slot, use);
    }
    backend::PipelineHandle pipelineFor(backend::CommandBuffer& setup, uint32_t slot, PipelineUse const& use) const {
        return isRequesting() ? find(slot, use).value_or(backend::PipelineHandle{})
                              : mCache->pipelineFor(setup, slot, use);
    }
    backend::PipelineHandle fullscreenPipeline(backend::CommandBuffer& setup, uint32_t slot,
                                               scene::Material const& material) const {
        if (!isRequesting()) return mCache->fullscreenPipeline(setup, slot, material);
        const auto known = mCache->findFullscreen(slot, material);
        if (!known) mRequests->push_back({ slot, &material });
        return known.value_or(backend::PipelineHandle{});
    }

private:
    PipelineCache* mCache = nullptr;
    std::vector<FullScreenRequest>* mRequests = nullptr; // null: make it
};

} // namespace filament_core::passes
