// SPDX-License-Identifier: Apache-2.0
// The metallic-roughness model of glTF 2.0 (specification, 3.9): roughness is green, metallic blue, occlusion red.

#include "shaders/material/gltf/uv_sets.glsl"

#include "shaders/material/gltf/base_color.glsl"
#include "shaders/material/gltf/maps.glsl"

// The baked light of FILAMENT_lightmap, exposed: 110 000 lux have no place in 16 bits.
vec4 gltfBakedLight() {
    highp vec2 uv = mapUv(materialConstants_lightUv, materialConstants_lightTransform, materialParams.lightUvMatrix);
    highp vec4 texel = texture(materialParams_lightMap, uv);
    // Never negative, so that compilers see that the environment's diffuse light is not needed.
    return vec4(texel.rgb * (materialParams.lightIntensity * getExposure()), max(texel.a, 0.0));
}

// width: of the normal.
void gltfSurface(inout MaterialInputs material, float width) {
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
    material.roughness = widenedRoughness(material.roughness, width);
    if (materialConstants_hasOcclusionMap || materialConstants_occlusionInMetallicRoughness) {
        float occlusion = surface.r;
        if (materialConstants_hasOcclusionMap) occlusion = gltfOcclusion();
        material.ambientOcclusion = occlusionOf(occlusion);
    }
    material.emissive = gltfEmissive();
    if (materialConstants_hasLightMap) material.bakedLight = gltfBakedLight();
}
