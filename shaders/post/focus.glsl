// SPDX-License-Identifier: Apache-2.0
// Shared by the passes of depth of field; included after shaders/lib/distance.glsl. The material has the parameter
// `focus`: the members of prepare::Focus.

// Radius of the disc, in pixels, of a point at the depth of a depth buffer; < 0: in front of the focus.
float blurOfDepth(float depth) {
    mat4 clip = getClipFromViewMatrix();
    float nearness = 0.0;
    if (depth != frameUniforms.exposure.w) {
        nearness = 1.0 / distanceFromDepth(depth, vec2(clip[2].z, clip[3].z), vec2(clip[2].w, clip[3].w));
    }
    float most = materialParams.focus.z;
    return clamp(materialParams.focus.x - materialParams.focus.y * nearness, -most, most);
}
