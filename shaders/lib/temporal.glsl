// SPDX-License-Identifier: Apache-2.0
// Functions of temporal accumulation; included after color.glsl.
// fp32 only: the colours of the history are fp16 already, and its weights need more.

const float kLargestHalf = 65504.0f;

// The history may differ from the mean around a pixel by so many deviations of the colours there.
const float kAllowedDeviations = 1.25f;
const float kSmallestDeviation = 0.0009765625f; // 2^-10: rounding of even surfaces

// What a half float holds: infinities become its largest number, NaN and negative light 0.
float finiteLight(float light) { return light >= 0.0f ? min(light, kLargestHalf) : 0.0f; }
vec4 finiteLight(vec4 light) {
    return vec4(finiteLight(light.x), finiteLight(light.y), finiteLight(light.z), finiteLight(light.w));
}

// Light of [0, infinity) in [0, 1), by its luminance; the hue stays.
vec3 compressedLight(vec3 light) { return light * (1.0f / (1.0f + luminance(light))); }

// Inverse of compressedLight(); beyond its range, the largest number.
vec3 expandedLight(vec3 compressed) {
    vec3 color = max(compressed, 0.0f);
    return min(color * (1.0f / max(1.0f - luminance(color), 1e-5f)), kLargestHalf);
}

// Malvar and Sullivan 2003, "YCoCg-R: A Color Space with RGB Reversibility and Low Dynamic Range": without its rounding.
vec3 ycocgFromLight(vec3 light) {
    return vec3(dot(light, vec3(0.25f, 0.5f, 0.25f)), 0.5f * (light.x - light.z),
            dot(light, vec3(-0.25f, 0.5f, -0.25f)));
}
vec3 lightFromYcocg(vec3 color) {
    float rest = color.x - color.z;
    return vec3(rest + color.y, color.x + color.z, rest - color.y);
}
