// SPDX-License-Identifier: Apache-2.0
// The pixels of the texels of an occlusion texture, and linear depth there. Includes need: the parameter
// `depth`, the values `last` and `inverseOfDepth`, and the constant `grid`: 0 full, 1 half, 2 checkerboard.
//   inverse  linear in depth and in screen space on a plane, and greater if nearer: 1 / distance of a
//            perspective projection; of an orthographic one the distance to the far plane, in widths of pixels.

const int kGridFull = 0;
const int kGridHalf = 1;
const int kGridCheckerboard = 2;

// Texels beyond the screen, which exist if its size is odd, use the last pixels.
vec2 pixelOfTexel(vec2 texel) {
    vec2 pixel = texel;
    if (materialConstants_grid == kGridHalf) pixel = texel * 2.0;
    if (materialConstants_grid == kGridCheckerboard) {
        pixel.x = texel.x * 2.0 + 2.0 * fract(texel.y * 0.5);
    }
    return min(pixel, materialParams.last);
}

// 1 / kFarDistance for background. Of the nearest pixel on screen.
float inverseAt(vec2 pixel) {
    vec2 inside = clamp(pixel, vec2(0.0), materialParams.last);
    float depth = texelFetch(materialParams_depth, ivec2(inside), 0).x;
    return max(depth * materialParams.inverseOfDepth.x + materialParams.inverseOfDepth.y, 1e-30);
}
