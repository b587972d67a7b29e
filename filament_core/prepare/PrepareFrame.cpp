// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/LightChannels.h"
#include "filament_core/prepare/PrepareMotion.h"
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

uint32_t movedObjects(FramePacket const& packet) {
    return packet.motionView == kNowhere ? 0 : static_cast<uint32_t>(packet.views[packet.motionView].opaque.size());
}

SceneDemand demandOf(FramePacket const& packet, ShadowCounts const& shadows, ViewInput const& view) {
    return findDemand({ .counts = packet.mainView().counts,
                        .shadows = shadows,
                        .hasIndirectLight = static_cast<bool>(packet.environment.specular),
                        .hasSky = static_cast<bool>(packet.environment.sky),
                        .deformed = countDeformed(packet.deformations),
                        .copiedPixels = copiedPixels(packet.mainView().pictures),
                        .moved = movedObjects(packet),
                        .quality = view.quality,
                        .fog = packet.effects.fog,
                        .bloom = packet.effects.bloom,
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

/// Those that were asked for, and those of shadow maps.
struct FrameViews {
    std::span<const PreparedView> asked, ofShadows;

    size_t size() const { return asked.size() + ofShadows.size(); }
    PreparedView const& operator[](size_t i) const { return i < asked.size() ? asked[i] : ofShadows[i - asked.size()]; }
};

FramePacket packetOf(Arena& arena, scene::SceneData const& scene, FrameViews const& views) {
    const auto packets = arena.arrayForOverwrite<ViewPacket>(views.size());
    const auto visible = arena.arrayForOverwrite<VisibleItems>(views.size());
    for (size_t i = 0; i < views.size(); ++i) {
        packets[i] = views[i].packet;
        visible[i] = views[i].visible;
    }
    return { .views = packets, .deformations = placeDeformations(arena, scene, visible) };
}

void addMotion(Arena& arena, scene::SceneData const& scene, LastFrame const& last, FramePacket& packet) {
    const PreparedMotion motion = prepareMotion(arena, scene, packet.mainView(), last, packet.last);
    if (motion.view.opaque.empty()) return;
    const auto views = arena.arrayForOverwrite<ViewPacket>(packet.views.size() + 1);
    std::ranges::copy(packet.views, views.begin());
    views.back() = motion.view;
    packet.motionView = static_cast<uint32_t>(packet.views.size());
    packet.views = views;
    placeLastDeformations(arena, scene, motion.slots, last, packet.deformations);
}

} // namespace

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                         std::span<const ViewInput> views, ShadowAtlas const& held, LastFrame const& last) {
    FILAMENT_ASSERT(!views.empty(), "a frame has a main view");
    ViewInput const& main = views[0];
    const auto asked = arena.arrayForOverwrite<PreparedView>(views.size());
    for (size_t i = 0; i < views.size(); ++i) asked[i] = prepareView(jobs, arena, scene, views[i]);
    const PreparedShadows shadows = prepareShadows(jobs, arena, scene, main, asked[0], held);

    for (size_t i = 0; i < views.size(); ++i) separateChannels(jobs, arena, scene.lights, views[i], asked[i]);
    FramePacket packet = packetOf(arena, scene, { asked, shadows.views });
    packet.shadows = behindViews(arena, shadows.packet, static_cast<uint32_t>(asked.size()));
    packet.environment = environmentOf(scene);
    packet.effects = main.effects;
    packet.last = last.seenFrom(makeViewSpace(main), packet.mainView().uniforms.time);
    if (readsMotion(packet.mainView().counts, main.quality, main.debugView)) addMotion(arena, scene, last, packet);
    const SunDiscs discs = findSunDiscs(arena, scene.lights, main);
    packet.discs = discs.inView;
    packet.discsOutOfView = discs.outOfView;
    packet.demand = demandOf(packet, shadows.counts, main);
    return packet;
}

} // namespace filament::prepare
