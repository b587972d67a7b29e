// SPDX-License-Identifier: Apache-2.0
// The GLSL twin of ShaderInterface.h, placed before every shader. Names, offsets and sizes are equal: a test reflects
// this file and compares. Two records have other names than in C++, because materials use the C++ names for something
// else.

const int kAttributePosition = 0;
const int kAttributeTangents = 1;
const int kAttributeColor = 2;
const int kAttributeUv0 = 3;
const int kAttributeUv1 = 4;
const int kAttributeJoints = 5;
const int kAttributeWeights = 6;
const int kAttributeCustom0 = 7;
const int kAttributeInstance = 15;

const int kObjectsPerWindow = 256;
const int kFroxelCountBits = 9;
const int kMaxShadowMaps = 128;
const int kContactShadowBit = 128;
const int kMaxProbesOfView = 8;
const int kProfiledLightWords = 4;
const int kProfileHeaderWords = 3;
const float kImagedLightStep = 8192.0;
const int kImageHeaderWords = 4;

layout(set = 0, binding = 0, std140) uniform FrameUniforms {
    mat4 clipFromWorld; // the world is relative to the camera
    mat4 worldFromClip;
    mat4 viewFromWorld;
    mat4 clipFromView;
    vec4 cameraPosition;
    vec4 exposure;
    vec4 time;
    vec4 sunDirection;
    vec4 sunIlluminance;
    vec4 ambient;
    vec4 skyFactor;
    vec4 irradianceSh[9];
    mat4 worldFromEnvironment;
    vec4 materialGlobals[4];
    vec4 froxelGrid;
    vec4 froxelPlaces;
    vec4 fogMedium;
    vec4 fogLight;
    vec4 fogSun;
    vec4 fogSunDirection;
    vec4 fogGrid;
    vec4 fogScattering;
    vec4 fogNoise;
    vec4 fogVariation;
    vec4 contactShadows;
    vec4 skyGround;
    vec4 jitter;
#if defined(HAS_SECTION_PLANES)
    vec4 sectionPlanes[6];
    vec4 section;
    vec4 sectionCap;
    vec4 sectionHatch;
    vec4 sectionHatchColor;
#endif
} frameUniforms;

struct ObjectRecord {
    vec4 row0, row1, row2;
    vec4 flags;
};

layout(set = 0, binding = 1, std140) uniform ObjectUniforms {
    ObjectRecord objects[kObjectsPerWindow];
} objectUniforms;

struct PunctualLight {
    vec4 positionRange;
    vec4 colorIntensity;
    vec4 directionScale;
    vec4 offset;
};

layout(set = 0, binding = 2, std430) readonly buffer LightBuffer {
    PunctualLight lights[];
} lightBuffer;

layout(set = 0, binding = 3, std430) readonly buffer FroxelBuffer {
    uint words[];
} froxelBuffer;

layout(set = 1, binding = 0, std140) uniform PassUniforms {
    vec4 target;
    vec4 raster;
    vec4 picture;
    vec4 reflection;
    mat4 lastClipFromWorld;
    vec4 lastAlongView;
    vec4 lastTime;
} passUniforms;

layout(set = 1, binding = 1) uniform sampler2D passShadowMaps;

struct ShadowMapRecord {
    mat4 atlasFromWorld;
    vec4 tile;
    vec4 texel;
    vec4 softness;
};

layout(set = 1, binding = 2, std140) uniform ShadowUniforms {
    vec4 atlas;
    vec4 sun;
    ShadowMapRecord maps[kMaxShadowMaps];
} shadowUniforms;

layout(set = 1, binding = 3) uniform samplerCube passSpecular;
layout(set = 1, binding = 3) uniform samplerCubeArray passProbes; // instead, where quality_reflectionProbes is 1
layout(set = 1, binding = 4) uniform sampler2D passDfg;
layout(set = 1, binding = 5) uniform samplerCube passIrradiance;
layout(set = 1, binding = 6) uniform sampler2D passOcclusion;
layout(set = 1, binding = 7) uniform sampler2D passSceneDepth;
layout(set = 1, binding = 8) uniform samplerCube passFog;
layout(set = 1, binding = 9) uniform sampler2D passPicture;

layout(set = 1, binding = 10, std430) readonly buffer FogCells {
    uvec2 borders[];
} fogCells;

struct ProbeRecord {
    vec4 axes[3];
    vec4 center;
    vec4 capture;
    vec4 irradianceSh[9];
};

layout(set = 1, binding = 11, std140) uniform ProbeUniforms {
    ProbeRecord probes[kMaxProbesOfView];
} probeUniforms;
