// SPDX-License-Identifier: Apache-2.0
// A texel with components in [0, 1] of any image: display values, or compressed light; included after
// shaders/lib/resolution.glsl and temporal.glsl. The material has the parameter `picture` and the constant `isSceneLinear`.

// NaN counts as 0.
float unitValue(float x) { return x >= 0.0 ? min(x, 1.0) : 0.0; }

vec4 texelAt(ivec2 at) {
    ivec2 last = textureSize(materialParams_picture, 0) - 1;
    vec4 texel = texelFetch(materialParams_picture, clamp(at, ivec2(0), last), 0);
    if (materialConstants_isSceneLinear) return vec4(boundedLight(finiteLight(texel).rgb), unitValue(texel.a));
    return vec4(unitValue(texel.r), unitValue(texel.g), unitValue(texel.b), unitValue(texel.a));
}

vec4 pictureOf(vec4 texel) {
    if (materialConstants_isSceneLinear) texel.rgb = lightFromBounded(texel.rgb);
    return texel;
}
