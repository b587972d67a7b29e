// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/References.h"

#include "base/Assert.h"
#include "tools/accuracy/TracedPicture.h"

namespace filament_core::accuracy {
namespace {

using tools::SceneSpec;

Result<Truth> shootTruth(ReferenceStage const& stage, SceneSpec const& scene, Settings const& settings,
                         uint32_t factor) {
    Result<Picture> picture = shoot(stage.studio, scene, settings, scene.view.size * factor, scene.linear);
    if (!picture) return picture.error();
    return Truth{ .picture = factor > 1 ? boxFiltered(*picture, factor) : std::move(*picture) };
}

Result<Truth> traceTruth(ReferenceStage const& stage, SceneSpec const& scene, Settings const& settings,
                         Reference const& reference) {
    Result<std::unique_ptr<Take>> take = stage.studio.take(scene, settings, scene.view.size, scene.linear);
    if (!take) return take.error();
    const Result<reference::ReferenceScene> traced = referenceSceneOf(scene, stage.folders, stage.jobs);
    if (!traced) return traced.error();
    Result<TracedPicture> picture =
            trace(*traced, (*take)->view(), reference.samples, stage.jobs,
                  reference.hasPaths ? reference::Integrator::Path : reference::Integrator::Unoccluded);
    if (!picture) return picture.error();
    return Truth{ std::move(picture->picture), Edges::Skip, picture->relativeError };
}

/// Every pixel that shows an object shows the environment's radiance.
Result<Truth> furnaceTruth(ReferenceStage const& stage, SceneSpec const& scene, Settings const& settings) {
    Result<Truth> truth = shootTruth(stage, scene, settings, 1);
    if (!truth) return truth;
    const float radiance = scene.environmentSettings.illuminance.value * scene.exposure.factor();
    for (float3& pixel : truth->picture.pixels)
        if (pixel != float3(0.0f)) pixel = float3(radiance);
    truth->edges = Edges::Skip;
    return truth;
}

} // namespace

Result<Settings> settingsFor(SceneSpec const& scene, std::vector<std::string> const& base,
                             std::vector<std::string> const& set) {
    Settings settings = settingsOf(scene);
    if (const Result<void> done = change(settings, base); !done) return done.error();
    if (const Result<void> done = change(settings, set); !done) return done.error();
    return settings;
}

Result<Picture> shoot(Studio& studio, SceneSpec const& scene, Settings const& settings, uint2 size, bool linear) {
    Result<std::unique_ptr<Take>> take = studio.take(scene, settings, size, linear);
    return take ? (*take)->shoot() : take.error();
}

Result<Truth> makeTruth(Reference const& reference, SceneSpec const& scene, std::vector<std::string> const& base,
                        ReferenceStage const& stage) {
    SceneSpec const* drawn = &scene;
    if (reference.kind == ReferenceKind::Scene) {
        const Result<SceneSpec const*> other = stage.scenes.find(reference.scene);
        if (!other) return other.error();
        drawn = *other;
    }
    const Result<Settings> settings = settingsFor(*drawn, base, reference.set);
    if (!settings) return settings.error();
    switch (reference.kind) {
    case ReferenceKind::Setting:
    case ReferenceKind::Scene:
        return shootTruth(stage, *drawn, *settings, 1);
    case ReferenceKind::Supersampled:
        return shootTruth(stage, *drawn, *settings, reference.factor);
    case ReferenceKind::Traced:
        return traceTruth(stage, *drawn, *settings, reference);
    case ReferenceKind::Furnace:
        return furnaceTruth(stage, *drawn, *settings);
    case ReferenceKind::OtherBackend:
    case ReferenceKind::Integral:
        break;
    }
    FILAMENT_ASSERT(false, "this reference is not one picture");
    return Truth{};
}

} // namespace filament_core::accuracy
