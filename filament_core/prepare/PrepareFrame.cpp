// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/PrepareView.h"

#include <algorithm>

namespace filament::prepare {
namespace {

EnvironmentPacket environmentOf(scene::SceneData const& scene) {
    return { .specular = scene.indirectLight.specular,
             .irradiance = scene.indirectLight.irradiance,
             .sky = scene.skybox.cube,
             .storage = scene.indirectLight.storage,
             .skyIsRgbm = scene.skybox.isRgbm };
}

uint32_t countDeformed(DeformationList const& list) {
    return static_cast<uint32_t>(std::ranges::count_if(list.places, [](DeformationPlace const& place) {
        return place.bones != kNowhere || place.weights != kNowhere;
    }));
}

SceneDemand demandOf(FramePacket const& packet) {
    return findDemand({ .counts = packet.mainView().counts,
                        .hasIndirectLight = static_cast<bool>(packet.environment.specular),
                        .hasSky = static_cast<bool>(packet.environment.sky),
                        .deformed = countDeformed(packet.deformations) });
}

} // namespace

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                         std::span<const ViewInput> views) {
    FILAMENT_ASSERT(!views.empty(), "a frame has a main view");
    const auto packets = arena.arrayForOverwrite<ViewPacket>(views.size());
    const auto visible = arena.arrayForOverwrite<VisibleItems>(views.size());
    for (size_t i = 0; i < views.size(); ++i) {
        PreparedView prepared = prepareView(jobs, arena, scene, views[i]);
        packets[i] = prepared.packet;
        visible[i] = prepared.visible;
    }
    FramePacket packet{ packets, placeDeformations(arena, scene, visible), environmentOf(scene), {} };
    packet.demand = demandOf(packet);
    return packet;
}

} // namespace filament::prepare
