// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/GuardBand.h"

#include "filament_core/scene/SceneData.h"

#include <algorithm>

namespace filament_core::prepare {
namespace {

bool hasRefraction(scene::SceneData const& scene) {
    scene::Drawables const& drawables = scene.renderables.drawables;
    for (uint32_t i = 0; i < drawables.limit(); ++i) {
        if (drawables.use(i).users == 0) continue;
        if (drawables[i].material->material->package.refractionMode == shader::RefractionMode::ScreenSpace) return true;
    }
    return false;
}

} // namespace

bool looksBesidePicture(scene::SceneData const& scene, Quality const& quality, Effects const& effects) {
    if (effects.ambientOcclusion.enabled || effects.screenSpaceReflections.enabled ||
        quality.antiAliasing == AntiAliasing::Taa)
        return true;
    if (effects.bloom.enabled || effects.lensFlare.enabled) return true;
    if (effects.depthOfField.enabled || effects.motionBlur.enabled) return true;
    if (std::ranges::any_of(scene.lights.records, &scene::LightRecord::contactShadows)) return true;
    return quality.refraction == RefractionSource::Screen && hasRefraction(scene);
}

} // namespace filament_core::prepare
