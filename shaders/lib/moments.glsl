// SPDX-License-Identifier: Apache-2.0
// Shadow maps of moments, which can be blurred and filtered like images: the mean of a depth and of its square bound the
// part of a filter's texels that lies behind a receiver. Donnelly and Lauritzen 2006, "Variance Shadow Maps"; with warped
// depths Lauritzen and McCool 2008, "Layered Variance Shadow Maps". fp32 only.

const float kWarpTowards = 40.0f; // exponents of the warps; its square still fits fp32: e^80 = 5.5e34
const float kWarpAway = 5.0f;
const float kLeastDeviation = 5e-4f; // of depths: what rounding of blurred squares may look like
const float kLeastWarpedDeviation = 2e-4f;

// A depth of a map (1 at the light, 0 for background) as a distance between -1 and 1, linear in metres.
// nearOverFar: of a perspective map, whose depth is near / distance; 0: the depth is linear already.
float momentDepth(float depth, float nearOverFar) {
    float distance = 1.0f - saturate(depth);
    if (nearOverFar > 0.0f) distance = nearOverFar / max(depth, nearOverFar);
    return 2.0f * distance - 1.0f;
}

// How fast momentDepth() changes with the depth of a map, without its sign. momentDepth: its result.
float momentSlope(float momentDepth, float nearOverFar) {
    float distance = 0.5f * momentDepth + 0.5f;
    return nearOverFar > 0.0f ? 2.0f * distance * distance / nearOverFar : 2.0f;
}

vec2 momentsOf(float depth) { return vec2(depth, depth * depth); }

// Depths warped towards and away from the light, increasing both.
vec2 warpedDepth(float depth) { return vec2(exp(kWarpTowards * depth), -exp(-kWarpAway * depth)); }

vec4 warpedMomentsOf(float depth) {
    vec2 warped = warpedDepth(depth);
    return vec4(warped.x, warped.x * warped.x, warped.y, warped.y * warped.y);
}

// The most of a filter's texels that can lie at `depth` or behind it: Chebyshev's inequality, one-sided. 1 in front of
// their mean.
float chebyshevBound(vec2 moments, float depth, float leastVariance) {
    float variance = max(moments.y - moments.x * moments.x, leastVariance);
    float behind = max(depth - moments.x, 0.0f);
    return variance / (variance + behind * behind);
}

// Cuts off what bleeds through where penumbrae of several casters overlap, and what rounding takes from full light.
// bleeding: [0, 1). Lauritzen 2007, "Summed-Area Variance Shadow Maps", GPU Gems 3, section 8.4.3.
float withoutBleeding(float bound, float bleeding) {
    return saturate((bound - bleeding) * (1.0f / (0.98f - bleeding)));
}

float shadowOfMoments(vec2 moments, float depth) {
    return withoutBleeding(chebyshevBound(moments, depth, kLeastDeviation * kLeastDeviation), 0.2f);
}

// The smaller of both bounds: what bleeds through one warp seldom does so through the other.
// spread: variance of the receiving plane's own depths within the filter. The warp away from the light is concave, so the
// mean over a plane looks nearer than its middle, as if the plane shadowed itself.
float shadowOfWarpedMoments(vec4 moments, float depth, float spread) {
    vec2 warped = vec2(warpedDepth(depth).x, warpedDepth(max(depth - 0.5f * kWarpAway * spread, -1.0f)).y);
    vec2 deviation = kLeastWarpedDeviation * vec2(kWarpTowards, kWarpAway) * warped;
    float towards = chebyshevBound(vec2(moments.x, moments.y), warped.x, deviation.x * deviation.x);
    float away = chebyshevBound(vec2(moments.z, moments.w), warped.y, deviation.y * deviation.y);
    return withoutBleeding(min(towards, away), 0.1f);
}
