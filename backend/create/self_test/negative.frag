#version 310 es
#ifndef VULKAN
#extension GL_EXT_shader_framebuffer_fetch : require
#endif
// SPDX-License-Identifier: Apache-2.0
#ifdef VULKAN
layout(input_attachment_index = 0, set = 1, binding = 0) uniform highp subpassInput lightInput;
#else
layout(location = 0) inout highp vec4 light;
#endif

layout(location = 1) out highp vec4 negative;

void main() {
#ifdef VULKAN
    highp vec4 light = subpassLoad(lightInput);
#endif
    negative = vec4(1.0 - light.rgb, light.a);
}
