// SPDX-License-Identifier: Apache-2.0
// Fragment stage of post-process materials, what goes before the material's own code. Subpass inputs read colour
// attachments 0, 1, ... in the order of the parameters; the output is the attachment behind the last of them.

layout(location = POST_OUTPUT_LOCATION) out vec4 fragment_color;

struct PostProcessInputs {
    vec4 color;
};

// The pixel being written; the texel of the same place in a texture of the size of the picture.
ivec2 getPixel() { return ivec2(gl_FragCoord.xy); }
vec2 getNormalizedUV() { return gl_FragCoord.xy * passUniforms.target.zw; }
