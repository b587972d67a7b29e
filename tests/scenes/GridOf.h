// SPDX-License-Identifier: Apache-2.0
/// Irradiance grids whose light is a formula of the place, for tests.
#pragma once

#include <filament_core/IrradianceGrid.h>

#include <functional>
#include <memory>

namespace filament_core::scenes {

/// `light`: the coefficients at a point of the box, metres from its centre.
inline IrradianceGridDesc gridOf(float3 halfExtent, uint3 count,
                                 std::function<std::array<float3, 9>(float3)> const& light) {
    auto probes = std::make_shared<IrradianceProbes>();
    probes->count = count;
    for (uint32_t z = 0; z < count.z; ++z) {
        for (uint32_t y = 0; y < count.y; ++y) {
            for (uint32_t x = 0; x < count.x; ++x) {
                const uint3 at(x, y, z);
                float3 place(0);
                for (int axis = 0; axis < 3; ++axis)
                    if (count[axis] > 1)
                        place[axis] = halfExtent[axis] *
                                      (2 * static_cast<float>(at[axis]) / static_cast<float>(count[axis] - 1) - 1);
                probes->probes.push_back({ .irradianceSh = light(place) });
            }
        }
    }
    return { .halfExtentMeters = halfExtent, .probes = probes };
}

/// The same from all directions.
inline std::array<float3, 9> ambientOf(float3 color) { return { color }; }

} // namespace filament_core::scenes
