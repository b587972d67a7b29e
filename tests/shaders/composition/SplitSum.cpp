// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/DfgTable.h"
#include "tests/shaders/composition/Composition.h"

#include <vector>

namespace filament_core::shader::composition {
namespace {

constexpr int kSize = 64; // as the engine's

std::vector<vec4> bake() {
    std::vector<vec4> table;
    for (int y = 0; y < kSize; ++y) {
        const float roughness = (static_cast<float>(y) + 0.5f) / kSize,
                    alpha = std::max(roughness * roughness, 0.002025f);
        for (int x = 0; x < kSize; ++x) {
            const float nov = (static_cast<float>(x) + 0.5f) / kSize;
            const float2 dfg = assets::integrateDfg(nov, alpha);
            table.emplace_back(dfg.x, dfg.y, assets::integrateSheen(nov, alpha), assets::integrateVelvet(nov, alpha));
        }
    }
    return table;
}

} // namespace

vec4 splitSum(vec2 uv) {
    static const std::vector<vec4> table = bake();
    const vec2 at = clamp(uv * double(kSize) - 0.5, vec2(0.0), vec2(kSize - 1.0));
    const auto x = std::min(static_cast<int>(at.x), kSize - 2), y = std::min(static_cast<int>(at.y), kSize - 2);
    const vec4* const row = table.data() + y * kSize + x;
    const vec2 part = at - vec2(x, y);
    return mix(mix(row[0], row[1], part.x), mix(row[kSize], row[kSize + 1], part.x), part.y);
}

} // namespace filament_core::shader::composition
