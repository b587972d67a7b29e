// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareView.h"

#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/Froxels.h"
#include "filament_core/prepare/SelectLights.h"
#include "filament_core/prepare/SortItems.h"
#include "filament_core/prepare/ViewConstants.h"

#include <algorithm>

namespace filament::prepare {
namespace {

// With fewer, waking a worker takes longer than the work.
constexpr size_t kLightsWorthAJob = 256;

scene::Lights const& lightsFor(ViewKind kind, scene::SceneData const& scene) {
    static const scene::Lights kNone;
    return isShaded(kind) ? scene.lights : kNone;
}

uint32_t countLit(std::span<const DrawCall> draws) {
    return static_cast<uint32_t>(std::ranges::count_if(draws, [](DrawCall const& draw) {
        return draw.material->material->package.shading != shader::ShadingModel::Unlit;
    }));
}

void countDraws(DrawLists const& draws, ViewCounts& counts) {
    counts.litDraws = countLit(draws.opaque) + countLit(draws.blended);
    counts.blendedDraws = static_cast<uint32_t>(draws.blended.size());
}

/// Light that meets no lit surface is in no shader.
uint8_t variantFor(ViewCounts const& counts) {
    if (counts.litDraws == 0) return 0;
    return static_cast<uint8_t>((counts.suns ? shader::kVariantSun : 0) |
                                (counts.lights ? shader::kVariantPunctual : 0));
}

/// The items to draw, in order; a view without light omits blended and late ones.
std::span<const SortItem> drawnItems(std::span<const SortItem> sorted, ViewKind kind, ViewCounts& counts) {
    if (isShaded(kind)) return sorted;
    const std::span<const SortItem> solid = beforeSky(sorted);
    counts.blendedLeftOut = static_cast<uint32_t>(sorted.size() - solid.size());
    counts.visible -= counts.blendedLeftOut;
    return solid;
}

} // namespace

PreparedView prepareView(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view) {
    PreparedView prepared;
    ViewPacket& packet = prepared.packet;
    packet.kind = view.kind;
    const ViewSpace space = makeViewSpace(view);
    writeFrameUniforms(packet.uniforms, space, view, scene);
    scene::Lights const& lights = lightsFor(view.kind, scene);
    const LightSelector selector(arena, lights);
    const auto selectLights = [&] { packet.lights = selector.select(space, packet.uniforms, packet.counts); };
    jobs::JobGroup besideCulling(jobs);
    if (lights.records.size() < kLightsWorthAJob)
        selectLights();
    else
        besideCulling.run<"lights">(selectLights);

    scene::Renderables const& renderables = scene.renderables;
    prepared.visible = cullRenderables(jobs, arena, renderables, space, packet.counts);
    const std::span<SortItem> items = writeKeys(jobs, arena, renderables.drawables, prepared.visible, view.kind);
    const std::span<const SortItem> order = drawnItems(sortItems(jobs, arena, items), view.kind, packet.counts);
    const DrawLists draws = mergeInstances(jobs, arena, renderables.drawables, order, packet.counts);
    besideCulling.wait();

    if (isShaded(view.kind)) countDraws(draws, packet.counts);
    packet.variant = variantFor(packet.counts);
    if ((packet.variant & shader::kVariantPunctual) == 0) packet.lights = {};
    packet.froxels = assignLights(jobs, arena, space, view.size, packet.lights, packet.uniforms, packet.counts);
    packet.objects = { order, renderables.placement, view.quality.cameraRelative ? space.cameraWorld : double3(0.0) };
    packet.opaque = draws.opaque;
    packet.blended = draws.blended;
    return prepared;
}

} // namespace filament::prepare
