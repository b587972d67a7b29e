// SPDX-License-Identifier: Apache-2.0
// Fields of light over the box of an object (irradiance grids): values that change linearly along the axes of the
// box. fp32 only, because positions reach kilometres.

// Where in the box a point is; points outside count as on its faces. fromCenter: metres; inverseHalf: 1 / half the sides in
// metres, > 0. Returns [-1, 1] each.
vec3 fieldPlace(vec3 fromCenter, vec3 inverseHalf) {
    return clamp(fromCenter * inverseHalf, vec3(-1.0f), vec3(1.0f));
}

// value.w: in the middle; value.xyz: how much more it is on the faces that place = 1 names. place in [-1, 1] each.
float fieldValue(vec4 value, vec3 place) { return value.x * place.x + value.y * place.y + value.z * place.z + value.w; }
