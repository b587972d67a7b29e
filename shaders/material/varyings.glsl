// SPDX-License-Identifier: Apache-2.0
// Interpolated from the vertex to the fragment stage; VARYING is `out` or `in`. Only values that the material reads
// exist. The compiler adds the material's own variables from location 5 on. INTERPOLATION is empty or `flat`: flat
// gives a triangle all values of its last vertex, so that all of it is shaded alike, except for shadows and what
// else depends on the position.

#if defined(NEEDS_WORLD_POSITION)
layout(location = 0) VARYING vec3 vertex_worldPosition;
#endif
#if defined(NEEDS_NORMAL)
layout(location = 1) INTERPOLATION VARYING vec3 vertex_worldNormal;
#endif
#if defined(NEEDS_TANGENT)
layout(location = 2) INTERPOLATION VARYING vec4 vertex_worldTangent; // w: sign of the bitangent
#endif
#if defined(HAS_COLOR)
layout(location = 3) INTERPOLATION VARYING vec4 vertex_color;
#endif
#if defined(HAS_UV0) || defined(HAS_UV1)
layout(location = 4) INTERPOLATION VARYING vec4 vertex_uv01;
#endif
#if defined(NEEDS_INSTANCE_INDEX)
layout(location = 9) flat VARYING int vertex_instanceIndex;
#endif
