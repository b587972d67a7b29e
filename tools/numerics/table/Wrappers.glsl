// SPDX-License-Identifier: Apache-2.0
// Wraps functions with outputs or arrays as functions of s, u and v that return one value. The same text is GLSL, and
// C++ in both precisions: no literals, no `float`.

vec3 tangentFrameNormal(vec4 q) {
    vec3 n, t, b;
    tangentFrame(q, n, t, b);
    return n;
}

vec3 tangentFrameTangent(vec4 q) {
    vec3 n, t, b;
    tangentFrame(q, n, t, b);
    return t;
}

vec3 tangentFrameBitangent(vec4 q) {
    vec3 n, t, b;
    tangentFrame(q, n, t, b);
    return b;
}

// Nine different coefficients made of four.
vec3 irradianceShOf(vec4 c, vec3 n, int bands) {
    vec4 sh[9];
    sh[0] = c;
    sh[1] = vec4(c.y, c.z, c.w, c.x);
    sh[2] = vec4(c.z, c.w, c.x, c.y);
    sh[3] = vec4(c.w, c.x, c.y, c.z);
    sh[4] = vec4(c.x, c.z, c.y, c.w);
    sh[5] = vec4(c.y, c.x, c.w, c.z);
    sh[6] = vec4(c.z, c.y, c.x, c.w);
    sh[7] = vec4(c.w, c.x, c.z, c.y);
    sh[8] = vec4(c.y, c.w, c.z, c.x);
    return irradianceSh(sh, n, bands);
}

// A rest as a point on a circle: next to its period it is next to 0, as it should be. x: the rest, y: the period.
vec2 onCircle(vec2 rest) { return vec2(cos(kTwoPi * rest.x / rest.y), sin(kTwoPi * rest.x / rest.y)); }
