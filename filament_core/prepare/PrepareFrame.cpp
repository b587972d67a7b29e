// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/SelectLights.h"
#include "filament_core/prepare/SortItems.h"
#include "filament_core/prepare/ViewConstants.h"

namespace filament::prepare {
namespace {

// Fewer take less time than waking a worker for them.
constexpr size_t kLightsWorthAJob = 256;

uint8_t variantFor(PacketCounts const& counts) {
    return static_cast<uint8_t>((counts.suns ? shader::kVariantSun : 0) |
                                (counts.lights ? shader::kVariantPunctual : 0));
}

} // namespace

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view) {
    FramePacket packet;
    const ViewSpace space = makeViewSpace(view);
    writeFrameUniforms(packet.frame, space, view, scene);
    const LightSelector lights(arena, scene.lights);
    const auto selectLights = [&] { packet.lights = lights.select(space, packet.frame, packet.counts); };
    jobs::JobGroup besideCulling(jobs);
    if (scene.lights.records.size() < kLightsWorthAJob)
        selectLights();
    else
        besideCulling.run<"lights">(selectLights);

    scene::Renderables const& renderables = scene.renderables;
    const VisibleItems visible = cullRenderables(jobs, arena, renderables, space, packet.counts);
    const std::span<SortItem> items = writeKeys(jobs, arena, renderables.drawables, visible);
    const std::span<const SortItem> order = sortItems(jobs, arena, items);
    const DrawLists draws = mergeInstances(jobs, arena, renderables.drawables, order, packet.counts);
    besideCulling.wait();

    packet.variant = variantFor(packet.counts);
    packet.objects = { order, renderables.placement, view.quality.cameraRelative ? space.cameraWorld : double3(0.0) };
    packet.deformations = placeDeformations(arena, scene, visible);
    packet.opaque = draws.opaque;
    packet.blended = draws.blended;
    packet.specular = scene.indirectLight.specular;
    packet.irradiance = scene.indirectLight.irradiance;
    packet.environment = scene.indirectLight.storage;
    packet.sky = scene.skybox.cube;
    packet.skyIsRgbm = scene.skybox.isRgbm;
    return packet;
}

} // namespace filament::prepare
