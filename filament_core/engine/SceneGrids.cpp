// SPDX-License-Identifier: Apache-2.0
// Irradiance grids of a scene.
#include "filament_core/engine/LightBox.h"
#include "filament_core/engine/SceneImpl.h"

#include <cmath>

namespace filament_core {
namespace {

using engine::PublicCall;

constexpr float kBrightestGrid = 1e12f;

bool isBright(float value) { return std::abs(value) <= kBrightestGrid; }

void checkProbes(IrradianceProbes const& probes) {
    using P = IrradianceProbes;
    const uint3 count = probes.count;
    FILAMENT_ASSERT(count.x > 0 && count.y > 0 && count.z > 0 && count.x <= P::kMaxProbes && count.y <= P::kMaxProbes &&
                            count.z <= P::kMaxProbes && uint64_t{ count.x } * count.y <= P::kMaxProbes &&
                            uint64_t{ count.x } * count.y * count.z <= P::kMaxProbes,
                    "an irradiance grid has 1 to 2^20 probes");
    const size_t all = size_t{ count.x } * count.y * count.z;
    FILAMENT_ASSERT(probes.probes.size() == all, "an irradiance grid has count.x * count.y * count.z probes");
    FILAMENT_ASSERT(probes.depthSize <= P::kMaxDepthSize &&
                            probes.depths.size() == all * probes.depthSize * probes.depthSize,
                    "an irradiance grid has depthSize^2 depths for each probe, and depthSize is at most 32");
    for (IrradianceProbe const& probe : probes.probes) {
        for (float3 const& coefficient : probe.irradianceSh)
            FILAMENT_ASSERT(isBright(coefficient.x) && isBright(coefficient.y) && isBright(coefficient.z),
                            "coefficients of an irradiance grid are from -1e12 to 1e12");
    }
}

void checkGrid(IrradianceGridDesc const& desc) {
    FILAMENT_ASSERT(desc.probes, "an irradiance grid has probes");
    engine::checkLightBox(desc);
    checkProbes(*desc.probes);
}

scene::GridRecord recordOf(IrradianceGridDesc const& desc) {
    checkGrid(desc);
    return scene::gridRecord(desc);
}

} // namespace

IrradianceGrid Scene::add(IrradianceGridDesc const& desc) {
    const PublicCall call(mImpl, "Scene::add(IrradianceGridDesc)", desc.name);
    scene::GridRecord record = recordOf(desc);
    scene::Grids& grids = mImpl->changed().grids;
    grids.records.reserve(grids.records.size() + 1);
    const IrradianceGrid grid = grids.index.add();
    grids.records.push_back(std::move(record));
    ++grids.changes;
    return grid;
}

void Scene::remove(IrradianceGrid grid) {
    const PublicCall call(mImpl, "Scene::remove(IrradianceGrid)");
    scene::Grids& grids = mImpl->changed().grids;
    scene::closeGap(grids.records, grids.index.remove(grid));
    ++grids.changes;
}

void Scene::set(IrradianceGrid grid, IrradianceGridDesc const& desc) {
    const PublicCall call(mImpl, "Scene::set(IrradianceGrid, IrradianceGridDesc)", desc.name);
    scene::GridRecord record = recordOf(desc);
    scene::Grids& grids = mImpl->changed().grids;
    grids.records[grids.index.at(grid)] = std::move(record);
    ++grids.changes;
}

uint32_t Scene::irradianceGridCount() const {
    const PublicCall call(mImpl, "Scene::irradianceGridCount()");
    return mImpl->data.grids.index.size();
}

} // namespace filament_core
