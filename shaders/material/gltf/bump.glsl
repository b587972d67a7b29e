// SPDX-License-Identifier: Apache-2.0
// EXT_materials_bump: applyBump() of shaders/material/bump.glsl, where a constant says whether there is a normal map.

float gltfHeight(vec2 uv) { return texture(materialParams_bumpMap, uv).r; }

// bumpRise(), written out with the parameters of the material: passed to it, they change the order of the operations,
// and no package of a model shall change for a function of authors.
vec2 gltfRise() {
    vec2 uv = mapUv(materialConstants_bumpUv, materialConstants_bumpTransform, materialParams.bumpUvMatrix);
    vec2 right = dFdx(uv), down = dFdy(uv);
    vec2 width = max(max(abs(right), abs(down)), 1.0 / vec2(textureSize(materialParams_bumpMap, 0)));
    vec2 toU = vec2(0.5 * width.x, 0.0), toV = vec2(0.0, 0.5 * width.y);
    vec2 growth = vec2(gltfHeight(uv + toU) - gltfHeight(uv - toU), gltfHeight(uv + toV) - gltfHeight(uv - toV));
    vec2 rise = vec2(dot(growth, right / width), dot(growth, down / width)) * materialParams.bumpFactor;
    float limit = 2.5 * abs(materialParams.bumpFactor);
    return abs(rise.x) <= limit && abs(rise.y) <= limit ? rise : vec2(0.0);
}

// After prepareMaterial(). Depth does not need it.
void gltfBump() {
#if defined(HAS_NORMAL) && defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
    if (materialConstants_hasBumpMap)
        tiltTo(bumpedNormal(shading_normal, materialConstants_hasNormalMap, gltfRise()));
#endif
    gltfUnbent();
}
