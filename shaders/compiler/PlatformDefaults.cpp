// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/PlatformDefaults.h"

namespace filament_core::shader {

void usePlatformDefaults(Platform platform, MaterialDefinition& definition) {
    MaterialQuality& quality = definition.package.quality;
    const bool isMobile = platform == Platform::Mobile;
    if (quality == MaterialQuality::Default && platform != Platform::All)
        quality = isMobile ? MaterialQuality::Low : MaterialQuality::High;
    if (!isMobile) return;
    if (!definition.find("multiBounceAmbientOcclusion")) definition.multiBounceAmbientOcclusion = false;
    if (!definition.find("specularAmbientOcclusion"))
        definition.specularAmbientOcclusion = SpecularAmbientOcclusion::None;
}

} // namespace filament_core::shader
