// SPDX-License-Identifier: Apache-2.0
// Vertex stage of surface materials, before the material's own code: attributes, MaterialVertexInputs and the functions
// of the guide, 4.5.6.

#if defined(FULL_SCREEN_TRIANGLE)
// Covers the screen at the far plane without attributes: (-1, -1), (3, -1), (-1, 3).
vec3 meshPosition() {
    return vec3(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, frameUniforms.exposure.w);
}
#else
layout(location = kAttributePosition) in vec3 mesh_position;
#if defined(VARIANT_SKINNING)
vec3 meshPosition() { return deformedPosition; }
#else
vec3 meshPosition() { return mesh_position; }
#endif
#endif
#if defined(NEEDS_NORMAL)
layout(location = kAttributeTangents) in vec4 mesh_tangents;
#endif
#if defined(HAS_COLOR)
layout(location = kAttributeColor) in vec4 mesh_color;
#endif
#if defined(HAS_UV0)
layout(location = kAttributeUv0) in vec2 mesh_uv0;
#endif
#if defined(HAS_UV1)
layout(location = kAttributeUv1) in vec2 mesh_uv1;
#endif
#if defined(VERTEX_DOMAIN_OBJECT) || defined(INSTANCED)
layout(location = kAttributeInstance) in uint mesh_instance;
#if defined(VARIANT_MOTION)
uint objectIndex() { return mesh_instance + (isLastFrame ? 1u : 0u); } // two records an object: now, and then
#else
uint objectIndex() { return mesh_instance; }
#endif
#endif

#if defined(SIZED_POINTS)
// The four corners of a point follow each other, counter-clockwise as y points down; of mirrored objects the other way.
vec2 getPointCorner() {
    int corner = gl_VertexIndex & 3;
    float side = 1.0;
#if defined(VERTEX_DOMAIN_OBJECT)
    side = objectUniforms.objects[objectIndex()].flags.x;
#endif
    return vec2(corner == 1 || corner == 2 ? side : -side, corner >= 2 ? -1.0 : 1.0);
}
#endif

vec4 getPosition() { return vec4(meshPosition(), 1.0); }
int getVertexIndex() { return gl_VertexIndex; }
#if defined(INSTANCED)
// The index that the application gave the renderable; it does not reveal which renderables share a draw call.
int getInstanceIndex() { return int(objectUniforms.objects[objectIndex()].flags.y); }
int filament_instanceId() { return getInstanceIndex(); } // what OpenGL calls it in authors' code
#else
int filament_instanceId() { return 0; }
#endif

#if defined(VERTEX_DOMAIN_OBJECT)

// The camera's position if objects are not relative to it (Quality::cameraRelative); otherwise 0, and x - 0 is x.
vec3 objectOrigin() { return frameUniforms.cameraPosition.xyz * frameUniforms.cameraPosition.w; }

mat4 getWorldFromModelMatrix() {
    ObjectRecord object = objectUniforms.objects[objectIndex()];
    mat4 m = transpose(mat4(object.row0, object.row1, object.row2, vec4(0.0, 0.0, 0.0, 1.0)));
    m[3].xyz -= objectOrigin();
    return m;
}

// The cofactor matrix: the inverse transpose times the determinant, which also exists for singular matrices. Its sign
// is that of the determinant, hence the flag of mirrored objects.
mat3 getWorldFromModelNormalMatrix() {
    ObjectRecord object = objectUniforms.objects[objectIndex()];
    vec3 row0 = cross(object.row1.xyz, object.row2.xyz);
    vec3 row1 = cross(object.row2.xyz, object.row0.xyz);
    vec3 row2 = cross(object.row0.xyz, object.row1.xyz);
    return transpose(mat3(row0, row1, row2)) * object.flags.x;
}

vec4 worldPositionOf(vec4 p) {
    ObjectRecord object = objectUniforms.objects[objectIndex()];
    vec3 position = vec3(dot(object.row0, p), dot(object.row1, p), dot(object.row2, p));
    return vec4(position - objectOrigin(), 1.0);
}

vec3 directionToWorld(vec3 d) {
    ObjectRecord object = objectUniforms.objects[objectIndex()];
    return vec3(dot(object.row0.xyz, d), dot(object.row1.xyz, d), dot(object.row2.xyz, d));
}

vec3 normalToWorld(vec3 n) { return getWorldFromModelNormalMatrix() * n; }
float bitangentSign() { return objectUniforms.objects[objectIndex()].flags.x; }

#else

mat4 getWorldFromModelMatrix() { return mat4(1.0); }
mat3 getWorldFromModelNormalMatrix() { return mat3(1.0); }

vec4 worldPositionOf(vec4 p) {
#if defined(VERTEX_DOMAIN_WORLD)
    return vec4(p.xyz - frameUniforms.cameraPosition.xyz, 1.0);
#elif defined(VERTEX_DOMAIN_VIEW)
    return getWorldFromViewMatrix() * p;
#else
    vec4 world = frameUniforms.worldFromClip * p;
    return world.w != 0.0 ? world / world.w : world; // w = 0: a direction, the far plane is at infinity
#endif
}

vec3 directionToWorld(vec3 d) {
#if defined(VERTEX_DOMAIN_VIEW)
    return mat3(getWorldFromViewMatrix()) * d;
#else
    return d;
#endif
}

vec3 normalToWorld(vec3 n) { return directionToWorld(n); }
float bitangentSign() { return 1.0; }

#endif

vec4 worldPositionOfVertex() { return worldPositionOf(getPosition()); }
vec3 getUserWorldPosition() { return worldPositionOfVertex().xyz + frameUniforms.cameraPosition.xyz; }

struct MaterialVertexInputs {
#if defined(HAS_COLOR)
    vec4 color; // if the material requires it, as uv0 and uv1
#endif
#if defined(HAS_UV0)
    vec2 uv0;   // flipped with flipUV
#endif
#if defined(HAS_UV1)
    vec2 uv1;   // flipped with flipUV
#endif
#if defined(NEEDS_NORMAL)
    vec3 worldNormal; // if the material has normals
#endif
#if defined(HAS_CLIP_SPACE_TRANSFORM)
    mat4 clipSpaceTransform; // of positions in the device domain, if the code uses it
#endif
#if defined(WIDE_LINES)
    float lineWidth; // with wideLines: pixels, 1 to 1024
    vec4 lineEnd;    // with wideLines: the other end of the segment, in the space of worldPosition
#endif
#if defined(SIZED_POINTS)
    float pointPixels; // with sizedPoints: the side of the square in pixels, at most 1024
    float pointMeters; // with sizedPoints: the same in metres; the larger of both counts
#endif
    MATERIAL_VARIABLES_AS_MEMBERS
#if defined(HAS_CLIP_SPACE_POSITION)
    vec4 clipSpacePosition; // where the vertex is drawn, with y down, instead of at worldPosition, if the code uses it
#endif
    vec4 worldPosition; // in the world, also where the mesh has other positions; w is not used
};

vec2 meshUv(vec2 uv) {
#if defined(FLIP_UV)
    return vec2(uv.x, 1.0 - uv.y);
#else
    return uv;
#endif
}
