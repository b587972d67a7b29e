// SPDX-License-Identifier: Apache-2.0
// Vertex stage of post-process materials: one triangle that covers the screen, computed from the vertex index alone.
// Vertices 0, 1, 2 are (-1, -1), (3, -1), (-1, 3); depth 0 is the far plane.

void main() {
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
