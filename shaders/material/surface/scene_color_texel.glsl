// SPDX-License-Identifier: Apache-2.0
// The scene colour that a surface refracts or reflects (kBindingPicture), and linear depth.

#if !defined(HAS_PICTURE_TEXEL) // include guard
#define HAS_PICTURE_TEXEL

const highp float kTexelInset = 0.515625; // off the centre of an outer texel: no sampler reads the one beyond it

highp float alongView(highp vec3 point) {
    highp mat4 view = frameUniforms.viewFromWorld;
    return -(view[0].z * point.x + view[1].z * point.y + view[2].z * point.z + view[3].z);
}

// pixel: of the view. rgb: pre-exposed light, a: 1 / linear depth, 0 for background.
highp vec4 pictureTexel(highp vec2 pixel, highp float level) {
    highp float inset = kTexelInset * float(1 << int(ceil(level)));
    highp vec2 at = clamp(pixel, passUniforms.picture.xy + inset, passUniforms.picture.zw - inset);
    return textureLod(passPicture, at / vec2(textureSize(passPicture, 0)), level);
}

#endif
