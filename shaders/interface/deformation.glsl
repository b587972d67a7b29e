// SPDX-License-Identifier: Apache-2.0
// Bind group 3, present in variants with kVariantSkinning: the GLSL twin of the part "deformation" of
// ShaderInterface.h. A test compares the two. Not in interface.glsl, because other variants lack the group.

const int kAttributeJoints1 = 13;
const int kAttributeWeights1 = 14;
const int kMaxBones = 256;
const int kMaxMorphTargets = 256;
const int kMorphTextureWidth = 4096;

struct BoneRecord {
    vec4 row0, row1, row2;
};

layout(set = 3, binding = 0, std140) uniform BoneUniforms {
    BoneRecord bones[kMaxBones];
} boneUniforms;

layout(set = 3, binding = 1, std140) uniform MorphUniforms {
    vec4 shape;
    vec4 targets[kMaxMorphTargets];
} morphUniforms;

layout(set = 3, binding = 2) uniform highp sampler2D morphDeltas;

#if defined(VARIANT_MOTION)
layout(set = 3, binding = 3, std140) uniform LastBoneUniforms {
    BoneRecord bones[kMaxBones];
} lastBoneUniforms;

layout(set = 3, binding = 4, std140) uniform LastMorphUniforms {
    vec4 shape;
    vec4 targets[kMaxMorphTargets];
} lastMorphUniforms;
#endif
