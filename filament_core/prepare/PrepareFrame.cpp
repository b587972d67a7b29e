// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/PrepareView.h"

namespace filament::prepare {
namespace {

EnvironmentPacket environmentOf(scene::SceneData const& scene) {
    return { .specular = scene.indirectLight.specular,
             .irradiance = scene.indirectLight.irradiance,
             .sky = scene.skybox.cube,
             .storage = scene.indirectLight.storage,
             .skyIsRgbm = scene.skybox.isRgbm };
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
    return { packets, placeDeformations(arena, scene, visible), environmentOf(scene) };
}

} // namespace filament::prepare
