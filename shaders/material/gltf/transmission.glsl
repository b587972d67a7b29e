// SPDX-License-Identifier: Apache-2.0
// KHR_materials_transmission and KHR_materials_volume: red is transmission, green thickness.

#include "shaders/material/gltf/surface.glsl"

vec4 gltfDiffuseTransmissionMaps() { return vec4(1.0); } // no texture is left for them: the loader warns

#include "shaders/material/gltf/layers.glsl"

vec2 gltfTransmission() {
    vec2 amounts = vec2(1.0);
    if (materialConstants_hasTransmissionMap || materialConstants_hasThicknessMap) {
        vec2 maps = texture(materialParams_transmissionMap, mapUv(materialConstants_transmissionUv,
                materialConstants_transmissionTransform, materialParams.transmissionUvMatrix)).xy;
        if (materialConstants_hasTransmissionMap) amounts.x = maps.x;
        if (materialConstants_hasThicknessMap) amounts.y = maps.y;
    }
    return amounts * vec2(materialParams.transmission, materialParams.thickness);
}
