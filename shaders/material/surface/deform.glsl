// SPDX-License-Identifier: Apache-2.0
// Skins and morph targets in the vertex stage of variants with kVariantSkinning: first the targets, then the skin (glTF
// 2.0, sections 3.7.2.2 and 3.7.3.3). The rest of the stage uses the result as its mesh.
// The result is finite for any bones: a normal or tangent that a bone collapses is not changed.

layout(location = kAttributeJoints) in uvec4 mesh_joints;
layout(location = kAttributeWeights) in vec4 mesh_weights;
#if defined(EIGHT_JOINTS)
layout(location = kAttributeJoints1) in uvec4 mesh_joints1;
layout(location = kAttributeWeights1) in vec4 mesh_weights1;
#endif

const int kRowTexels = 3 * kBonesPerRow;

uvec4 skinBones() { return deformationUniforms.bones; }
vec4 morphShape() { return deformationUniforms.shape; }

uint objectIndex(); // vertex_api.glsl

// Where the pose of this instance begins in boneRows, now or in the previous frame; see kBonesPerRow.
float poseBegin() { return objectUniforms.objects[objectIndex()].flags.w; }

ivec2 texelOfBone(uint bone) { return ivec2(bone % uint(kBonesPerRow) * 3u, bone / uint(kBonesPerRow)); }
ivec2 nextTexel(ivec2 at) { return at.x + 1 < kRowTexels ? ivec2(at.x + 1, at.y) : ivec2(0, at.y + 1); }

vec2 pose; // x: weights that are not 0; y: the first bone
vec3 deformedPosition;
vec4 skinRow0, skinRow1, skinRow2; // of the matrix from the bind pose to object space

// The texel of one target and this vertex. `part`: 0 position, 1 normal, 2 tangent.
vec3 morphDelta(int target, int part) {
    int texels = int(morphShape().y), vertices = int(morphShape().z);
    int at = (target * vertices + gl_VertexIndex) * texels + part;
    return texelFetch(morphDeltas, ivec2(at % kMorphTextureWidth, at / kMorphTextureWidth), 0).xyz;
}

vec3 morphed(vec3 value, int part) {
    int count = int(pose.x);
    ivec2 at = texelOfBone(uint(poseBegin()));
    for (int i = 0; i < count; ++i) {
        at = nextTexel(at);
        vec2 target = texelFetch(boneRows, at, 0).xy;
        value += target.x * morphDelta(int(target.y), part);
    }
    return value;
}

void addBones(uvec4 joints, vec4 weights) {
    uint first = uint(pose.y);
    for (int k = 0; k < 4; ++k) {
        ivec2 at = texelOfBone(first + min(joints[k], skinBones().y));
        skinRow0 += weights[k] * texelFetch(boneRows, at, 0);
        skinRow1 += weights[k] * texelFetch(boneRows, at + ivec2(1, 0), 0);
        skinRow2 += weights[k] * texelFetch(boneRows, at + ivec2(2, 0), 0);
    }
}

bool hasSkin() { return morphShape().w > 0.0 && pose.y <= float(skinBones().x); }

vec3 normalizeOr(vec3 v, vec3 fallback) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if (!(largest > 1e-30)) return fallback;
    vec3 scaled = v / largest; // so that the square neither underflows nor overflows
    return scaled * inversesqrt(dot(scaled, scaled));
}

vec2 readPose() {
    float begin = poseBegin();
    if (morphShape().y > 0.0 && begin < float(skinBones().z)) return texelFetch(boneRows, texelOfBone(uint(begin)), 0).xy;
    return vec2(0.0, begin);
}

void deformPosition(vec3 position) {
    pose = readPose();
    deformedPosition = morphed(position, 0);
    if (!hasSkin()) return;
    skinRow0 = skinRow1 = skinRow2 = vec4(0.0);
    addBones(mesh_joints, mesh_weights);
#if defined(EIGHT_JOINTS)
    if (morphShape().w > 1.0) addBones(mesh_joints1, mesh_weights1);
#endif
    vec4 p = vec4(deformedPosition, 1.0);
    deformedPosition = vec3(dot(skinRow0, p), dot(skinRow1, p), dot(skinRow2, p));
}

// Call after deformPosition(). Normals are transformed by the cofactor matrix, the inverse transpose times the
// determinant. Returns -1 if the bones mirror, otherwise 1.
float deformFrame(inout vec3 normal, inout vec3 tangent) {
    if (morphShape().y > 1.0) normal = morphed(normal, 1);
    if (morphShape().y > 2.0) tangent = morphed(tangent, 2);
    if (!hasSkin()) return 1.0;
    vec3 cofactor0 = cross(skinRow1.xyz, skinRow2.xyz);
    vec3 cofactor1 = cross(skinRow2.xyz, skinRow0.xyz);
    vec3 cofactor2 = cross(skinRow0.xyz, skinRow1.xyz);
    float mirror = dot(skinRow0.xyz, cofactor0) < 0.0 ? -1.0 : 1.0;
    vec3 turned = vec3(dot(cofactor0, normal), dot(cofactor1, normal), dot(cofactor2, normal)) * mirror;
    vec3 along = vec3(dot(skinRow0.xyz, tangent), dot(skinRow1.xyz, tangent), dot(skinRow2.xyz, tangent));
    normal = normalizeOr(turned, normal);
    tangent = normalizeOr(along, tangent);
    return mirror;
}
