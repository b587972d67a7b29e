// SPDX-License-Identifier: Apache-2.0
// KHR_materials_unlit: the base colour is the colour. Points and lines without normals add emission (glTF 2.0
// specification, 3.9.7), here rather than as an input, because that would cost something where there is none.

vec2 uvSets[2]; // base colour and emission have no others: GltfUvSets.h

#include "shaders/material/gltf/base_color.glsl"
#include "shaders/material/gltf/emission.glsl"

void material(inout MaterialInputs material) {
    uvSets = vec2[2](getUV0(), getUV1());
    prepareMaterial(material);
    material.baseColor = gltfBaseColor();
    if (materialConstants_hasEmission) {
#if defined(BLEND_MODE_TRANSPARENT) || defined(BLEND_MODE_FADE)
        material.baseColor.rgb += gltfEmission() * material.baseColor.a;
#else
        material.baseColor.rgb += gltfEmission();
#endif
    }
}
