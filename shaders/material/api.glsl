// SPDX-License-Identifier: Apache-2.0
// Available to every material in both stages: type names, mathematics, frame constants (materials guide, 4.5.1 to
// 4.5.4).
// "World" is camera-relative world space: its axes are the user's, its origin is the camera.

#define bool2 bvec2
#define bool3 bvec3
#define bool4 bvec4
#define int2 ivec2
#define int3 ivec3
#define int4 ivec4
#define uint2 uvec2
#define uint3 uvec3
#define uint4 uvec4
#define float2 vec2
#define float3 vec3
#define float4 vec4
#define float3x3 mat3
#define float4x4 mat4

const float PI = kPi;
const float HALF_PI = 0.5 * kPi;

vec2 saturate(vec2 x) { return clamp(x, 0.0, 1.0); }
vec4 saturate(vec4 x) { return clamp(x, 0.0, 1.0); }
vec2 sq(vec2 x) { return x * x; }
vec3 sq(vec3 x) { return x * x; }
vec4 sq(vec4 x) { return x * x; }
vec2 pow5(vec2 x) { return x * sq(x * x); }
vec3 pow5(vec3 x) { return x * sq(x * x); }
vec4 pow5(vec4 x) { return x * sq(x * x); }
float max3(vec3 v) { return max(v.x, max(v.y, v.z)); }
float min3(vec3 v) { return min(v.x, min(v.y, v.z)); }
float vmax(vec2 v) { return max(v.x, v.y); }
float vmax(vec3 v) { return max3(v); }
float vmax(vec4 v) { return max(vmax(v.xy), vmax(v.zw)); }
float vmin(vec2 v) { return min(v.x, v.y); }
float vmin(vec3 v) { return min3(v); }
float vmin(vec4 v) { return min(vmin(v.xy), vmin(v.zw)); }

// False colours of [0, 1], from blue over green to red: of each a parabola that is 1 at its place, and 0 at 10/21
// beside it.
vec3 heatmap(float v) { return vec3(1.0) - sq((vec3(v) - vec3(6.0, 3.8, 1.0) / 7.0) * 2.1); }
mat3 cofactor(mat3 m) { return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])); }
vec4 mulMat4x4Float3(mat4 m, vec3 v) { return m * vec4(v, 1.0); }
vec3 mulMat3x3Float3(mat4 m, vec3 v) { return mat3(m) * v; }

// A zero vector stays zero instead of becoming NaN: the result for zero scales and collapsed tangents.
vec3 normalizeOrZero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

mat4 getWorldFromClipMatrix() { return frameUniforms.worldFromClip; }
mat4 getClipFromViewMatrix() { return frameUniforms.clipFromView; }
mat4 getViewFromWorldMatrix() { return frameUniforms.viewFromWorld; }
mat4 getWorldFromViewMatrix() { return transpose(frameUniforms.viewFromWorld); } // a rotation: the camera is the origin
mat4 getViewFromClipMatrix() { return frameUniforms.viewFromWorld * frameUniforms.worldFromClip; }
mat4 getUserWorldFromWorldMatrix() {
    mat4 translation = mat4(1.0);
    translation[3].xyz = frameUniforms.cameraPosition.xyz;
    return translation;
}

vec4 getResolution() { return passUniforms.target; }
vec3 getWorldCameraPosition() { return vec3(0.0); }
vec3 getWorldOffset() { return frameUniforms.cameraPosition.xyz; }
#if defined(VARIANT_MOTION)
bool isLastFrame = false; // what follows is computed as it was then
vec4 frameTime() { return isLastFrame ? passUniforms.lastTime : frameUniforms.time; }
#else
vec4 frameTime() { return frameUniforms.time; }
#endif
#if defined(VARIANT_MOTION)
mat4 getClipFromWorldMatrix() { return isLastFrame ? passUniforms.lastClipFromWorld : frameUniforms.clipFromWorld; }
#else
mat4 getClipFromWorldMatrix() { return frameUniforms.clipFromWorld; }
#endif
int getEyeIndex() { return 0; } // a view has one eye
mat4 getEyeFromViewMatrix() { return mat4(1.0); }
mat4 getEyeFromViewMatrix(int) { return mat4(1.0); }
mat4 getClipFromWorldMatrix(int) { return getClipFromWorldMatrix(); }
bool isPerspectiveProjection() { return frameUniforms.clipFromView[2].w != 0.0; }
vec2 uvToRenderTargetUV(vec2 uv) { return uv; } // row 0 is the top row on both APIs
float getTime() { return frameTime().z; }
vec4 getUserTime() { return vec4(frameTime().xy, 0.0, 0.0); }
float getUserTimeMod(float m) { return timeModulo(frameTime().x, frameTime().y, m); }
float getExposure() { return frameUniforms.exposure.x; }
float getEV100() { return frameUniforms.exposure.y; }

vec4 getMaterialGlobal0() { return frameUniforms.materialGlobals[0]; }
vec4 getMaterialGlobal1() { return frameUniforms.materialGlobals[1]; }
vec4 getMaterialGlobal2() { return frameUniforms.materialGlobals[2]; }
vec4 getMaterialGlobal3() { return frameUniforms.materialGlobals[3]; }
