// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameSummary.h"

#include "base/Result.h"
#include "framegraph/Explain.h"

namespace filament::engine {

namespace {

void add(FrameSummary::Totals& totals, prepare::ViewPacket const& view) {
    ++totals.views;
    totals.visible += view.counts.visible;
    totals.draws += static_cast<uint32_t>(view.opaque.size() + view.blended.size());
    totals.triangles += view.counts.triangles;
}

constexpr std::array<const char*, prepare::kViewKinds> kKindNames{ "color", "depth", "shadow" };

} // namespace

FrameSummary summarize(uint64_t frame, prepare::FramePacket const& packet, framegraph::CompiledGraph const& plan) {
    FrameSummary summary{ .counts = packet.mainView().counts,
                          .hasSky = static_cast<bool>(packet.environment.sky),
                          .hasIndirectLight = static_cast<bool>(packet.environment.specular) };
    add(summary.main, packet.mainView());
    summary.main.draws += summary.hasSky ? 1 : 0;
    FrameSummary::Totals all = summary.main;
    for (prepare::ViewPacket const& view : packet.views.subspan(1)) {
        add(summary.others[static_cast<size_t>(view.kind)], view);
        add(all, view);
    }
    prepare::ViewCounts const& counts = summary.counts;
    const auto passesRun = static_cast<uint32_t>(plan.order.size());
    summary.statistics = { .frame = frame,
                           .renderables = counts.renderables,
                           .visible = counts.visible,
                           .culled = counts.renderables - counts.visible,
                           .draws = all.draws,
                           .triangles = static_cast<uint32_t>(all.triangles),
                           .lights = counts.lights + (counts.suns ? 1 : 0),
                           .passesRun = passesRun,
                           .passesCulled = static_cast<uint32_t>(plan.passes.size()) - passesRun };
    return summary;
}

std::string explain(FrameSummary const& summary, framegraph::CompiledGraph const& plan) {
    prepare::ViewCounts const& counts = summary.counts;
    std::string text =
            fmt::format("frame {}: {} of {} renderables drawn, {} triangles in {} draws\n", summary.statistics.frame,
                        counts.visible, counts.renderables, counts.triangles, summary.main.draws);
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
    for (size_t kind = 0; kind < summary.others.size(); ++kind) {
        FrameSummary::Totals const& others = summary.others[kind];
        if (others.views == 0) continue;
        text += fmt::format("{} {} view{} besides: {} renderables drawn, {} triangles in {} draws\n", others.views,
                            kKindNames[kind], others.views > 1 ? "s" : "", others.visible, others.triangles,
                            others.draws);
    }
    if (plan.graph) text += framegraph::toText(plan);
    return text;
}

} // namespace filament::engine
