// SPDX-License-Identifier: Apache-2.0
// Maps shared by all lit glTF materials: normals, occlusion, emission, bumps. glTF 2.0 specification, 3.9.3.

#include "shaders/lib/normals.glsl"
#include "shaders/material/gltf/emission.glsl"
#include "shaders/material/gltf/vectors.glsl"

// xyz: the normal, not normalised. w: normalWidth() of the mip level, the roughness of its lost detail; 0 without it.
vec4 gltfNormal() {
    vec2 uv = mapUv(materialConstants_normalUv, materialConstants_normalTransform, materialParams.normalUvMatrix);
    vec4 texel = texture(materialParams_normalMap, uv);
    vec3 n = texel.xyz * 2.0 - 1.0;
    n.xy = vectorOfVertex(n.xy, materialConstants_normalFrame, uv, materialParams.normalUvMatrix);
    return vec4(n.xy * materialParams.normalScale, n.z,
            materialConstants_normalWidth ? texel.a * materialParams.normalScale : 0.0);
}

// Sets the normal. Returns w of gltfNormal().
float gltfSurfaceNormal(inout MaterialInputs material) {
    float width = 0.0;
    if (materialConstants_hasNormalMap) {
        vec4 normal = gltfNormal();
        material.normal = normal.xyz;
        width = normal.w;
    }
    if (materialConstants_hasBentNormals) material.bentNormal = material.normal; // bent by gltfBend()
    return width;
}

float widenedRoughness(float roughness, float width) {
    return materialConstants_normalWidth ? widenedPerceptualRoughness(roughness, width) : roughness;
}

#include "shaders/material/gltf/bent_normal.glsl"

float gltfOcclusion() {
    vec2 uv = mapUv(materialConstants_occlusionUv, materialConstants_occlusionTransform, materialParams.occlusionUvMatrix);
    vec4 texel = texture(materialParams_occlusionMap, uv);
    if (materialConstants_hasBentNormals) gltfBend(texel.gb, uv);
    return texel.r;
}

float occlusionOf(float texel) { return 1.0 + materialParams.occlusionStrength * (texel - 1.0); }

// Weight 0: glTF scenes are authored for a white of 1, not for nits and an exposure.
vec4 gltfEmissive() { return vec4(gltfEmission(), 0.0); }

#include "shaders/material/gltf/bump.glsl"
