// SPDX-License-Identifier: Apache-2.0
// Colours of debug views, as a display shows them; included after shaders/lib/color.glsl.

// Okabe and Ito 2008, "Color Universal Design": distinguishable for everyone.
const vec3 kDebugGrey = vec3(153.0, 153.0, 153.0) / 255.0;
const vec3 kDebugOrange = vec3(230.0, 159.0, 0.0) / 255.0;
const vec3 kDebugBlue = vec3(86.0, 180.0, 233.0) / 255.0;
const vec3 kDebugGreen = vec3(0.0, 158.0, 115.0) / 255.0;
const vec3 kDebugPurple = vec3(204.0, 121.0, 167.0) / 255.0;
const vec3 kDebugVermilion = vec3(213.0, 94.0, 0.0) / 255.0;
const vec3 kDebugYellow = vec3(240.0, 228.0, 66.0) / 255.0;

// The luminance of light between 0.35 and 1, so that black surfaces are tinted, too.
float debugGrey(vec3 light) {
    float bright = max(luminance(light), 0.0);
    return 0.35 + 0.65 * srgbFromLinear(bright / (1.0 + bright));
}

const int kManyCounts = 256; // kMaxLightsOfFroxel

// From dark purple to yellow, ever lighter: straight lines between five colours of viridis (Smith and van der Walt
// 2015).
vec3 colorOfHeat(float heat) {
    float at = heat * 4.0;
    vec3 color = vec3(68.0, 1.0, 84.0);
    color += saturate(at) * vec3(-9.0, 81.0, 55.0);
    color += saturate(at - 1.0) * vec3(-26.0, 63.0, 1.0);
    color += saturate(at - 2.0) * vec3(61.0, 56.0, -42.0);
    color += saturate(at - 3.0) * vec3(159.0, 30.0, -61.0);
    return color / 255.0;
}

// A colour for each count up to 8, then two for each doubling: up to 12, 16, 24, 32, ..., 192 and 255.
int stepOfCount(int count) {
    int last = count - 1;
    int octave = (last >= 16 ? 1 : 0) + (last >= 32 ? 1 : 0) + (last >= 64 ? 1 : 0) + (last >= 128 ? 1 : 0);
    return count <= 8 ? count : 9 + 2 * octave + (last >> (octave + 2) & 1);
}

vec3 colorOfCount(int count) {
    int step = stepOfCount(count);
    vec3 color = colorOfHeat(float(min(step, 8) - 1) * (0.6 / 7.0) + float(max(step - 8, 0)) * 0.04);
    if (count == 0) color = vec3(0.25);
    if (count >= kManyCounts) color = vec3(1.0);
    return color;
}
