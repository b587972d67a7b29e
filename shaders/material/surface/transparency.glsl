// SPDX-License-Identifier: Apache-2.0
// What a surface that blends writes where such surfaces are composed in any order (passes/TransparencyPass.h).
// quality_transparency is a shader::TransparencyTerm.

const int kTransparencyWeightedLight = 1;
const int kTransparencyCover = 2;
const int kTransparencyDepth = 3;
const int kTransparencyNextDepth = 4;
const int kTransparencyLayer = 5;
const int kTransparencyBeyond = 6;

// How much nearer to the camera this fragment is than the layer, in whatever the depth buffer counts.
highp float nearerThanLayer() {
    highp float layer = texelFetch(passOcclusion, ivec2(gl_FragCoord.xy), 0).x;
    return frameUniforms.exposure.w > 0.0 ? layer - gl_FragCoord.z : gl_FragCoord.z - layer; // w: depth of infinity
}

// After the code of the material, whose textures need their neighbours.
void keepLayer(float alpha) {
    bool isKept = true;
    if (quality_transparency == kTransparencyNextDepth || quality_transparency == kTransparencyBeyond) {
        isKept = nearerThanLayer() < 0.0;
    } else if (quality_transparency == kTransparencyLayer) {
        isKept = nearerThanLayer() == 0.0;
    }
#if defined(BLEND_MODE_FADE)
    // What covers nothing is no layer. In other modes it may shine.
    if (quality_transparency == kTransparencyDepth || quality_transparency == kTransparencyNextDepth) {
        isKept = isKept && alpha > 0.0;
    }
#endif
    if (!isKept) discard;
}

vec4 composedColor(vec4 color) {
    vec4 composed = color;
    if (quality_transparency == kTransparencyWeightedLight) {
        mat4 clip = frameUniforms.clipFromView;
        highp float meters =
                distanceFromDepth(gl_FragCoord.z, vec2(clip[2].z, clip[3].z), vec2(clip[2].w, clip[3].w));
        composed = weightedSurface(color, transparencyWeight(meters, frameUniforms.jitter.z));
    } else if (quality_transparency == kTransparencyCover) {
        composed = vec4(countedAlpha(color.a));
    } else if (quality_transparency == kTransparencyDepth || quality_transparency == kTransparencyNextDepth) {
        composed = vec4(0.0);
    }
    return composed;
}
