// SPDX-License-Identifier: Apache-2.0
/// Picker: requests and results of picks; implements those of Renderer.
///   Thread  the app thread.
///   Memory  made at the first pick: a depth texture of 64 x 64 texels, uniforms of what a pixel may show, and an entry
///           for each ticket until it is taken.
///   Fails   ask(): std::bad_alloc, which leaves no trace of the pick. On a lost device take() answers with no hit, and
///           wait() with an error. An unknown ticket is a bug of the caller.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/FrameResourceCache.h"
#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/PassBlocks.h"
#include "filament_core/prepare/PreparePick.h"
#include "framegraph/CompiledGraph.h"
#include "framegraph/TransientPool.h"

#include <filament_core/Renderer.h>

#include <map>
#include <optional>

namespace filament_core::engine {

class Picker {
public:
    explicit Picker(Engine::Impl& engine);
    ~Picker();
    Picker(Picker const&) = delete;
    Picker& operator=(Picker const&) = delete;

    /// `input`: of the view, without jitter. `last`: the levels of detail that the last frame drew.
    PickTicket ask(scene::SceneData const& scene, View const& view, prepare::ViewInput const& input,
                   FrameResourceCache& resources, uint2 pixel, PickAim aim, std::span<const prepare::DrawnLevel> last);
    std::optional<PickHit> take(PickTicket ticket);
    Result<PickHit> wait(PickTicket ticket);

private:
    /// What a texel stands for, and where the pixel is.
    struct Pending {
        std::vector<PickHit> candidates; ///< without their places
        Camera camera{};
        uint2 size{}, pixel{};
        SectionPlanes section{};
        std::vector<uint32_t> fronts{}; ///< of which candidate texels after those of candidates have front faces alone
    };
    using Pendings = std::map<uint64_t, Pending>;

    Pending describe(scene::SceneData const& scene, View const& view, uint2 pixel,
                     prepare::PreparedPick const& pick) const;
    void record(View const& view, prepare::PreparedPick const& pick, FrameResourceCache& resources, uint2 pixel,
                backend::Ticket ticket);
    void makeDepths();
    Pendings::iterator find(PickTicket ticket);

    Engine::Impl& mEngine;
    Arena mArena;
    framegraph::FrameGraph mGraph;
    framegraph::TransientPool mTransients;
    passes::FrameData mData;
    passes::PassBlocks mBlocks;
    backend::TextureHandle mDepths;
    Pendings mPending;
};

} // namespace filament_core::engine
