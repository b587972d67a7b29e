// SPDX-License-Identifier: Apache-2.0
// The four sets of texture coordinates of a glTF primitive: uv0, uv1, and two in custom0, which only meshes with more
// than two have. Before base_color.glsl. An array that constants index costs least, in bytes of the package too.

vec2 uvSets[4];

void readUvSets() {
    vec4 others = getCustom0();
    uvSets = vec2[4](getUV0(), getUV1(), others.xy, others.zw);
}
