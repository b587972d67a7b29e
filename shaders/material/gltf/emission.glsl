// SPDX-License-Identifier: Apache-2.0
// Emission of glTF materials (glTF 2.0 specification, 3.9.3). After base_color.glsl.

vec3 gltfEmission() {
    vec3 emission = materialParams.emissiveFactor;
    if (materialConstants_hasEmissiveMap) {
        vec2 uv = mapUv(materialConstants_emissiveUv, materialConstants_emissiveTransform,
                materialParams.emissiveUvMatrix);
        emission *= texture(materialParams_emissiveMap, uv).rgb;
    }
    return emission;
}
