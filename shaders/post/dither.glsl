// SPDX-License-Identifier: Apache-2.0
// The last step of a tone mapper; included after shaders/lib/noise.glsl.

// Noise of one 8-bit step, centred on zero, so that gradients do not band.
vec3 dithered(vec3 color) {
    if (materialConstants_dither) color += (interleavedGradientNoise(gl_FragCoord.xy) - 0.5) * (1.0 / 255.0);
    return color;
}
