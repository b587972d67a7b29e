// SPDX-License-Identifier: Apache-2.0
// Shared by the passes of the lens flare.

const float kBrightestOfFlare = 16384.0;

float lightOfFlare(float light, float threshold) {
    float above = light - threshold;
    return above > 0.0 ? min(above, kBrightestOfFlare) : 0.0; // NaN: nothing
}
vec3 lightOfFlare(vec3 light, float threshold) {
    return vec3(lightOfFlare(light.r, threshold), lightOfFlare(light.g, threshold), lightOfFlare(light.b, threshold));
}
