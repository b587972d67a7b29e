// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/LightChannels.h"
#include "filament_core/prepare/PrepareShadows.h"
#include "filament_core/prepare/PrepareView.h"
#include "filament_core/prepare/SunDiscs.h"

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

uint32_t copiedPixels(std::span<const PictureCopy> pictures) {
    uint32_t pixels = 0;
    for (PictureCopy const& copy : pictures) pixels += copy.pixels();
    return pixels;
}

uint32_t cascadesOf(ShadowPacket const& shadows) {
    return shadows.uniforms ? static_cast<uint32_t>(shadows.uniforms->sun.y) : 0;
}

SceneDemand demandOf(FramePacket const& packet, ShadowCounts const& shadows, ViewInput const& view) {
    return findDemand({ .counts = packet.mainView().counts,
                        .shadows = shadows,
                        .hasIndirectLight = static_cast<bool>(packet.environment.specular),
                        .hasSky = static_cast<bool>(packet.environment.sky),
                        .deformed = countDeformed(packet.deformations),
                        .copiedPixels = copiedPixels(packet.mainView().pictures),
                        .quality = view.quality,
                        .fog = packet.effects.fog,
                        .ambientOcclusion = packet.effects.ambientOcclusion,
                        .debugView = view.debugView,
                        .cascades = cascadesOf(packet.shadows),
                        .atlasSize = packet.shadows.atlasSize,
                        .discsInView = static_cast<uint32_t>(packet.discs.size()),
                        .discsOutOfView = packet.discsOutOfView });
}

/// The views of the maps follow those that were asked for.
ShadowPacket behindViews(Arena& arena, ShadowPacket shadows, uint32_t views) {
    const std::span<ShadowMapPacket> maps = arena.copy(shadows.maps);
    for (ShadowMapPacket& map : maps) {
        if (map.view != kKeptMap) map.view += views;
    }
    shadows.maps = maps;
    return shadows;
}

} // namespace

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                         std::span<const ViewInput> views, ShadowAtlas const& held) {
    FILAMENT_ASSERT(!views.empty(), "a frame has a main view");
    const auto asked = arena.arrayForOverwrite<PreparedView>(views.size());
    for (size_t i = 0; i < views.size(); ++i) asked[i] = prepareView(jobs, arena, scene, views[i]);
    const PreparedShadows shadows = prepareShadows(jobs, arena, scene, views[0], asked[0], held);

    for (size_t i = 0; i < views.size(); ++i) separateChannels(jobs, arena, scene.lights, views[i], asked[i]);
    const size_t count = asked.size() + shadows.views.size();
    const auto packets = arena.arrayForOverwrite<ViewPacket>(count);
    const auto visible = arena.arrayForOverwrite<VisibleItems>(count);
    for (size_t i = 0; i < count; ++i) {
        PreparedView const& prepared = i < asked.size() ? asked[i] : shadows.views[i - asked.size()];
        packets[i] = prepared.packet;
        visible[i] = prepared.visible;
    }
    FramePacket packet{ .views = packets,
                        .deformations = placeDeformations(arena, scene, visible),
                        .shadows = behindViews(arena, shadows.packet, static_cast<uint32_t>(asked.size())),
                        .environment = environmentOf(scene),
                        .effects = views[0].effects };
    const SunDiscs discs = findSunDiscs(arena, scene.lights, views[0]);
    packet.discs = discs.inView;
    packet.discsOutOfView = discs.outOfView;
    packet.demand = demandOf(packet, shadows.counts, views[0]);
    return packet;
}

} // namespace filament::prepare
