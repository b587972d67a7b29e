// SPDX-License-Identifier: Apache-2.0
// Opaque matter with layers.

#include "shaders/material/gltf/surface.glsl"

vec4 gltfDiffuseTransmissionMaps() {
    vec4 maps = vec4(1.0); // RGB: colour, alpha: factor
    if (materialConstants_hasDiffuseTransmissionColorMap || materialConstants_hasDiffuseTransmissionMap) {
        vec4 texel = texture(materialParams_diffuseTransmissionMap, mapUv(materialConstants_diffuseTransmissionUv,
                materialConstants_diffuseTransmissionTransform, materialParams.diffuseTransmissionUvMatrix));
        if (materialConstants_hasDiffuseTransmissionColorMap) maps.rgb = texel.rgb;
        if (materialConstants_hasDiffuseTransmissionMap) maps.a = texel.a;
    }
    return maps;
}

#include "shaders/material/gltf/layers.glsl"

void material(inout MaterialInputs material) {
    gltfNormals(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material);
    gltfLayers(material);
}
