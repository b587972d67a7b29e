// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameSummary.h"

#include "base/Result.h"
#include "framegraph/Explain.h"
#include "framegraph/Memory.h"

#include <algorithm>
#include <cmath>

namespace filament_core::engine {

namespace {

void add(FrameSummary::Totals& totals, prepare::ViewPacket const& view) {
    ++totals.views;
    totals.visible += view.counts.visible;
    totals.occluded += view.counts.occluded;
    totals.draws += static_cast<uint32_t>(view.opaque.size() + view.blended.size());
    totals.triangles += view.counts.triangles;
}

constexpr std::array<const char*, prepare::kViewKinds> kKindNames{ "color", "depth", "shadow", "motion" };

/// Timers are of groups, in their order: the first pass of a group has its time. Groups may have one name.
double millisecondsOf(framegraph::CompiledGraph const& plan, size_t pass, std::span<const PassTiming> times) {
    framegraph::PassDecision const& decision = plan.passes[pass];
    if (!decision.runs() || plan.order[plan.groups[decision.group].first] != pass) return 0;
    const auto isAlike = [name = plan.groups[decision.group].name](auto const& one) { return one.name == name; };
    auto before = std::count_if(plan.groups.begin(), plan.groups.begin() + decision.group, isAlike);
    for (PassTiming const& time : times) {
        if (isAlike(time) && before-- == 0) return time.gpuMilliseconds;
    }
    return 0;
}

std::string table(std::vector<EffectDecision> const& decisions) {
    std::string text =
            fmt::format("{:<22}{:<12}{:>10}{:>10}  {}\n", "effect or pass", "state", "device ms", "MB", "why");
    for (EffectDecision const& one : decisions) {
        const std::string time = one.gpuMilliseconds > 0 ? fmt::format("{:.2f}", one.gpuMilliseconds) : "";
        const std::string size =
                one.attachmentBytes > 0 ? fmt::format("{:.2f}", static_cast<double>(one.attachmentBytes) * 1e-6) : "";
        text += fmt::format("{:<22}{:<12}{:>10}{:>10}  {}\n", one.name, toString(one.state), time, size, one.reason);
    }
    return text;
}

} // namespace

FrameSummary summarize(uint64_t frame, prepare::FramePacket const& packet, framegraph::CompiledGraph const& plan) {
    FrameSummary summary{ .counts = packet.mainView().counts,
                          .demand = packet.demand,
                          .size = packet.settings.size,
                          .covered = { packet.covered.width, packet.covered.height } };
    add(summary.main, packet.mainView());
    summary.main.draws += summary.demand.needs(prepare::Effect::Sky) ? 1 : 0;
    summary.main.draws += static_cast<uint32_t>(packet.discs.size());
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

namespace {

std::string explainFroxels(prepare::ViewCounts const& counts) {
    if (counts.froxels == 0) return {};
    std::string text = fmt::format("froxels: {} with {} entries, {} lights in the longest list\n", counts.froxels,
                                   counts.froxelEntries, counts.longestFroxel);
    if (counts.fullFroxels)
        text += fmt::format("  {} are full: {} lights left out of them, the dimmest of each\n", counts.fullFroxels,
                            counts.lightsLeftOut);
    return text;
}

} // namespace

std::vector<EffectDecision> decisions(FrameSummary const& summary, framegraph::CompiledGraph const& plan,
                                      std::span<const PassTiming> times) {
    std::vector<EffectDecision> all;
    for (size_t i = 0; i < prepare::kEffects; ++i) {
        const auto effect = static_cast<prepare::Effect>(i);
        prepare::EffectDemand const& demand = summary.demand.of(effect);
        if (effect == prepare::Effect::DebugView && !demand.isNeeded) continue; // a tool's: no news
        all.push_back({ .name = nameOf(effect),
                        .state = demand.isNeeded ? EffectDecision::State::Needed : EffectDecision::State::NotNeeded,
                        .reason = describe(effect, demand) });
    }
    for (size_t pass = 0; pass < plan.passes.size(); ++pass) {
        const bool runs = plan.passes[pass].runs();
        all.push_back({ .name = std::string(plan.graph->passes()[pass].name),
                        .state = runs ? EffectDecision::State::Ran : EffectDecision::State::Culled,
                        .reason = framegraph::describePass(plan, pass),
                        .gpuMilliseconds = millisecondsOf(plan, pass, times),
                        .attachmentBytes = framegraph::attachmentBytes(plan, pass) });
    }
    return all;
}

std::string explain(FrameSummary const& summary, framegraph::CompiledGraph const& plan,
                    std::span<const PassTiming> times) {
    prepare::ViewCounts const& counts = summary.counts;
    std::string text =
            fmt::format("frame {}: {} of {} renderables drawn, {} triangles in {} draws\n", summary.statistics.frame,
                        counts.visible, counts.renderables, counts.triangles, summary.main.draws);
    if (counts.trianglesSaved) text += fmt::format("  {} triangles saved by levels of detail\n", counts.trianglesSaved);
    if (counts.outOfView) text += fmt::format("  {} not drawn: their boxes are out of view\n", counts.outOfView);
    if (counts.tooSmall) text += fmt::format("  {} not drawn: they cover no centre of a pixel\n", counts.tooSmall);
    if (counts.occluded) text += fmt::format("  {} not drawn: they are behind others\n", counts.occluded);
    if (counts.nothingToDraw)
        text += fmt::format("  {} not drawn: they have no indices or no layer\n", counts.nothingToDraw);
    if (counts.inOtherLayers)
        text += fmt::format("  {} not drawn: the view hides their layers\n", counts.inOtherLayers);
    text += explainFroxels(counts);
    if (summary.covered != summary.size)
        text += fmt::format("objects are within {} x {} of {} x {} pixels, by their boxes\n", summary.covered.x,
                            summary.covered.y, summary.size.x, summary.size.y);
    for (size_t kind = 0; kind < summary.others.size(); ++kind) {
        FrameSummary::Totals const& others = summary.others[kind];
        if (others.views == 0) continue;
        text += fmt::format("{} {} view{} besides: {} renderables drawn, {} triangles in {} draws\n", others.views,
                            kKindNames[kind], others.views > 1 ? "s" : "", others.visible, others.triangles,
                            others.draws);
        if (others.occluded) text += fmt::format("  {} not drawn: they are behind others\n", others.occluded);
    }
    text += table(decisions(summary, plan, times));
    if (plan.graph) text += framegraph::toText(plan);
    return text;
}

void keepProbes(scene::Probes const& probes, prepare::ProbePacket const& packet, std::vector<ProbeLine>& lines) {
    lines.resize(packet.uses.size());
    for (size_t i = 0; i < lines.size(); ++i) {
        lines[i].name = probes.records[i].name; // keeps its memory
        lines[i].use = packet.uses[i];
    }
}

std::string explainProbes(std::span<const ProbeLine> lines) {
    constexpr std::array<const char*, 6> kWords{
        "used",
        "not used: its box reaches no lit surface in view",
        "not used: others in view are nearer",
        "not used: its cube has another size, format, mapping or number of levels than the environment's",
        "not used: cubes of the environment's format cannot be copied; RGBA16F and RGBM can",
        "not used: the device lacks arrays of cubes",
    };
    std::string text;
    for (size_t i = 0; i < lines.size(); ++i) {
        const std::string name = lines[i].name.empty() ? fmt::format("{}", i) : fmt::format("'{}'", lines[i].name);
        text += fmt::format("reflection probe {}: {}\n", name, kWords[static_cast<size_t>(lines[i].use)]);
    }
    return text;
}

namespace {

GridLines::Line lineOf(scene::GridRecord const& grid, bool isInView) {
    GridLines::Line line{ .name = grid.name, .count = grid.probes->count, .isInView = isInView };
    double squares = 0, mean = 0;
    for (IrradianceProbe const& probe : grid.probes->probes) {
        line.inside += probe.isInside ? 1 : 0;
        if (probe.isInside) continue;
        squares += double{ probe.standardError } * double{ probe.standardError };
        mean += double{ glm::dot(probe.irradianceSh[0], float3(0.2126f, 0.7152f, 0.0722f)) };
    }
    const auto lit = static_cast<double>(grid.probes->probes.size() - line.inside);
    line.standardError = mean > 0 ? static_cast<float>(std::sqrt(squares / lit) / (mean / lit)) : 0.0f;
    return line;
}

} // namespace

void keepGrids(scene::SceneData const& scene, prepare::GridPacket const& packet, GridLines& lines) {
    scene::Grids const& grids = scene.grids;
    // What it says of probes is found once: grids seldom change.
    if (lines.scene != scene.serial || lines.changes != grids.changes) {
        lines.grids.clear();
        for (scene::GridRecord const& grid : grids.records) lines.grids.push_back(lineOf(grid, false));
        lines.scene = scene.serial;
        lines.changes = grids.changes;
    }
    for (size_t i = 0; i < lines.grids.size(); ++i)
        lines.grids[i].isInView = !packet.inView.empty() && packet.inView[i] != 0;
    lines.fields = static_cast<uint32_t>(packet.fields.size());
    lines.evaluated = packet.evaluated;
    lines.largestError = packet.largestError;
}

std::string explainGrids(GridLines const& lines) {
    std::string text;
    for (size_t i = 0; i < lines.grids.size(); ++i) {
        GridLines::Line const& grid = lines.grids[i];
        const std::string name = grid.name.empty() ? fmt::format("{}", i) : fmt::format("'{}'", grid.name);
        text += fmt::format(
                "irradiance grid {}: {}; {} x {} x {} probes, {} of them inside of geometry; standard error "
                "{:.2f} %\n",
                name, grid.isInView ? "used" : "not used: its box is out of view", grid.count.x, grid.count.y,
                grid.count.z, grid.inside, 100 * grid.standardError);
    }
    if (lines.fields > 0)
        text += fmt::format(
                "irradiance fields: {} objects, {} of them evaluated in this frame; the field that describes "
                "its box worst is {:.1f} % off\n",
                lines.fields, lines.evaluated, 100 * lines.largestError);
    return text;
}

} // namespace filament_core::engine

namespace filament_core {} // namespace filament_core
