// SPDX-License-Identifier: Apache-2.0
// Scene-referred colour -> what an 8-bit display buffer stores; shared by tonemap.mat and tonemap_sampled.mat.

#include "shaders/lib/color.glsl"

vec4 displayColor(vec4 hdr) {
    vec3 color = toneMap(hdr.rgb, materialConstants_toneMapper);
    if (!toneMapIncludesTransfer(materialConstants_toneMapper)) color = srgbFromLinear(color);
    if (materialConstants_dither) {
        // One step of 8 bits of noise, centred on zero, so that gradients do not band.
        color += (interleavedGradientNoise(gl_FragCoord.xy) - 0.5) * (1.0 / 255.0);
    }
    return vec4(color, hdr.a);
}
