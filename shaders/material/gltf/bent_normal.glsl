// SPDX-License-Identifier: Apache-2.0
// FILAMENT_bent_normal: the mean direction from which ambient light arrives. Its map is that of the occlusion, in whose
// frame it is: x along u, y against v, both in the plane of the vertices' normal. The frame follows from the derivatives
// over the screen (Schueler, "Normal Mapping without Precomputed Tangents", ShaderX 5, 2006), so that the coordinates of
// a bake need no tangents.

#if defined(HAS_BENT_NORMAL) && defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
// Codes 1 to 255 stand for -1 to 1, so that 128 is straight up. What tilts the shading normal tilts this one as much.
void gltfBend(highp vec2 codes, highp vec2 uv) {
    highp vec3 across = dFdx(vertex_worldPosition), down = dFdy(vertex_worldPosition);
    highp vec2 uvAcross = dFdx(uv), uvDown = dFdy(uv);
    highp float side = sign(uvAcross.x * uvDown.y - uvDown.x * uvAcross.y);
    highp vec3 alongU = (across * uvDown.y - down * uvAcross.y) * side;
    highp vec3 againstV = (across * uvDown.x - down * uvAcross.x) * side;
    highp vec3 n = shading_geometricNormal;
    highp vec3 right = alongU - n * dot(alongU, n);
    highp float width = max(max(abs(right.x), abs(right.y)), abs(right.z));
    if (side == 0.0 || !(width > 1e-30)) return; // the triangle is too small to tell
    right = normalizeOrZero(right / width);
    highp vec3 up = cross(n, right);
    if (dot(up, againstV) < 0.0) up = -up;
    highp vec2 bend = codes * (255.0 / 127.0) - 128.0 / 127.0;
    highp float height = sqrt(max(1.0 - dot(bend, bend), 0.0));
    shading_bentNormal = normalizeOrZero(right * bend.x + up * bend.y + n * height + (shading_normal - n));
}
#else
void gltfBend(highp vec2 codes, highp vec2 uv) {} // nothing is lit
#endif

// After what tilts the normal. Without such a map ambient light arrives around it.
void gltfUnbent() {
#if defined(HAS_BENT_NORMAL) && defined(NEEDS_NORMAL)
    if (!materialConstants_hasBentNormals) shading_bentNormal = shading_normal;
#endif
}
