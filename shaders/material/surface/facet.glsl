// SPDX-License-Identifier: Apache-2.0
// The plane of the triangle that a fragment belongs to, from the derivatives of its position.

// Its normal, unit and of any side; zero where the triangle is too small.
highp vec3 shading_facet;
// From this pixel to its neighbours.
highp vec3 shading_right, shading_down;

void computeFacet() {
#if defined(HAS_SECTION_PLANES)
    highp vec3 dx = section_right, dy = section_down;
#else
    highp vec3 dx = dFdx(vertex_worldPosition), dy = dFdy(vertex_worldPosition);
#endif
    shading_right = dx;
    shading_down = dy;
    highp float largestX = max(max(abs(dx.x), abs(dx.y)), abs(dx.z));
    highp float largestY = max(max(abs(dy.x), abs(dy.y)), abs(dy.z));
    shading_facet = vec3(0.0);
    if (largestX > 0.0 && largestY > 0.0) shading_facet = normalizeOrZero(cross(dx / largestX, dy / largestY));
}
