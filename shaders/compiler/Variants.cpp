// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Variants.h"

#include <algorithm>

namespace filament_core::shader {
namespace {

/// Transparent materials cast shadows only with transparentShadow, and backgrounds only have depth if they write it.
bool leavesDepth(MaterialDefinition const& definition) {
    const Blending blending = definition.package.blending;
    return (!definition.fullScreenTriangle || definition.package.depthWrite) &&
           (blending == Blending::Opaque || blending == Blending::Masked || definition.package.transparentShadow);
}

/// Only they can compute the previous positions of their vertices. Transparent materials have no motion vectors.
bool placesVertices(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    const bool isSolid = package.blending == Blending::Opaque || package.blending == Blending::Masked;
    const bool followsCamera =
            package.vertexDomain == VertexDomain::View || package.vertexDomain == VertexDomain::Device;
    return isSolid && !definition.fullScreenTriangle && (definition.vertex || followsCamera);
}

/// What only tools draw.
bool showsValues(MaterialDefinition const& definition) { return !definition.fullScreenTriangle; }

/// Depth, motion and values alone are not lit, and what light does not reach has no shadows.
constexpr bool isVariant(uint32_t key, bool isLit) {
    for (const uint32_t alone : { kVariantDepth, kVariantMotion, kVariantDebug }) {
        if ((key & alone) != 0) return (key & ~(alone | kVariantSkinning)) == 0;
    }
    return !isLit || (key & kVariantShadowReceiver) == 0 || (key & (kVariantSun | kVariantPunctual)) != 0;
}

} // namespace

uint16_t selectableBits(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    if (package.domain != MaterialDomain::Surface) {
        const bool mayMerge = std::ranges::count(package.parameters, true, &Parameter::currentPixel) > 0;
        return mayMerge ? uint16_t{ kVariantMerged } : uint16_t{ 0 };
    }
    const bool isDeformable = package.vertexDomain == VertexDomain::Object && !definition.fullScreenTriangle;
    const int depth = leavesDepth(definition) ? kVariantDepth : 0;
    const int motion = placesVertices(definition) ? kVariantMotion : 0;
    const int debug = showsValues(definition) ? kVariantDebug : 0;
    const int geometry = depth | motion | debug | (isDeformable ? kVariantSkinning : 0);
    if (package.shading == ShadingModel::Unlit)
        return static_cast<uint16_t>(geometry | (package.shadowMultiplier ? kVariantShadowReceiver : 0));
    const int lighting =
            kVariantSun | kVariantPunctual | kVariantShadowReceiver | (definition.halfPrecision ? kVariantHalf : 0);
    return static_cast<uint16_t>(geometry | lighting);
}

std::vector<uint16_t> variantKeys(uint16_t selectable, uint16_t filteredBits) {
    const uint32_t bits = selectable & ~static_cast<uint32_t>(filteredBits);
    const bool isLit = (selectable & (kVariantSun | kVariantPunctual)) != 0;
    std::vector<uint16_t> keys;
    for (uint32_t key = 0; key <= bits; ++key) {
        if ((key & ~bits) == 0 && isVariant(key, isLit)) keys.push_back(static_cast<uint16_t>(key));
    }
    return keys;
}

} // namespace filament_core::shader
