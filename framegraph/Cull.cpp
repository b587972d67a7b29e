// SPDX-License-Identifier: Apache-2.0
#include "framegraph/CompileSteps.h"

namespace filament::framegraph {
namespace {

/// Whether the contents of a texture are still wanted, seen from a point of the frame towards its end.
struct Demand {
    bool isWanted = false;
    uint32_t reader = kNone; // kNone: wanted after the frame
};

bool isWhole(GraphTextureDesc const& desc) { return desc.levels == 1 && desc.layers == 1; }

PassDecision decide(FrameGraph const& graph, Pass const& pass, std::span<const Demand> demands) {
    if (pass.hasSideEffect) return { .reason = Reason::SideEffect };
    const auto wantedBy = [&](TextureId texture) -> PassDecision {
        Demand const& demand = demands[texture.index()];
        if (!demand.isWanted) return {};
        return { .reason = demand.reader == kNone ? Reason::WritesOutput : Reason::ReadLater,
                 .because = texture,
                 .reader = demand.reader };
    };
    for (Access const& access : graph.accesses(pass)) {
        if (isPureRead(access.kind)) continue;
        if (const PassDecision decision = wantedBy(access.texture); decision.runs()) return decision;
        if (!access.resolve) continue;
        if (const PassDecision decision = wantedBy(access.resolve); decision.runs()) return decision;
    }
    return {};
}

// Before a pass that runs: what it replaces completely is not wanted, what it reads or draws over is.
void stepBack(FrameGraph const& graph, uint32_t pass, std::span<Demand> demands) {
    const std::span<const Access> accesses = graph.accesses(graph.passes()[pass]);
    for (Access const& access : accesses) {
        if (access.resolve && isWhole(graph.texture(access.resolve).desc)) demands[access.resolve.index()] = {};
        const bool replaces = !isPureRead(access.kind) && access.previous != Previous::Keep;
        if (replaces && isWhole(graph.texture(access.texture).desc)) demands[access.texture.index()] = {};
    }
    for (Access const& access : accesses) {
        const bool reads = isPureRead(access.kind) || access.previous == Previous::Keep;
        if (reads) demands[access.texture.index()] = { true, pass };
    }
}

} // namespace

PassOrder cullUnreadPasses(FrameGraph const& graph) {
    const auto passCount = static_cast<uint32_t>(graph.passes().size());
    const std::span<PassDecision> decisions = graph.arena().array<PassDecision>(passCount);
    const std::span<Demand> demands = graph.arena().array<Demand>(graph.textures().size());
    for (size_t i = 0; i < demands.size(); ++i) demands[i].isWanted = graph.textures()[i].isOutput;

    uint32_t running = 0;
    for (uint32_t pass = passCount; pass-- > 0;) {
        decisions[pass] = decide(graph, graph.passes()[pass], demands);
        if (!decisions[pass].runs()) continue;
        stepBack(graph, pass, demands);
        ++running;
    }
    const std::span<uint32_t> order = graph.arena().array<uint32_t>(running);
    uint32_t at = 0;
    for (uint32_t pass = 0; pass < passCount; ++pass) {
        if (decisions[pass].runs()) order[at++] = pass;
    }
    return { decisions, order };
}

} // namespace filament::framegraph
