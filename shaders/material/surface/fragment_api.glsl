// SPDX-License-Identifier: Apache-2.0
// Fragment stage of surface materials, before the material's own code: prepareMaterial() and the functions of the
// guide, 4.5.7. MaterialInputs and initMaterial() come from the compiler (MaterialMembers.cpp).

#if !defined(DEPTH_RUNS_MATERIAL) // only in depth variants
layout(location = 0) out vec4 fragment_color;
#endif

// Grazing views would divide by zero in the visibility term and read outside the DFG table.
const float kMinNoV = 1e-4;

// A uniform that conditions read. Mesa's Vulkan driver may compile a stage for the values of uniforms that alone decide
// a condition, during motion again in each frame: to it, this one belongs to the fragment. gl_FragCoord.x is
// positive. (Its w is not: with several samples it is that of the pixel's middle, where the triangle's plane may lie behind
// the camera.) tests/filament_core/engine/CompilationsTest.cpp
highp float ofFragment(highp float uniformValue) { return gl_FragCoord.x > 0.0 ? uniformValue : 0.0; }

// Filled by main() and prepareMaterial().
mat3 shading_tangentToWorld;
vec3 shading_geometricNormal;
vec3 shading_normal;
vec3 shading_view;
vec3 shading_reflected;
float shading_NoV;
#if defined(HAS_NORMAL)
bool shading_isBumped; // the normal differs from the geometry's own
#endif
#if defined(HAS_CLEAR_COAT)
vec3 shading_clearCoatNormal;
#endif
#if defined(HAS_BENT_NORMAL)
vec3 shading_bentNormal;
#endif

#if defined(NEEDS_WORLD_POSITION)
vec3 getWorldPosition() { return vertex_worldPosition; }
vec3 getUserWorldPosition() { return vertex_worldPosition + frameUniforms.cameraPosition.xyz; }
vec3 getWorldViewVector() { return shading_view; }
#endif
#if defined(NEEDS_NORMAL)
mat3 getWorldTangentFrame() { return shading_tangentToWorld; }
vec3 getWorldNormalVector() { return shading_normal; }
vec3 getWorldGeometricNormalVector() { return shading_geometricNormal; }
#endif
#if defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
vec3 getWorldReflectedVector() { return shading_reflected; }
float getNdotV() { return shading_NoV; }
#endif
#if defined(HAS_COLOR)
vec4 getColor() { return vertex_color; }
#endif
#if defined(HAS_UV0)
vec2 getUV0() { return vertex_uv01.xy; }
#endif
#if defined(HAS_UV1)
vec2 getUV1() { return vertex_uv01.zw; }
#endif
#if defined(NEEDS_INSTANCE_INDEX)
int getInstanceIndex() { return vertex_instanceIndex; }
#endif
#if defined(BLEND_MODE_MASKED)
float getMaskThreshold() { return materialParams._maskThreshold; }
#endif
vec3 getNormalizedPhysicalViewportCoord() { return vec3(gl_FragCoord.xy * passUniforms.target.zw, gl_FragCoord.z); }
// Without a guard band (frameUniforms.jitter.w pixels on every side) the same, to the bit.
vec3 getNormalizedViewportCoord() {
    highp vec3 place = getNormalizedPhysicalViewportCoord();
    highp vec2 inside = passUniforms.target.xy - 2.0 * frameUniforms.jitter.w;
    return vec3(place.xy * (passUniforms.target.xy / inside) - frameUniforms.jitter.w / inside, place.z);
}

#if defined(NEEDS_WORLD_POSITION)
// The camera is the origin; a parallel projection looks along the same direction everywhere.
vec3 towardsCamera(highp vec3 point) {
    highp mat4 view = frameUniforms.viewFromWorld;
    vec3 towards = normalizeOrZero(-point);
    if (ofFragment(frameUniforms.clipFromView[3].w) != 0.0) towards = vec3(view[0].z, view[1].z, view[2].z);
    return towards;
}
#endif

// The geometry's values before material(): view vector and tangent frame.
void computeShadingGeometry() {
#if defined(NEEDS_WORLD_POSITION)
    shading_view = towardsCamera(vertex_worldPosition);
#endif
#if defined(NEEDS_NORMAL)
    vec3 n = vertex_worldNormal;
#if defined(NEEDS_TANGENT)
    // Interpolated and not normalised, as MikkTSpace specifies: only the result of the normal map is normalised.
    vec3 t = vertex_worldTangent.xyz;
    vec3 b = cross(n, t) * vertex_worldTangent.w;
#else
    vec3 t = vec3(0.0), b = vec3(0.0);
#endif
#if defined(DOUBLE_SIDED) || defined(DOUBLE_SIDED_BY_PARAMETER)
    // The back is the same surface seen from behind: its whole frame is reversed.
    float side = gl_FrontFacing ? 1.0 : -1.0;
#if defined(DOUBLE_SIDED_BY_PARAMETER)
    if (!materialParams._doubleSided) side = 1.0;
#endif
    n *= side;
    t *= side;
    b *= side;
#endif
    shading_tangentToWorld = mat3(t, b, n);
    shading_geometricNormal = normalizeOrZero(n);
    shading_normal = shading_geometricNormal;
#endif
}

void prepareMaterial(const MaterialInputs material) {
#if defined(NEEDS_NORMAL) && defined(HAS_NORMAL)
    shading_normal = normalizeOrZero(shading_tangentToWorld * material.normal);
    shading_isBumped = material.normal != vec3(0.0, 0.0, 1.0);
#endif
#if defined(HAS_BENT_NORMAL)
    shading_bentNormal = normalizeOrZero(shading_tangentToWorld * material.bentNormal);
#endif
#if defined(HAS_CLEAR_COAT_NORMAL) && defined(HAS_CLEAR_COAT)
    shading_clearCoatNormal = normalizeOrZero(shading_tangentToWorld * material.clearCoatNormal);
#elif defined(HAS_CLEAR_COAT)
    shading_clearCoatNormal = shading_geometricNormal;
#endif
#if defined(NEEDS_NORMAL) && defined(NEEDS_WORLD_POSITION)
    shading_NoV = max(dot(shading_normal, shading_view), kMinNoV);
    shading_reflected = reflect(-shading_view, shading_normal);
#endif
}
