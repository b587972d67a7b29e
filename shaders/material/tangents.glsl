// SPDX-License-Identifier: Apache-2.0
// The frame that the attribute `tangents` encodes, for authors who read one from a custom attribute or a texture.

#include "shaders/lib/tangent.glsl"

void toTangentFrame(vec4 q, out vec3 n) {
    vec3 t, b;
    tangentFrame(q, n, t, b);
}
void toTangentFrame(vec4 q, out vec3 n, out vec3 t) {
    vec3 b;
    tangentFrame(q, n, t, b);
}
