// SPDX-License-Identifier: Apache-2.0
// Shadows of areas of light from a cube of shadow maps around their centre. Vectors begin at the centre, in metres along
// the axes of the world. fp32 only.

// Half the width of a face at a distance of 1, with its margin: FitShadows.cpp, fitPunctual().
const float kFaceTangent = 1.14285714f;

// The face of a cube that a direction goes through: +x, -x, +y, -y, +z, -z. The first of the largest components counts.
int cubeFace(vec3 direction) {
    vec3 size = max(direction, -direction);
    int face = direction.z < 0.0f ? 5 : 4;
    if (size.x >= size.y && size.x >= size.z) {
        face = direction.x < 0.0f ? 1 : 0;
    } else if (size.y >= size.z) {
        face = direction.y < 0.0f ? 3 : 2;
    }
    return face;
}

// A direction from the centre in the frame of a face: x to the right and y down on its map, z ahead. The axes are those of
// FitShadows.cpp, worldFromLight().
vec3 inCubeFace(vec3 direction, int face) {
    float sign = (face & 1) == 0 ? 1.0f : -1.0f;
    vec3 turned = vec3(-sign * direction.x, -direction.y, sign * direction.z);
    if (face < 4) turned = vec3(-sign * direction.x, direction.z, sign * direction.y);
    if (face < 2) turned = vec3(sign * direction.z, -direction.y, sign * direction.x);
    return turned;
}

// The direction that inCubeFace() turned.
vec3 fromCubeFace(vec3 turned, int face) {
    float sign = (face & 1) == 0 ? 1.0f : -1.0f;
    vec3 direction = vec3(-sign * turned.x, -turned.y, sign * turned.z);
    if (face < 4) direction = vec3(-sign * turned.x, sign * turned.z, turned.y);
    if (face < 2) direction = vec3(sign * turned.z, -turned.y, sign * turned.x);
    return direction;
}

// Where the line from a point through what occludes it meets the plane of the light. fraction: the occluder's distance from
// that plane over the point's, in (0, 1).
vec3 hiddenPoint(vec3 point, vec3 occluder, float fraction) { return point + (occluder - point) / (1.0f - fraction); }
