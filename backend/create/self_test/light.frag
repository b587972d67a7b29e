#version 310 es
// SPDX-License-Identifier: Apache-2.0
layout(binding = 0, std430) readonly buffer Colors { highp vec4 colors[4]; };

layout(location = 0) out highp vec4 light;

void main() {
    light = colors[int(gl_FragCoord.x) & 3];
}
