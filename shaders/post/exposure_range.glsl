// SPDX-License-Identifier: Apache-2.0
// Shared by auto exposure and the debug view of its histogram.

const float kMiddleGreyStops = -2.4739312; // log2(0.18)

// The number of pixels below the lower and below the upper percentile. At least a thousandth lies between.
vec2 countedRange(vec2 shares, float all) {
    float low = min(shares.x, 0.999) * all;
    return vec2(low, max(shares.y * all, low + 0.001 * all));
}
