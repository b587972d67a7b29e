// SPDX-License-Identifier: Apache-2.0
// Follows the author's code of materials that set pixelDepthOffset: what follows sees the surface's moved points.

highp vec3 surface_point;

// To the point `offset` metres behind the surface along the ray from the camera, or in a shadow map from the light.
// The depth changes by the difference of two points of that ray, so that without an offset it is that of the rasteriser,
// with its bias. Nearer points would be hidden where the surface is, so there are none.
void moveSurface(highp float offset) {
    highp vec3 back = shading_view * max(offset, 0.0);
    surface_point = vertex_worldPosition - back;
    highp vec4 from = frameUniforms.clipFromWorld * vec4(vertex_worldPosition, 1.0);
    highp vec4 to = frameUniforms.clipFromWorld * vec4(surface_point, 1.0);
    gl_FragDepth = clamp(gl_FragCoord.z + (to.z / to.w - from.z / from.w), 0.0, 1.0);
}

#if defined(HAS_SECTION_PLANES)
#undef vertex_worldPosition
#endif
#define vertex_worldPosition surface_point
