// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Variants.h"

#include <algorithm>

namespace filament::shader {

uint16_t selectableBits(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    if (package.domain != MaterialDomain::Surface) {
        const bool mayMerge = std::ranges::count(package.parameters, true, &Parameter::currentPixel) > 0;
        return mayMerge ? uint16_t{ kVariantMerged } : uint16_t{ 0 };
    }
    const bool isDeformable = package.vertexDomain == VertexDomain::Object && !definition.fullScreenTriangle;
    const int geometry = isDeformable ? kVariantSkinning : 0;
    if (package.shading == ShadingModel::Unlit) return static_cast<uint16_t>(geometry);
    const int lighting = kVariantSun | kVariantPunctual | (definition.halfPrecision ? kVariantHalf : 0);
    return static_cast<uint16_t>(geometry | lighting);
}

std::vector<uint16_t> variantKeys(uint16_t selectable, uint16_t filteredBits) {
    const uint32_t bits = selectable & ~static_cast<uint32_t>(filteredBits);
    std::vector<uint16_t> keys;
    for (uint32_t key = 0; key <= bits; ++key) {
        if ((key & ~bits) == 0) keys.push_back(static_cast<uint16_t>(key));
    }
    return keys;
}

} // namespace filament::shader
