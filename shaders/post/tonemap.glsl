// SPDX-License-Identifier: Apache-2.0
// Scene-referred colour -> what an 8-bit display buffer stores; shared by tonemap.mat and tonemap_sampled.mat.

#include "shaders/lib/color.glsl"
#include "shaders/post/dither.glsl"

vec4 displayColor(vec4 hdr) {
    vec3 color = toneMap(hdr.rgb, materialConstants_toneMapper);
    if (!toneMapIncludesTransfer(materialConstants_toneMapper)) color = srgbFromLinear(color);
    return vec4(dithered(color), hdr.a);
}
