// SPDX-License-Identifier: Apache-2.0
// The metallic-roughness model of glTF 2.0 (specification, 3.9): roughness is green, metallic blue, occlusion red.

#include "shaders/material/gltf_base_color.glsl"

vec3 gltfNormal() {
    vec2 uv = mapUv(materialConstants_normalUv, materialConstants_normalTransform, materialParams.normalUvMatrix);
    vec3 n = texture(materialParams_normalMap, uv).xyz * 2.0 - 1.0;
    return vec3(n.xy * materialParams.normalScale, n.z);
}

void material(inout MaterialInputs material) {
    if (materialConstants_hasNormalMap) material.normal = gltfNormal();
    prepareMaterial(material);

    material.baseColor = gltfBaseColor();
    material.metallic = materialParams.metallicFactor;
    material.roughness = materialParams.roughnessFactor;
    vec4 surface = vec4(1.0); // occlusion, roughness, metallic
    if (materialConstants_hasMetallicRoughnessMap) {
        vec2 uv = mapUv(materialConstants_metallicRoughnessUv, materialConstants_metallicRoughnessTransform,
                materialParams.metallicRoughnessUvMatrix);
        surface = texture(materialParams_metallicRoughnessMap, uv);
        material.roughness *= surface.g;
        material.metallic *= surface.b;
    }
    if (materialConstants_hasOcclusionMap) {
        float occlusion = surface.r;
        if (!materialConstants_occlusionInMetallicRoughness) {
            vec2 uv = mapUv(materialConstants_occlusionUv, materialConstants_occlusionTransform,
                materialParams.occlusionUvMatrix);
            occlusion = texture(materialParams_occlusionMap, uv).r;
        }
        material.ambientOcclusion = 1.0 + materialParams.occlusionStrength * (occlusion - 1.0);
    }
    // Weight 0: glTF scenes are authored against a white of 1, not against nits under an exposure.
    material.emissive = vec4(materialParams.emissiveFactor, 0.0);
    if (materialConstants_hasEmissiveMap) {
        vec2 uv = mapUv(materialConstants_emissiveUv, materialConstants_emissiveTransform,
                materialParams.emissiveUvMatrix);
        material.emissive.rgb *= texture(materialParams_emissiveMap, uv).rgb;
    }
}
