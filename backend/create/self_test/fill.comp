#version 310 es
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x = 4) in;

layout(binding = 0, std430) buffer Colors { highp vec4 colors[4]; };

void main() {
    highp float level = float(gl_LocalInvocationID.x + 1u) * 16.0 / 255.0;
    colors[gl_LocalInvocationID.x] = vec4(level, 2.0 * level, 3.0 * level, 1.0);
}
