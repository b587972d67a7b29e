// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/MaterialData.h"

#include <cmath>

namespace filament_core::assets {

bool MaterialData::scatters() const {
    const bool isEntered = (transmission.isUsed() || diffuseTransmission.isUsed()) && !unlit && !specularGlossiness;
    const bool isSolid = transmission.thicknessMeters > 0 || transmission.isThicknessAnimated;
    const bool isDim =
            std::isfinite(transmission.attenuationDistanceMeters) && transmission.attenuationColor != float3(1.0f);
    return volumeScatter.isUsed() && isEntered && isSolid && (isDim || transmission.isAbsorptionAnimated);
}

std::array<float, 4> turnOf(TextureRef const& map) {
    float3x3 const& m = map.uvTransform;
    const bool onlyScales = m[0].y == 0 && m[1].x == 0 && m[0].x > 0 && m[1].y > 0;
    if (map.isAnimated || onlyScales) return TangentBasis{}.turn;
    return { m[0].x, m[0].y, m[1].x, m[1].y };
}

MapFrame frameOf(TextureRef const& map, TangentBasis const& basis) {
    if (map.uvSet != basis.uvSet) return MapFrame::Derived;
    if (!map.isAnimated && turnOf(map) == basis.turn) return MapFrame::Vertex;
    return basis.turn == TangentBasis{}.turn ? MapFrame::Turned : MapFrame::Derived;
}

} // namespace filament_core::assets
