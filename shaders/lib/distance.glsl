// SPDX-License-Identifier: Apache-2.0
// Depth buffers and linear depth.

// Farther than anything: where a depth buffer holds nothing.
const float kFarDistance = 1e30f;

// The distance of a depth for any projection, perspective or not: depth = (z.x v + z.y) / (w.x v + w.y), and the
// distance is -v. z and w: (m22, m32) and (m23, m33) of the projection. depth: as the buffer holds it, in [0, 1].
// Returns metres; kFarDistance at infinity. fp32 only: depths far away are below the least 16-bit number.
float distanceFromDepth(float depth, vec2 z, vec2 w) {
    float over = depth * w.y - z.y;
    float under = depth * w.x - z.x;
    return under != 0.0f ? min(over / under, kFarDistance) : kFarDistance;
}
