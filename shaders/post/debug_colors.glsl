// SPDX-License-Identifier: Apache-2.0
// Colours of debug views, as a display shows them; included after shaders/lib/color.glsl.

// Okabe and Ito 2008, "Color Universal Design": told apart by everyone.
const vec3 kDebugGrey = vec3(153.0, 153.0, 153.0) / 255.0;
const vec3 kDebugOrange = vec3(230.0, 159.0, 0.0) / 255.0;
const vec3 kDebugBlue = vec3(86.0, 180.0, 233.0) / 255.0;
const vec3 kDebugGreen = vec3(0.0, 158.0, 115.0) / 255.0;
const vec3 kDebugPurple = vec3(204.0, 121.0, 167.0) / 255.0;

// The luminance of light between 0.35 and 1, so that black surfaces have a tint as well.
float debugGrey(vec3 light) {
    float bright = max(luminance(light), 0.0);
    return 0.35 + 0.65 * srgbFromLinear(bright / (1.0 + bright));
}
