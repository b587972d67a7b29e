// SPDX-License-Identifier: Apache-2.0
// Which pixels the texels of an occlusion texture stand for, and the distances there. Includes need: the parameter
// `distances`, the value `last`, and the constant `grid`: 0 full, 1 half, 2 checkerboard.

const int kGridFull = 0;
const int kGridHalf = 1;
const int kGridCheckerboard = 2;

// The last pixels stand for texels beyond the picture: there are some where the picture's size is odd.
vec2 pixelOfTexel(vec2 texel) {
    vec2 pixel = texel;
    if (materialConstants_grid == kGridHalf) pixel = texel * 2.0;
    if (materialConstants_grid == kGridCheckerboard) {
        pixel.x = texel.x * 2.0 + 2.0 * fract(texel.y * 0.5);
    }
    return min(pixel, materialParams.last);
}

// 1 / distance; of the nearest pixel of the picture.
float inverseAt(vec2 pixel) {
    vec2 inside = clamp(pixel, vec2(0.0), materialParams.last);
    return 1.0 / texelFetch(materialParams_distances, ivec2(inside), 0).x;
}
