// SPDX-License-Identifier: Apache-2.0
// KHR_materials_pbrSpecularGlossiness: RGB is the specular colour, alpha glossiness.

#include "shaders/material/gltf/uv_sets.glsl"

#include "shaders/material/gltf/base_color.glsl"
#include "shaders/material/gltf/maps.glsl"

void material(inout MaterialInputs material) {
    readUvSets();
    float width = gltfSurfaceNormal(material);
    prepareMaterial(material);
    gltfBump();
    material.baseColor = gltfBaseColor();
    material.specularColor = materialParams.specularFactor;
    material.glossiness = materialParams.glossinessFactor;
    if (materialConstants_hasSpecularGlossinessMap) {
        vec4 map = texture(materialParams_specularGlossinessMap, mapUv(materialConstants_specularGlossinessUv,
                materialConstants_specularGlossinessTransform, materialParams.specularGlossinessUvMatrix));
        material.specularColor *= map.rgb;
        material.glossiness *= map.a;
    }
    if (materialConstants_normalWidth) material.glossiness = 1.0 - widenedRoughness(1.0 - material.glossiness, width);
    if (materialConstants_hasOcclusionMap) material.ambientOcclusion = occlusionOf(gltfOcclusion());
    material.emissive = gltfEmissive();
}
