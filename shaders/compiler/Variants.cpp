// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Variants.h"

namespace filament::shader {

uint8_t selectableBits(MaterialDomain domain, ShadingModel shading, bool halfPrecision) {
    if (domain != MaterialDomain::Surface || shading != ShadingModel::Lit) return 0;
    return kVariantSun | kVariantPunctual | (halfPrecision ? kVariantHalf : 0);
}

std::vector<uint8_t> variantKeys(uint8_t selectable, uint8_t filteredBits) {
    const uint32_t bits = selectable & ~static_cast<uint32_t>(filteredBits);
    std::vector<uint8_t> keys;
    for (uint32_t key = 0; key <= bits; ++key) {
        if ((key & ~bits) == 0) keys.push_back(static_cast<uint8_t>(key));
    }
    return keys;
}

} // namespace filament::shader
