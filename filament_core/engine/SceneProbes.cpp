// SPDX-License-Identifier: Apache-2.0
// Reflection probes of a scene.
#include "filament_core/engine/SceneImpl.h"

#include <cmath>

namespace filament_core {
namespace {

using engine::PublicCall;

constexpr float kLargestProbeMeters = 1e9f; // sides and their products stay far from infinity

bool isUpTo(float3 v, float most) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(v[axis]) <= most)) return false;
    return true;
}

bool isRotation(float3x3 const& axes) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j)
            if (!(std::abs(glm::dot(axes[i], axes[j]) - (i == j ? 1.0f : 0.0f)) < 1e-3f)) return false;
    }
    return true;
}

void checkProbe(ReflectionProbeDesc const& desc) {
    const double3 center = desc.centerWorld;
    const float3 half = desc.halfExtentMeters;
    FILAMENT_ASSERT(desc.light, "a reflection probe has a light");
    FILAMENT_ASSERT(std::isfinite(center.x) && std::isfinite(center.y) && std::isfinite(center.z),
                    "the center of a reflection probe is finite");
    FILAMENT_ASSERT(half.x > 0 && half.y > 0 && half.z > 0 && isUpTo(half, kLargestProbeMeters),
                    "halfExtentMeters of a reflection probe is > 0 and at most 1e9");
    FILAMENT_ASSERT(isRotation(desc.worldFromBox),
                    "worldFromBox of a reflection probe holds three unit vectors at right angles");
    FILAMENT_ASSERT(desc.blendMeters >= 0 && desc.blendMeters <= kLargestProbeMeters,
                    "blendMeters of a reflection probe is >= 0 and at most 1e9");
    FILAMENT_ASSERT(desc.intensity >= 0 && desc.intensity <= 1e9f,
                    "the intensity of a reflection probe is >= 0 and at most 1e9");
    const float3 capture = glm::abs(desc.captureInBoxMeters);
    FILAMENT_ASSERT(capture.x < half.x && capture.y < half.y && capture.z < half.z,
                    "a reflection probe is captured inside of its box");
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
