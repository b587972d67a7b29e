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
    vec4 turnPlain = vec4(-0.23828125f, 9.29296875f, -5.15625f, -0.7109375f);
    vec3 turnR = vec3(-5.35546875f, -12.9140625f, 7.71875f);
    vec3 turnR2 = vec3(9.5546875f, 1.91015625f, -4.4140625f);
    vec4 widthPlain = vec4(0.5625f, 0.05078125f, 0.9921875f, -0.50390625f);
    vec3 widthR = vec3(0.2734375f, -0.77734375f, 0.0703125f);
    vec3 widthR2 = vec3(-0.7265625f, 0.40234375f, 0.96875f);
    if (count == 2 && index == 1) {
        turnPlain = vec4(-3.765625f, 10.3203125f, -12.51171875f, 4.37109375f);
        turnR = vec3(6.72265625f, -11.30859375f, 6.68359375f);
        turnR2 = vec3(-11.3203125f, 3.734375f, 6.3046875f);
        widthPlain = vec4(1.63671875f, -1.51953125f, 0.99609375f, -0.2109375f);
        widthR = vec3(-4.80078125f, 3.62109375f, 0.796875f);
        widthR2 = vec3(9.31640625f, -4.5078125f, -4.265625f);
    } else if (count == 3 && index == 0) {
        turnPlain = vec4(0.71875f, 8.68359375f, -3.93359375f, -0.578125f);
        turnR = vec3(-8.734375f, -10.55078125f, 6.1015625f);
        turnR2 = vec3(13.984375f, 0.07421875f, -6.30859375f);
        widthPlain = vec4(0.1875f, 0.76171875f, 1.03515625f, -0.5703125f);
        widthR = vec3(1.50390625f, -2.6328125f, 0.20703125f);
        widthR2 = vec3(-2.4375f, 1.59375f, 1.71484375f);
    } else if (count == 3 && index == 1) {
        turnPlain = vec4(-1.7421875f, 9.20703125f, -9.76953125f, 1.8359375f);
        turnR = vec3(-2.06640625f, -9.69921875f, 10.671875f);
        turnR2 = vec3(5.5625f, -2.21875f, -2.77734375f);
        widthPlain = vec4(0.3203125f, -0.3359375f, 0.98046875f, -0.390625f);
        widthR = vec3(1.5859375f, -0.328125f, 0.4453125f);
        widthR2 = vec3(-3.04296875f, -0.16796875f, 2.88671875f);
    } else if (count == 3 && index == 2) {
        turnPlain = vec4(-5.2421875f, 9.046875f, -10.57421875f, 5.5234375f);
        turnR = vec3(10.76953125f, -7.55859375f, -1.203125f);
        turnR2 = vec3(-20.0703125f, 6.6328125f, 12.12890625f);
        widthPlain = vec4(1.9765625f, -1.14453125f, 0.43359375f, -0.32421875f);
        widthR = vec3(-6.8984375f, 3.83203125f, 2.54296875f);
        widthR2 = vec3(13.76953125f, -7.6875f, -5.50390625f);
    }
    float turn = 1.0f + r * r * lookUpCubic(r, c, turnPlain, turnR, turnR2);
    return vec2(turn, saturate(r * lookUpCubic(r, c, widthPlain, widthR, widthR2)));
}
