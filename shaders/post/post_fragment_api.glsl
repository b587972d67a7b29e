// SPDX-License-Identifier: Apache-2.0
// Fragment stage of post-process materials, before the material's own code. Subpass inputs (and, in the variant that is
// merged into the previous pass, currentPixel parameters) read colour attachments 0, 1, ... in the order of the
// parameters; the output is the attachment after the last of them.

struct PostProcessInputs {
    POST_OUTPUT_MEMBERS
};

// The pixel being written, or the texel at the same place in a texture of the target's size.
ivec2 getPixel() { return ivec2(gl_FragCoord.xy); }

// The value of a currentPixel parameter: getCurrentPixel(materialParams_color).
#if defined(VARIANT_MERGED)
#define getCurrentPixel(image) subpassLoad(image)
#else
#define getCurrentPixel(image) texelFetch(image, getPixel(), 0)
#endif

// In [0, 1]^2 over the target, which may be smaller than the view.
vec2 getNormalizedUV() { return gl_FragCoord.xy * passUniforms.target.zw; }
