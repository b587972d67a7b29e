// SPDX-License-Identifier: Apache-2.0
// What auto exposure and the view of its histogram agree on.

const float kMiddleGreyStops = -2.4739312; // log2(0.18)

// How many pixels are darker than those that count, and than the last one of them. At least a thousandth counts.
vec2 countedRange(vec2 shares, float all) {
    float low = min(shares.x, 0.999) * all;
    return vec2(low, max(shares.y * all, low + 0.001 * all));
}
