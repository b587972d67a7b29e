// SPDX-License-Identifier: Apache-2.0
// Tangent frames as quaternions: 4 numbers instead of 9.

// The frame of a unit quaternion: t, b, n are the rotated x, y, z axes, b mirrored where q.w < 0 (q and -q are the same
// rotation, so its sign is free to carry the handedness; the writer keeps |w| above zero). Frey and Herzeg 2011,
// "Spherical Skinning with Dual Quaternions and QTangents".
void tangentFrame(vec4 q, OUT(vec3) n, OUT(vec3) t, OUT(vec3) b) {
    n = vec3(0.0f, 0.0f, 1.0f) + vec3(2.0f, -2.0f, -2.0f) * q.x * vec3(q.z, q.w, q.x) +
            vec3(2.0f, 2.0f, -2.0f) * q.y * vec3(q.w, q.z, q.y);
    t = vec3(1.0f, 0.0f, 0.0f) + vec3(-2.0f, 2.0f, -2.0f) * q.y * vec3(q.y, q.x, q.w) +
            vec3(-2.0f, 2.0f, 2.0f) * q.z * vec3(q.z, q.w, q.x);
    b = cross(n, t) * (q.w < 0.0f ? -1.0f : 1.0f);
}
