// SPDX-License-Identifier: Apache-2.0
// Patterns of pixels, and what is turned by them.

// Noise that is nearly uniform in every 3x3 block, for dithering and for rotating sample patterns. Jimenez 2014, "Next
// Generation Post Processing in Call of Duty: Advanced Warfare". pixel: gl_FragCoord.xy. Returns [0, 1). fp32 only: 16
// bits cannot count the pixels of a line.
float interleavedGradientNoise(vec2 pixel) {
    return fract(52.9829189f * fract(dot(pixel, vec2(0.06711056f, 0.00583715f))));
}

// A unit vector for each part of a full turn, counter-clockwise from (1, 0), not quite evenly: the tangent of half the angle
// grows linearly within each quarter. turn: [0, 1].
vec2 directionOfTurn(float turn) {
    float quarters = floor(turn * 4.0f);
    float t = turn * 4.0f - quarters;
    vec2 axis = vec2(1.0f - t * t, 2.0f * t) / (1.0f + t * t);
    bool isOdd = fract(quarters * 0.5f) > 0.25f;
    if (fract(quarters * 0.25f) >= 0.5f) axis = -axis;
    if (isOdd) axis = vec2(-axis.y, axis.x);
    return axis;
}
