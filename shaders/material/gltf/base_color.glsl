// SPDX-License-Identifier: Apache-2.0
// Base colour and texture coordinates of glTF materials, lit and unlit. glTF 2.0 specification, 3.9.2 and 3.9.4.
// After `uvSets`, which material() fills.

vec2 mapUv(int set, bool isTransformed, mat3 transform) {
    vec2 uv = uvSets[set];
    return isTransformed ? (transform * vec3(uv, 1.0)).xy : uv;
}

// Caps of sections are inside of the solid, where no texture is.
vec4 ofSurface(vec4 factor) {
#if defined(HAS_SECTION_PLANES)
    return isSectionCap() ? vec4(1.0) : factor;
#else
    return factor;
#endif
}

vec4 gltfBaseColor() {
    vec4 color = materialParams.baseColorFactor;
    if (materialConstants_hasVertexColor) color *= ofSurface(getColor());
    if (materialConstants_hasBaseColorMap) {
        vec2 uv = mapUv(materialConstants_baseColorUv, materialConstants_baseColorTransform,
                materialParams.baseColorUvMatrix);
        color *= ofSurface(texture(materialParams_baseColorMap, uv));
    }
#if defined(BLEND_MODE_TRANSPARENT) || defined(BLEND_MODE_FADE)
    color.rgb *= color.a; // glTF's colours are not pre-multiplied
#endif
    return color;
}
