#version 310 es
// SPDX-License-Identifier: Apache-2.0
// One triangle over everything; its depth rises from left to right and is 0.5 in the middle.
#ifdef VULKAN
#define gl_VertexID gl_VertexIndex
#endif

void main() {
    highp vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.5 + 0.125 * corner.x, 1.0);
}
