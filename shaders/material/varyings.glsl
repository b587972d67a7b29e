// SPDX-License-Identifier: Apache-2.0
// What goes from the vertex to the fragment stage; VARYING is `out` or `in`. Only what the material reads exists.
// The compiler adds the material's own variables at locations 5 and up.

#if defined(NEEDS_WORLD_POSITION)
layout(location = 0) VARYING vec3 vertex_worldPosition;
#endif
#if defined(NEEDS_NORMAL)
layout(location = 1) VARYING vec3 vertex_worldNormal;
#endif
#if defined(NEEDS_TANGENT)
layout(location = 2) VARYING vec4 vertex_worldTangent; // w: sign of the bitangent
#endif
#if defined(HAS_COLOR)
layout(location = 3) VARYING vec4 vertex_color;
#endif
#if defined(HAS_UV0) || defined(HAS_UV1)
layout(location = 4) VARYING vec4 vertex_uv01;
#endif
