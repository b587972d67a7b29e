// SPDX-License-Identifier: Apache-2.0
// Look-ups of a pre-filtered environment that together have the shape of a specular lobe. The cube stores round lobes for
// a view along the normal; at grazing angles the lobe of a rough surface leans beyond the mirrored view, and is longer than
// wide. All look-ups count alike and lie in the plane of normal and view:
//     direction = mix(normal, mirrored view, turn)
// The numbers are fitted by tools/lookupfit, which says how: cubic polynomials of roughness and n.v.

// One value of the fit for r, perceptual roughness, and c, n.v: coefficients of the powers of c, times 1 and times r; of
// r^2, c r^2 and r^3. fp32 only: terms cancel.
float lookUpCubic(float r, float c, vec4 plain, vec3 timesR, vec3 timesR2) {
    float first = plain.x + c * (plain.y + c * (plain.z + c * plain.w));
    float second = timesR.x + c * (timesR.y + c * timesR.z);
    return first + r * (second + r * (timesR2.x + c * timesR2.y + r * timesR2.z));
}

// Look-up `index` of `count`, which is 2 or 3. r, c in [0, 1]. Returns the turn, [-1.6, 1.4], and the perceptual roughness
// of the texel, [0, 1]. fp32 only.
vec2 lookUpOf(int count, int index, float r, float c) {
    vec4 turnPlain = vec4(-0.25f, 9.3125f, -5.1875f, -0.6875f);
    vec3 turnR = vec3(-5.375f, -12.9375f, 7.75f);
    vec3 turnR2 = vec3(9.5625f, 1.9375f, -4.4375f);
    vec4 widthPlain = vec4(0.5625f, 0.0625f, 1.0f, -0.5f);
    vec3 widthR = vec3(0.25f, -0.75f, 0.0625f);
    vec3 widthR2 = vec3(-0.75f, 0.375f, 1.0f);
    if (count == 2 && index == 1) {
        turnPlain = vec4(-3.75f, 10.3125f, -12.5f, 4.375f);
        turnR = vec3(6.75f, -11.3125f, 6.6875f);
        turnR2 = vec3(-11.3125f, 3.75f, 6.3125f);
        widthPlain = vec4(1.625f, -1.5f, 1.0f, -0.1875f);
        widthR = vec3(-4.8125f, 3.625f, 0.8125f);
        widthR2 = vec3(9.3125f, -4.5f, -4.25f);
    } else if (count == 3 && index == 0) {
        turnPlain = vec4(0.6875f, 8.6875f, -3.9375f, -0.5625f);
        turnR = vec3(-8.75f, -10.5625f, 6.125f);
        turnR2 = vec3(14.0f, 0.0625f, -6.3125f);
        widthPlain = vec4(0.1875f, 0.75f, 1.0625f, -0.5625f);
        widthR = vec3(1.5f, -2.625f, 0.1875f);
        widthR2 = vec3(-2.4375f, 1.5625f, 1.6875f);
    } else if (count == 3 && index == 1) {
        turnPlain = vec4(-1.75f, 9.1875f, -9.75f, 1.8125f);
        turnR = vec3(-2.0625f, -9.6875f, 10.6875f);
        turnR2 = vec3(5.5625f, -2.1875f, -2.75f);
        widthPlain = vec4(0.3125f, -0.3125f, 1.0f, -0.375f);
        widthR = vec3(1.5625f, -0.3125f, 0.4375f);
        widthR2 = vec3(-3.0625f, -0.1875f, 2.875f);
    } else if (count == 3 && index == 2) {
        turnPlain = vec4(-5.25f, 9.0625f, -10.5625f, 5.5f);
        turnR = vec3(10.75f, -7.5625f, -1.1875f);
        turnR2 = vec3(-20.0625f, 6.625f, 12.125f);
        widthPlain = vec4(2.0f, -1.125f, 0.4375f, -0.3125f);
        widthR = vec3(-6.875f, 3.8125f, 2.5625f);
        widthR2 = vec3(13.75f, -7.6875f, -5.5f);
    }
    float turn = 1.0f + r * r * lookUpCubic(r, c, turnPlain, turnR, turnR2);
    return vec2(turn, saturate(r * lookUpCubic(r, c, widthPlain, widthR, widthR2)));
}
