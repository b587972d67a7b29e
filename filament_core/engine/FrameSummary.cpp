// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameSummary.h"

#include "base/Result.h"
#include "framegraph/Explain.h"

namespace filament::engine {

FrameSummary summarize(uint64_t frame, prepare::FramePacket const& packet, framegraph::CompiledGraph const& plan) {
    prepare::PacketCounts const& counts = packet.counts;
    const auto passesRun = static_cast<uint32_t>(plan.order.size());
    const FrameStatistics statistics{ .frame = frame,
                                      .renderables = counts.renderables,
                                      .visible = counts.visible,
                                      .culled = counts.renderables - counts.visible,
                                      .draws = static_cast<uint32_t>(packet.opaque.size() + packet.blended.size()) +
                                               (packet.sky ? 1 : 0),
                                      .triangles = static_cast<uint32_t>(counts.triangles),
                                      .lights = counts.lights + (counts.suns ? 1 : 0),
                                      .passesRun = passesRun,
                                      .passesCulled = static_cast<uint32_t>(plan.passes.size()) - passesRun };
    return { statistics, counts, static_cast<bool>(packet.sky), static_cast<bool>(packet.specular) };
}

std::string explain(FrameSummary const& summary, framegraph::CompiledGraph const& plan) {
    prepare::PacketCounts const& counts = summary.counts;
    std::string text =
            fmt::format("frame {}: {} of {} renderables drawn, {} triangles in {} draws\n", summary.statistics.frame,
                        counts.visible, counts.renderables, counts.triangles, summary.statistics.draws);
    if (counts.outOfView) text += fmt::format("  {} not drawn: their boxes are out of view\n", counts.outOfView);
    if (counts.nothingToDraw) text += fmt::format("  {} not drawn: they have no indices\n", counts.nothingToDraw);
    text += counts.suns ? fmt::format("sun: shaded{}\n", counts.suns > 1 ? ", the brightest of several" : "")
                        : "sun: not in the shaders, the scene has none\n";
    text += counts.lights ? fmt::format("punctual lights: {} reach the view, {} do not, {} beyond the limit\n",
                                        counts.lights, counts.lightsOutOfView, counts.lightsOverLimit)
                          : fmt::format("punctual lights: not in the shaders, none reaches the view ({} do not)\n",
                                        counts.lightsOutOfView);
    text += summary.hasIndirectLight ? "indirect light: from the environment\n"
                                     : "indirect light: none, the scene has no environment\n";
    text += summary.hasSky ? "sky: drawn where nothing covers it\n" : "sky: not drawn, the scene has none\n";
    if (plan.graph) text += framegraph::toText(plan);
    return text;
}

} // namespace filament::engine
