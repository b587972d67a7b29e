// SPDX-License-Identifier: Apache-2.0
// Reflection probes: how much light a point takes from a probe, and where it looks that up. The frame of a box has its
// centre as the origin and its axes along the sides; fp32 only, because positions reach kilometres.

// How much of the light of a point a probe may give: all in its box and on its faces, less outside, and nothing from the
// blend distance on. local: the point in the box's frame, metres; halfExtent: metres, >= 0; inverseBlend: 1 / the blend
// distance in metres, > 0. Returns [0, 1].
float probeWeight(vec3 local, vec3 halfExtent, float inverseBlend) {
    vec3 outside = max(local, -local) - halfExtent;
    return clamp(1.0f - max(outside.x, max(outside.y, outside.z)) * inverseBlend, 0.0f, 1.0f);
}

// What a probe gives of what the probes before it have left: its weight, or all that is left. So weights add up to 1 at
// most, and in a box inside of another one, which comes first, the inner one gives all. weight, left in [0, 1].
// Returns [0, left].
float probeShare(float weight, float left) { return min(weight, left); }

// How far a ray goes inside of the box, in lengths of its direction: to the nearest of the planes that it leaves through
// (Kay and Kajiya 1986, "Ray Tracing Complex Scenes"). 0 where it has left them behind. A component of 0 meets no plane.
// local, halfExtent: as above; direction: in the box's frame, no component beyond 1, not zero. Returns >= 0.
float probeRayLength(vec3 local, vec3 direction, vec3 halfExtent) {
    vec3 speed = max(max(direction, -direction), vec3(1e-12f)); // planes beyond 1e18 metres do not matter
    vec3 along = vec3(direction.x < 0.0f ? -local.x : local.x, direction.y < 0.0f ? -local.y : local.y,
            direction.z < 0.0f ? -local.z : local.z);
    vec3 lengths = (halfExtent - along) / speed;
    return max(min(lengths.x, min(lengths.y, lengths.z)), 0.0f);
}

// Where the cube of the probe shows what a ray meets on the walls of the box. Lagarde and Zanuttini 2012, "Local
// Image-based Lighting with Parallax-corrected Cubemap". fromCapture: the point, seen from where the cube was captured,
// metres in the world; direction: of the ray, there; rayLength: from probeRayLength(). Returns metres, not unit.
vec3 probeDirection(vec3 fromCapture, vec3 direction, float rayLength) { return fromCapture + direction * rayLength; }
