// SPDX-License-Identifier: Apache-2.0
// Reflection probes of a scene.
#include "filament_core/engine/LightBox.h"
#include "filament_core/engine/SceneImpl.h"

namespace filament_core {
namespace {

using engine::PublicCall;

void checkProbe(ReflectionProbeDesc const& desc) {
    FILAMENT_ASSERT(desc.light, "a reflection probe has a light");
    engine::checkLightBox(desc);
    const float3 inside = desc.halfExtentMeters - glm::abs(desc.captureInBoxMeters);
    FILAMENT_ASSERT(inside.x > 0 && inside.y > 0 && inside.z > 0, "a reflection probe is captured inside of its box");
}

scene::ProbeRecord recordOf(Scene::Impl const& scene, ReflectionProbeDesc const& desc) {
    checkProbe(desc);
    scene::IndirectLightRecord const& light = scene.engine.indirectLights.get(desc.light).light;
    return { .centerWorld = desc.centerWorld,
             .worldFromBox = desc.worldFromBox,
             .halfExtent = desc.halfExtentMeters,
             .blendMeters = desc.blendMeters,
             .captureInBox = desc.captureInBoxMeters,
             .intensity = desc.intensity,
             .lightsDiffuse = desc.lightsDiffuse,
             .cube = light.specular,
             .shape = light.shape,
             .storage = light.storage,
             .levelOfRoughnessOne = light.levelOfRoughnessOne,
             .irradianceSh = light.irradianceSh,
             .name = desc.name };
}

} // namespace

ReflectionProbe Scene::add(ReflectionProbeDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(ReflectionProbeDesc)", desc.name);
    scene::ProbeRecord record = recordOf(*mImpl, desc);
    scene::Probes& probes = mImpl->changed().probes;
    probes.records.reserve(probes.records.size() + 1);
    const ReflectionProbe probe = probes.index.add();
    probes.records.push_back(std::move(record));
    return probe;
}

void Scene::remove(ReflectionProbe probe) {
    const PublicCall call(mImpl, "Scene::remove(ReflectionProbe)");
    scene::Probes& probes = mImpl->changedUses().probes;
    scene::closeGap(probes.records, probes.index.remove(probe));
}

void Scene::set(ReflectionProbe probe, ReflectionProbeDesc const& desc) {
    const PublicCall call(mImpl, "Scene::set(ReflectionProbe, ReflectionProbeDesc)", desc.name);
    scene::ProbeRecord record = recordOf(*mImpl, desc);
    scene::Probes& probes = mImpl->changedUses().probes;
    probes.records[probes.index.at(probe)] = std::move(record);
}

uint32_t Scene::reflectionProbeCount() const {
    const PublicCall call(mImpl, "Scene::reflectionProbeCount()");
    return mImpl->data.probes.index.size();
}

} // namespace filament_core
