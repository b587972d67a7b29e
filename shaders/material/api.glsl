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
vec4 mulMat4x4Float3(mat4 m, vec3 v) { return m * vec4(v, 1.0); }
vec3 mulMat3x3Float3(mat4 m, vec3 v) { return mat3(m) * v; }

// A zero vector stays zero instead of becoming NaN: the result for zero scales and collapsed tangents.
vec3 normalizeOrZero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

mat4 getClipFromWorldMatrix() { return frameUniforms.clipFromWorld; }
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
float getTime() { return frameTime().z; }
vec4 getUserTime() { return vec4(frameTime().xy, 0.0, 0.0); }
float getUserTimeMod(float m) { return timeModulo(frameTime().x, frameTime().y, m); }
float getExposure() { return frameUniforms.exposure.x; }
float getEV100() { return frameUniforms.exposure.y; }

vec4 getMaterialGlobal0() { return frameUniforms.materialGlobals[0]; }
vec4 getMaterialGlobal1() { return frameUniforms.materialGlobals[1]; }
vec4 getMaterialGlobal2() { return frameUniforms.materialGlobals[2]; }
vec4 getMaterialGlobal3() { return frameUniforms.materialGlobals[3]; }
