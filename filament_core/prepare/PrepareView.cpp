// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareView.h"

#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/Froxels.h"
#include "filament_core/prepare/LightChannels.h"
#include "filament_core/prepare/PlaceImages.h"
#include "filament_core/prepare/PlaceProfiles.h"
#include "filament_core/prepare/PrefetchDraws.h"
#include "filament_core/prepare/SceneColorLayers.h"
#include "filament_core/prepare/SelectLights.h"
#include "filament_core/prepare/SortItems.h"
#include "filament_core/prepare/ViewConstants.h"

#include <algorithm>
#include <bit>

namespace filament_core::prepare {
namespace {

// With fewer, waking a worker takes longer than the work.
constexpr size_t kLightsWorthAJob = 256;

scene::Lights const& lightsFor(ViewKind kind, scene::SceneData const& scene) {
    static const scene::Lights kNone;
    return isShaded(kind) ? scene.lights : kNone;
}

/// Of one list.
struct DrawTally {
    uint32_t lit = 0, refractive = 0, reflective = 0, stencil = 0;
};

DrawTally tallyOf(std::span<const DrawCall> draws) {
    DrawTally tally;
    for (size_t i = 0; i < draws.size(); ++i) {
        prefetchDraw(draws, i);
        scene::Material const& material = *draws[i].material->material;
        tally.lit += material.isLit();
        tally.refractive += material.package.refractionMode == shader::RefractionMode::ScreenSpace;
        tally.reflective += material.package.reflections == shader::Reflections::ScreenSpace;
        tally.stencil += draws[i].material->raster.stencil.has_value();
    }
    return tally;
}

void countDraws(DrawLists const& draws, ViewCounts& counts) {
    const DrawTally opaque = tallyOf(draws.opaque), blended = tallyOf(draws.blended);
    counts.litDraws = opaque.lit + blended.lit;
    counts.blendedDraws = static_cast<uint32_t>(draws.blended.size());
    counts.opaqueDraws = static_cast<uint32_t>(draws.opaque.size());
    counts.opaqueLitDraws = opaque.lit;
    counts.refractiveDraws = opaque.refractive + blended.refractive;
    counts.reflectiveDraws = opaque.reflective + blended.reflective;
    counts.stencilDraws = opaque.stencil + blended.stencil;
}

/// Light that meets no lit surface is in no shader.
uint8_t variantFor(ViewCounts const& counts) {
    if (counts.litDraws == 0) return 0;
    return static_cast<uint8_t>((counts.suns > counts.sunsOfOtherChannels ? shader::kVariantSun : 0) |
                                (counts.lights ? shader::kVariantPunctual : 0));
}

/// The items to draw, in order; a view without light omits blended and late ones.
std::span<const SortItem> drawnItems(std::span<const SortItem> sorted, ViewKind kind, ViewCounts& counts) {
    if (isShaded(kind)) return sorted;
    const std::span<const SortItem> solid = itemsBefore(sorted, kLateKey);
    counts.blendedLeftOut = static_cast<uint32_t>(sorted.size() - solid.size());
    counts.visible -= counts.blendedLeftOut;
    return solid;
}

RefractionOrder refractionOrder(ViewKind kind, Quality const& quality) {
    if (!isShaded(kind) || quality.refraction != RefractionSource::Screen) return RefractionOrder::Any;
    return quality.refractionLayers > 1 ? RefractionOrder::BackToFront : RefractionOrder::FrontToBack;
}

/// Looks for what may be composed in any order only where that is asked for.
AnyOrderExtent anyOrderIn(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables, bool isAsked,
                          VisibleItems const& visible) {
    return isAsked ? findAnyOrder(jobs, arena, drawables, visible) : AnyOrderExtent{};
}

AnyOrderDraws anyOrderDraws(std::span<const SortItem> order, std::span<const DrawCall> blended, uint32_t nearest) {
    return { .first = static_cast<uint32_t>(drawsBefore(blended, itemsBefore(order, kAnyOrderKey).size())),
             .end = static_cast<uint32_t>(drawsBefore(blended, itemsBefore(order, kAnyOrderEndKey).size())),
             .nearestMeters = nearest == ~0u ? 1 : std::bit_cast<float>(nearest) };
}

} // namespace

PreparedView prepareView(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                         FrameSettings const& settings, LevelChoice const& levels) {
    PreparedView prepared;
    ViewPacket& packet = prepared.packet;
    packet.kind = view.kind;
    const ViewSpace space = makeViewSpace(view);
    writeFrameUniforms(packet.uniforms, space, view, scene);
    scene::Lights const& lights = lightsFor(view.kind, scene);
    const LightSelector selector(arena, lights);
    uint8_t lightsInCommon = 0xFF;
    const auto selectLights = [&] {
        const SelectedLights selected = selector.select(space, packet.uniforms, packet.counts);
        packet.lights = selected.lights;
        prepared.lightRecords = selected.records;
        prepared.sunRecord = selected.sun;
        lightsInCommon = selected.channelsInCommon;
    };
    // Lights are selected while renderables are culled: neither reads what the other writes.
    jobs::JobGroup besideCulling(jobs);
    if (lights.records.size() < kLightsWorthAJob)
        selectLights();
    else
        besideCulling.run<"lights">(selectLights);

    scene::Renderables const& renderables = scene.renderables;
    prepared.visible = cullRenderables(jobs, arena, renderables, space, view.kind, packet.counts, levels);
    const RefractionOrder refraction = refractionOrder(view.kind, settings.quality);
    const AnyOrderExtent any = anyOrderIn(jobs, arena, renderables.drawables,
                                          isShaded(view.kind) && settings.composesAnyOrder, prepared.visible);
    const bool composes = overlaps(any.count);
    packet.counts.anyOrderObjects = any.count;
    const std::span<SortItem> items = writeKeys(jobs, arena, renderables, prepared.visible, levels,
                                                { view.kind, refraction, composes, any.farthest });
    const std::span<const SortItem> order = drawnItems(sortItems(jobs, arena, items), view.kind, packet.counts);
    const DrawLists draws = mergeInstances(jobs, arena, renderables, order, packet.counts);
    besideCulling.wait(); // from here on both are needed: which lights meet which lit draws

    packet.opaque = draws.opaque;
    packet.blended = draws.blended;
    if (composes) packet.anyOrder = anyOrderDraws(order, packet.blended, any.nearest);
    packet.uniforms.jitter.z = packet.anyOrder.nearestMeters;
    if (isShaded(view.kind)) countDraws(draws, packet.counts);
    // Copies of the scene colour are planned by the counts above: without a refractive draw there are none.
    if (refraction != RefractionOrder::Any && packet.counts.refractiveDraws > 0)
        packet.pictures = sceneColorLayers(arena, renderables, order, packet.blended, space, view.size,
                                           settings.quality.refractionLayers);
    // Lights are dropped before the variant, profiles and froxels follow from those that are left.
    const DrawnChannels drawn = isShaded(view.kind) ? channelsOf(packet) : DrawnChannels{};
    prepared.hasChannels = packet.counts.litDraws > 0 && (drawn.inCommon & lightsInCommon) == 0;
    const bool lightsFog = isShaded(view.kind) && settings.lightsFog; // which lights of all channels do
    if (prepared.hasChannels && !lightsFog) dropUnseenLights(arena, lights, drawn.any, prepared);
    packet.variant = variantFor(packet.counts);
    if ((packet.variant & shader::kVariantPunctual) == 0 && !lightsFog) {
        packet.lights = {};
        prepared.lightRecords = {};
    }
    packet.hasAreaLights = !packet.lights.empty() && packet.counts.areaLights > 0;
    if (!packet.lights.empty() && packet.counts.profiledLights > 0)
        placeProfiles(arena, lights, prepared.lightRecords, packet);
    if (!packet.lights.empty() && packet.counts.imagedLights > 0)
        placeImages(arena, lights, prepared.lightRecords, space.cameraWorld, packet);
    // After the last change of the list of lights, because froxels hold indices into it.
    packet.froxels = assignLights(jobs, arena, space, view.size, packet.lights, packet.uniforms, packet.counts);
    packet.objects = { order, renderables.placement, settings.quality.cameraRelative ? space.cameraWorld : double3(0.0),
                       renderables.deformation };
    return prepared;
}

} // namespace filament_core::prepare
