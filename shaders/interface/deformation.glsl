// SPDX-License-Identifier: Apache-2.0
// Bind group 3, present in variants with kVariantSkinning: the GLSL twin of the part "deformation" of
// ShaderInterface.h. A test compares the two. Not in interface.glsl, because other variants lack the group.

const int kAttributeJoints1 = 13;
const int kAttributeWeights1 = 14;
const int kBonesPerRow = 512;
const int kMorphTextureWidth = 4096;

layout(set = 3, binding = 0) uniform highp sampler2D boneRows;

layout(set = 3, binding = 1, std140) uniform DeformationUniforms {
    vec4 shape;
    uvec4 bones;
} deformationUniforms;

layout(set = 3, binding = 2) uniform highp sampler2D morphDeltas;
