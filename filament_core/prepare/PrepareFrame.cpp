// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/CoveredPixels.h"
#include "filament_core/prepare/DarkLights.h"
#include "filament_core/prepare/DebugViews.h"
#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/Focus.h"
#include "filament_core/prepare/HideOccluded.h"
#include "filament_core/prepare/LightChannels.h"
#include "filament_core/prepare/NumberObjects.h"
#include "filament_core/prepare/PlaceGrids.h"
#include "filament_core/prepare/PlaceProbes.h"
#include "filament_core/prepare/PrepareMotion.h"
#include "filament_core/prepare/PrepareShadows.h"
#include "filament_core/prepare/PrepareSplats.h"
#include "filament_core/prepare/PrepareView.h"
#include "filament_core/prepare/SunDiscs.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

EnvironmentPacket environmentOf(scene::SceneData const& scene, GridPacket const& grids) {
    scene::IndirectLightRecord const& light = scene.indirectLight;
    return { .specular = grids.isEnvironmentDark ? backend::TextureHandle{} : light.specular,
             .irradiance = grids.isEnvironmentDark ? backend::TextureHandle{} : light.irradiance,
             .sky = scene.skybox.cube,
             .storage = light.storage,
             .skyHasGround = scene.skybox.ground.heightMeters > 0,
             .skyIsRgbm = scene.skybox.isRgbm };
}

uint32_t countDeformed(DeformationList const& list) {
    return static_cast<uint32_t>(std::ranges::count_if(
            list.places, [](DeformationPlace const& place) { return place.now.begin != kNowhere; }));
}

uint32_t copiedPixels(std::span<const SceneColorCopy> pictures) {
    uint32_t pixels = 0;
    for (SceneColorCopy const& copy : pictures) pixels += copy.pixels();
    return pixels;
}

uint32_t cascadesOf(ShadowPacket const& shadows) {
    return shadows.uniforms ? static_cast<uint32_t>(shadows.uniforms->sun.y) : 0;
}

uint32_t movedObjects(FramePacket const& packet) {
    return packet.motionView == kNowhere ? 0 : packet.views[packet.motionView].counts.visible;
}

SceneDemand demandOf(scene::SceneData const& scene, FramePacket const& packet, ShadowCounts const& shadows,
                     float blurRadius) {
    return findDemand(
            { .counts = packet.mainView().counts,
              .shadows = shadows,
              .hasIndirectLight = packet.environment.specular || !packet.probes.empty() || packet.grids.used > 0,
              .hasSky = static_cast<bool>(packet.environment.sky),
              .deformed = countDeformed(packet.deformations),
              .copiedPixels = copiedPixels(packet.mainView().pictures),
              .moved = movedObjects(packet),
              .cameraMoved = packet.last.isElsewhere,
              .blurRadius = blurRadius,
              .settings = packet.settings,
              .cascades = cascadesOf(packet.shadows),
              .atlasSize = packet.shadows.atlasSize,
              .discsInView = static_cast<uint32_t>(packet.discs.size()),
              .discsOutOfView = packet.discsOutOfView,
              .splats = packet.splats.count(),
              .splatClouds = packet.splats.inScene,
              .probes = { .inScene = static_cast<uint32_t>(scene.probes.records.size()),
                          .used = packet.probes.used,
                          .outOfReach = packet.probes.outOfReach,
                          .leftOut = packet.probes.leftOut },
              .grids = { .inScene = static_cast<uint32_t>(scene.grids.records.size()),
                         .used = packet.grids.used,
                         .outOfReach = packet.grids.outOfReach } });
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

/// Of what is visible, in pixels.
float largestBlur(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                  FramePacket const& packet) {
    if (!packet.settings.effects.depthOfField.enabled) return 0;
    const bool hasFarthest = packet.environment.sky || !packet.discs.empty();
    const VisibleDistances at = visibleDistances(jobs, arena, scene, packet.mainView(), makeViewSpace(view));
    const double far = blurRadius(packet.focus, hasFarthest ? HUGE_VAL : std::max(at.farthest, at.nearest));
    return static_cast<float>(std::max(std::abs(blurRadius(packet.focus, at.nearest)), std::abs(far)));
}

/// Looked for only where an effect draws nothing beside them.
backend::Rect coveredPixelsIn(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                              FramePacket const& packet) {
    const bool accumulates = packet.demand.needs(Effect::Taa) && packet.demand.needs(Effect::DepthPrepass);
    const bool isAsked = packet.demand.needs(Effect::AmbientOcclusion) || packet.demand.needs(Effect::Fxaa) ||
                         packet.demand.needs(Effect::Sraa) || packet.demand.needs(Effect::MotionBlur) || accumulates;
    return isAsked ? coveredPixels(jobs, arena, scene, packet.mainView(), makeViewSpace(view), view.size)
                   : backend::Rect{ 0, 0, view.size.x, view.size.y };
}

/// As they are drawn.
std::span<const ViewInput> jittered(Arena& arena, scene::SceneData const& scene, std::span<const ViewInput> views,
                                    FrameSettings const& settings, LastFrame const& last) {
    const std::span<ViewInput> drawn = arena.copy(views);
    if (settings.accumulatesFrames) drawn[0].jitterPixels = last.jitterPixels(scene, settings);
    return drawn;
}

FramePacket packetOf(Arena& arena, scene::SceneData const& scene, FrameViews const& views) {
    const auto packets = arena.arrayForOverwrite<ViewPacket>(views.size());
    const auto visible = arena.arrayForOverwrite<VisibleItems>(views.size());
    for (size_t i = 0; i < views.size(); ++i) visible[i] = views[i].visible;
    const DeformationList deformations = placeDeformations(arena, scene, visible);
    for (size_t i = 0; i < views.size(); ++i) {
        packets[i] = views[i].packet;
        packets[i].objects.places = deformations.places;
    }
    return { .views = packets, .deformations = deformations };
}

/// A debug view hides them.
SplatPacket splatsOf(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                     FrameSettings const& settings) {
    if (scene.splats.empty() || settings.debugView != DebugView::None)
        return { .inScene = static_cast<uint32_t>(scene.splats.size()) };
    return prepareSplats(jobs, arena, scene, makeViewSpace(view), view.size);
}

ProbePacket probesOf(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                     HeldProbes const& held, ViewPacket& packet) {
    if (scene.probes.records.empty() || packet.counts.litDraws == 0 || view.quality.reflectionProbes == 0) return {};
    const std::span<const LitBox> lit = litBoxes(jobs, arena, scene.renderables, packet.objects);
    return placeProbes(jobs, arena, scene, view, held, lit, packet);
}

void addMotion(Arena& arena, scene::SceneData const& scene, LastFrame const& last, FramePacket& packet) {
    const PreparedMotion motion = prepareMotion(arena, scene, packet.mainView(), last, packet.last);
    if (motion.view.opaque.empty()) return;
    const auto views = arena.arrayForOverwrite<ViewPacket>(packet.views.size() + 1);
    std::ranges::copy(packet.views, views.begin());
    placeLastDeformations(arena, scene, motion.slots, last, packet.deformations);
    views.back() = motion.view;
    views.back().objects.places = packet.deformations.places;
    packet.motionView = static_cast<uint32_t>(packet.views.size());
    packet.views = views;
}

void hideFromMainView(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                      FramePacket& packet) {
    const std::span<ViewPacket> views = arena.copy(packet.views);
    hideOccluded(jobs, arena, scene.renderables, makeViewSpace(view), view, views[0]);
    packet.views = views;
}

} // namespace

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                         std::span<const ViewInput> views, ShadowAtlas const& held, LastFrame const& kept,
                         HeldProbes const& heldProbes, FieldCache* fields) {
    FILAMENT_ASSERT(!views.empty(), "a frame has a main view");
    ViewInput const& main = views[0]; // without jitter, so that shadow maps and places of the last frame stay
    const FrameSettings settings = resolve(main);
    static const LastFrame kNone;
    LastFrame const& last = kept.isFollowedBy(scene, settings) ? kept : kNone;
    const std::span<const ViewInput> drawn = jittered(arena, scene, views, settings, last);
    const auto asked = arena.arrayForOverwrite<PreparedView>(views.size());
    for (size_t i = 0; i < views.size(); ++i) {
        const LevelChoice levels(scene, drawn[i], i == 0 ? last.levels() : std::span<const DrawnLevel>{},
                                 i == 0 && settings.fadesLevels);
        asked[i] = prepareView(jobs, arena, scene, drawn[i], settings, levels);
    }
    // Shadows need the receivers of the main view, and give its lights their maps; lists by channel copy these lights.
    const PreparedShadows shadows = prepareShadows(jobs, arena, scene, main, settings, asked[0], held);

    const ProbePacket probes = probesOf(jobs, arena, scene, main, heldProbes, asked[0].packet);
    const GridPacket grids = findGrids(arena, scene, main, asked[0].packet);
    for (size_t i = 0; i < views.size(); ++i) darken(arena, scene, drawn[i], asked[i]);
    for (size_t i = 0; i < views.size(); ++i) separateChannels(jobs, arena, scene.lights, drawn[i], asked[i]);
    FramePacket packet = packetOf(arena, scene, { asked, shadows.views });
    packet.shadows = behindViews(arena, shadows.packet, static_cast<uint32_t>(asked.size()));
    packet.environment = environmentOf(scene, grids);
    packet.probes = probes;
    packet.grids = grids;
    packet.settings = settings;
    packet.last = last.seenFrom(makeViewSpace(main), main, packet.mainView().uniforms.time);
    if (settings.readsMotion(packet.mainView().counts)) addMotion(arena, scene, last, packet);
    const SunDiscs discs = findSunDiscs(arena, scene.lights, drawn[0]);
    packet.discs = discs.inView;
    packet.discsOutOfView = discs.outOfView;
    packet.splats = splatsOf(jobs, arena, scene, drawn[0], settings);
    packet.focus = focusOf(main.camera, settings.effects.depthOfField, settings.insideSize().y);
    // The demand comes after all that it counts; what only an effect needs, after the demand.
    packet.demand = demandOf(scene, packet, shadows.counts, largestBlur(jobs, arena, scene, main, packet));
    packet.covered = coveredPixelsIn(jobs, arena, scene, drawn[0], packet);
    if (packet.demand.needs(Effect::VolumetricFog))
        packet.fogAccumulation = last.fogAccumulation(scene, main, packet.settings);
    if (packet.demand.needs(Effect::Taa)) packet.accumulation = last.accumulation(scene, main, packet);
    // Last: receivers of shadows, blur and the rest follow from what is in view, hidden or not, as without.
    if (settings.cullsOccluded) hideFromMainView(jobs, arena, scene, drawn[0], packet);
    placeFields(jobs, arena, scene, main, fields, packet); // of what is drawn
    if (numbersObjects(settings.debugView)) numberObjects(arena, scene, packet);
    return packet;
}

} // namespace filament_core::prepare
