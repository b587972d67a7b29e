// SPDX-License-Identifier: Apache-2.0
// KHR_materials_transmission and KHR_materials_volume: red is transmission, green thickness.

#include "shaders/material/gltf/surface.glsl"

#include "shaders/material/gltf/layers.glsl"

vec2 gltfTransmission() {
    vec2 amounts = vec2(1.0);
    if (materialConstants_hasTransmissionMap || materialConstants_hasThicknessMap) {
        vec2 maps = texture(materialParams_transmissionMap, mapUv(materialConstants_transmissionUv,
                materialConstants_transmissionTransform, materialParams.transmissionUvMatrix)).xy;
        if (materialConstants_hasTransmissionMap) amounts.x = maps.x;
        if (materialConstants_hasThicknessMap) amounts.y = maps.y;
    }
    if (materialConstants_thicknessApart) {
        amounts.y = texture(materialParams_thicknessMap, mapUv(materialConstants_thicknessUv,
                materialConstants_thicknessTransform, materialParams.thicknessUvMatrix)).y;
    }
    return amounts * vec2(materialParams.transmission, materialParams.thickness);
}
