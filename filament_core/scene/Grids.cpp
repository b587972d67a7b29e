// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Grids.h"

#include "base/math/IrradianceSh.h"

namespace filament_core::scene {

GridRecord gridRecord(IrradianceGridDesc const& desc) {
    GridRecord record{ .centerWorld = desc.centerWorld,
                       .worldFromBox = desc.worldFromBox,
                       .halfExtent = desc.halfExtentMeters,
                       .blendMeters = desc.blendMeters,
                       .irradianceSh = {},
                       .probes = desc.probes,
                       .name = desc.name };
    record.irradianceSh.reserve(desc.probes->probes.size());
    for (IrradianceProbe const& probe : desc.probes->probes) {
        std::array<float3, 9> light = rotateIrradianceSh(probe.irradianceSh, desc.worldFromBox);
        for (float3& coefficient : light) coefficient *= desc.intensity;
        record.irradianceSh.push_back(light);
    }
    return record;
}

} // namespace filament_core::scene
