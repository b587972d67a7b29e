// SPDX-License-Identifier: Apache-2.0
/// FrameSummary: what a frame drew, what it did not, and why; as numbers and as text.
///   In      the packet and the plan of the frame, before its arena is reused.
///   Thread  pure functions.   Memory: the text.   Fails: std::bad_alloc, explain() only.
#pragma once

#include "filament_core/prepare/FramePacket.h"
#include "framegraph/CompiledGraph.h"

#include <filament/Renderer.h>

#include <string>

namespace filament::engine {

struct FrameSummary {
    FrameStatistics statistics;
    prepare::PacketCounts counts;
    bool hasSky = false, hasIndirectLight = false;
};

FrameSummary summarize(uint64_t frame, prepare::FramePacket const& packet, framegraph::CompiledGraph const& plan);

/// One decision a line. `plan`: of the same frame; one without a graph is left out.
std::string explain(FrameSummary const& summary, framegraph::CompiledGraph const& plan);

} // namespace filament::engine
