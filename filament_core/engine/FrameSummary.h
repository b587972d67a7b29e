// SPDX-License-Identifier: Apache-2.0
/// FrameSummary: what a frame drew and skipped, and why; as numbers and as text.
///   In      the packet and the plan of the frame, before its arena is reused.
///   Thread  pure functions.   Memory: the text.   Fails: std::bad_alloc, explain() only.
#pragma once

#include "filament_core/prepare/FramePacket.h"
#include "framegraph/CompiledGraph.h"

#include <filament_core/Renderer.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace filament_core::engine {

struct FrameSummary {
    /// Views of one kind together.
    struct Totals {
        uint32_t views = 0, visible = 0, occluded = 0, draws = 0;
        uint64_t triangles = 0;
    };

    FrameStatistics statistics; ///< renderables and lights: of the main view; draws and triangles: of all
    prepare::ViewCounts counts; ///< of the main view
    Totals main;
    std::array<Totals, prepare::kViewKinds> others{}; ///< by ViewKind, without the main view
    prepare::SceneDemand demand;
    uint2 size{ 1, 1 }, covered{ 1, 1 }; ///< pixels that the main view draws, and those of FramePacket::covered
};

FrameSummary summarize(uint64_t frame, prepare::FramePacket const& packet, framegraph::CompiledGraph const& plan);

/// `plan`: of the same frame; ignored if it has no graph. `times`: of any frame, by name of a group of passes.
std::vector<EffectDecision> decisions(FrameSummary const& summary, framegraph::CompiledGraph const& plan,
                                      std::span<const PassTiming> times = {});
std::string explain(FrameSummary const& summary, framegraph::CompiledGraph const& plan,
                    std::span<const PassTiming> times = {});

/// A reflection probe of the scene in the last frame.
struct ProbeLine {
    std::string name;
    prepare::ProbeUse use{};
};
/// Memory of `lines` is kept from frame to frame.
void keepProbes(scene::Probes const& probes, prepare::ProbePacket const& packet, std::vector<ProbeLine>& lines);
std::string explainProbes(std::span<const ProbeLine> lines);

/// The irradiance grids of the scene in the last frame, and the objects that they light.
struct GridLines {
    struct Line {
        std::string name;
        uint3 count{ 0 };
        uint32_t inside = 0;     ///< probes in geometry
        float standardError = 0; ///< root mean square of the probes', in shares of their mean
        bool isInView = false;
    };
    std::vector<Line> grids;
    uint64_t scene = 0, changes = 0; ///< serial, and scene::Grids::changes, of these lines
    uint32_t fields = 0, evaluated = 0;
    float largestError = 0;
};
void keepGrids(scene::SceneData const& scene, prepare::GridPacket const& packet, GridLines& lines);
std::string explainGrids(GridLines const& lines);

} // namespace filament_core::engine
