// SPDX-License-Identifier: Apache-2.0
// A panorama whose lower half lies on the ground, under a dome: where a camera that moves looks up what the panorama's
// camera saw.

// What the panorama's camera saw at the point that a ray meets first: the ground, a plane, or the dome, a sphere around
// the panorama's camera. Both meet in a circle, where nothing jumps, because the point alone decides.
// camera: where the ray begins, in metres; x and z from the panorama's camera, y above the ground; direction: unit;
// height: of the panorama's camera above the ground, metres, > 0; radius: of the dome, metres, > height. Returns the
// direction from the panorama's camera, not unit. A camera below the ground sees the dome alone, one outside of the dome
// what lies straight on. fp32 only: squares of metres exceed 16 bits.
vec3 directionOverGround(vec3 camera, vec3 direction, float height, float radius) {
    vec3 from = camera - vec3(0.0f, height, 0.0f);
    float along = dot(from, direction);
    float inside = max(along * along - dot(from, from) + radius * radius, 0.0f);
    float meters = max(sqrt(inside) - along, 1e-3f * radius);
    if (camera.y > 0.0f && direction.y < 0.0f) meters = min(meters, camera.y / max(-direction.y, 1e-20f));
    return from + direction * meters;
}
