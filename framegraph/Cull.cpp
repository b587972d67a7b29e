// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"
#include "framegraph/Subresources.h"

namespace filament_core::framegraph {
namespace {

/// Whether the contents of a level and layer are still needed by the rest of the frame.
struct Demand {
    bool isWanted = false;
    uint32_t reader = kNone; // kNone: needed after the frame
};

class Demands {
public:
    explicit Demands(FrameGraph const& graph)
            : mGraph(graph), mSubresources(graph), mDemands(graph.arena().array<Demand>(mSubresources.count())) {
        for (uint32_t i = 0; i < graph.textures().size(); ++i) {
            Texture const& texture = graph.textures()[i];
            if (texture.isOutput) set({ i + 1 }, Subresources::all(texture.desc), { .isWanted = true });
        }
        for (uint32_t i = 0; i < graph.buffers().size(); ++i) {
            mDemands[mSubresources.of(BufferId{ i + 1 })].isWanted = graph.buffers()[i].isOutput;
        }
    }

    PassDecision decide(Pass const& pass) const {
        if (pass.hasSideEffect) return { .reason = Reason::SideEffect };
        for (Access const& access : mGraph.accesses(pass)) {
            if (isPureRead(access.kind)) continue;
            if (const PassDecision decision = wantedBy(access.texture, access.range); decision.runs()) return decision;
            if (!access.resolve) continue;
            if (const PassDecision decision = wantedBy(access.resolve, kResolved); decision.runs()) return decision;
        }
        for (BufferAccess const& access : mGraph.bufferAccesses(pass)) {
            Demand const& demand = mDemands[mSubresources.of(access.buffer)];
            if (access.writes && demand.isWanted) return decisionOf(demand, { .becauseBuffer = access.buffer });
        }
        return {};
    }

    /// Steps back over a pass that runs: what it replaces completely is no longer needed, what it reads or draws over
    /// is.
    void stepBack(uint32_t pass) {
        const std::span<const Access> accesses = mGraph.accesses(mGraph.passes()[pass]);
        for (Access const& access : accesses) {
            if (access.resolve) set(access.resolve, kResolved, {});
            // What is replaced leaves before what is read enters: a pass may replace one level of a texture and read
            // another.
            const bool replaces = !isPureRead(access.kind) && access.previous != Previous::Keep;
            if (replaces) set(access.texture, access.range, {});
        }
        for (Access const& access : accesses) {
            const bool reads = isPureRead(access.kind) || access.previous == Previous::Keep;
            if (reads) set(access.texture, access.range, { true, pass });
        }
        const std::span<const BufferAccess> buffers = mGraph.bufferAccesses(mGraph.passes()[pass]);
        for (BufferAccess const& access : buffers) {
            if (access.writes && access.previous != Previous::Keep) mDemands[mSubresources.of(access.buffer)] = {};
        }
        for (BufferAccess const& access : buffers) {
            const bool reads = !access.writes || access.previous == Previous::Keep;
            if (reads) mDemands[mSubresources.of(access.buffer)] = { true, pass };
        }
    }

private:
    void set(TextureId texture, backend::TextureRange const& range, Demand const& demand) {
        mSubresources.forEach(texture, range, [&](uint32_t number) { mDemands[number] = demand; });
    }

    static PassDecision decisionOf(Demand const& demand, PassDecision decision) {
        decision.reason = demand.reader == kNone ? Reason::WritesOutput : Reason::ReadLater;
        decision.reader = demand.reader;
        return decision;
    }

    PassDecision wantedBy(TextureId texture, backend::TextureRange const& range) const {
        PassDecision decision;
        mSubresources.any(texture, range, [&](uint32_t number, uint8_t level, uint16_t layer) {
            Demand const& demand = mDemands[number];
            if (!demand.isWanted) return false;
            decision = decisionOf(demand, { .because = texture, .level = level, .layer = layer });
            return true;
        });
        return decision;
    }

    FrameGraph const& mGraph;
    Subresources mSubresources;
    std::span<Demand> mDemands;
};

} // namespace

PassOrder cullUnreadPasses(FrameGraph const& graph) {
    const auto passCount = static_cast<uint32_t>(graph.passes().size());
    const std::span<PassDecision> decisions = graph.arena().array<PassDecision>(passCount);
    Demands demands(graph);
    uint32_t running = 0;
    // From the last pass back: whether a pass is needed is known once all passes are known that may read what it
    // writes.
    for (uint32_t pass = passCount; pass-- > 0;) {
        decisions[pass] = demands.decide(graph.passes()[pass]);
        if (!decisions[pass].runs()) continue;
        demands.stepBack(pass);
        ++running;
    }
    const std::span<uint32_t> order = graph.arena().array<uint32_t>(running);
    uint32_t at = 0;
    for (uint32_t pass = 0; pass < passCount; ++pass) {
        if (decisions[pass].runs()) order[at++] = pass;
    }
    return { decisions, order };
}

} // namespace filament_core::framegraph
