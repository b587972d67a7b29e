// SPDX-License-Identifier: Apache-2.0
// The scene colour behind a refractive surface (kBindingPicture): the light of the pixel at which the ray leaves the
// object, blurred as much as the object's roughness blurs surfaces that far behind it. Off-screen the environment
// replaces it.

const highp float kPictureBorder = 0.0625; // of the view's height: off-screen its edge fades to the environment
const highp float kLeastNearness = 1e-6;   // 1 / m

#include "shaders/material/surface/scene_color_texel.glsl"

struct Behind {
    highp vec3 light;       // pre-exposed, times its share
    highp vec3 environment; // the share left to the environment
    highp float level;      // of the scene colour that green is read from
};

// Of one colour channel, or all.
struct Look {
    highp vec3 light;
    highp float share;
    highp float level;
};

Behind nothingBehind() { return Behind(vec3(0.0), vec3(1.0), 0.0); }

// The width in pixels of the lobe from `distance` to 1 / nearness, both linear depths in metres.
highp float blurredPixels(highp float deviation, highp float distance, highp float nearness) {
    highp float perTangent = 0.5 * abs(frameUniforms.clipFromView[1].y) * passUniforms.target.y;
    highp float way;
    if (ofFragment(frameUniforms.clipFromView[3].w) == 0.0) {
        way = 1.0 - distance * nearness; // perspective: for distant surfaces, pixels are tangents
    } else {
        way = 1.0 / max(nearness, kLeastNearness) - distance;
    }
    return deviation * perTangent * max(way, 0.0);
}

// 1 on screen, less outside.
highp float shareOfPicture(highp vec2 pixel) {
    highp vec2 end = min(passUniforms.picture.zw, passUniforms.target.xy);
    highp vec2 beyond = max(passUniforms.picture.xy - pixel, pixel - end);
    return saturate(1.0 - max(max(beyond.x, beyond.y), 0.0) / (kPictureBorder * passUniforms.target.y));
}

// offset: from this point of the surface to where the ray leaves the object, in metres. deviation: of the rough lobe.
Look lookAt(highp vec3 offset, highp float deviation) {
    highp vec3 exit = vertex_worldPosition + offset;
    highp vec2 pixel = gl_FragCoord.xy;
    highp float last = passUniforms.raster.z, share = 1.0, level = 0.0;
#if !defined(REFRACTION_THIN)
    highp vec4 clip = frameUniforms.clipFromWorld * vec4(exit, 1.0);
    if (clip.w > kLeastNearness) {
        pixel = (clip.xy / clip.w * 0.5 + 0.5) * passUniforms.target.xy;
    } else {
        share = 0.0; // behind the camera
    }
    // Pixels nearer than this surface are not behind it. The pixel straight behind always is.
    if (pictureTexel(pixel, 0.0).a * alongView(vertex_worldPosition) > 1.00390625) pixel = gl_FragCoord.xy;
#endif
    if (deviation > 0.0) {
        highp float distance = alongView(exit);
        highp float widest = pictureLevel(blurredPixels(deviation, distance, 0.0));
        highp float nearness = pictureTexel(pixel, min(widest, last)).a;
        highp float wanted = pictureLevel(blurredPixels(deviation, distance, nearness));
        share *= saturate(1.0 + last - wanted); // wider lobes reach beyond the screen
        level = min(wanted, last);
    }
    share *= shareOfPicture(pixel);
    if (ofFragment(frameUniforms.ambient.x) <= 0.0) share = 1.0; // no environment: the edge is repeated
    highp vec3 light;
#if defined(REFRACTION_THIN)
    if (level == 0.0) {
        highp vec2 inside = clamp(pixel, passUniforms.picture.xy, passUniforms.picture.zw - 1.0);
        light = texelFetch(passPicture, ivec2(inside), 0).rgb;
    } else
#endif
    {
        light = pictureTexel(pixel, level).rgb;
    }
    return Look(light * share, share, level);
}

Look lookThrough(Refraction refraction, highp float ior, highp float deviation) {
#if defined(REFRACTION_THIN)
    return lookAt(vec3(0.0), deviation);
#else
    return lookAt(solidExit(shading_normal, shading_view, ior, refraction.thickness), deviation);
#endif
}

Behind behindOf(Refraction refraction) {
    highp float deviation = transmittedDeviation(refraction.perceptualRoughness);
    Look all = lookThrough(refraction, refraction.ior, deviation);
    Behind behind = Behind(all.light, vec3(1.0 - all.share), all.level);
#if defined(HAS_DISPERSION) && !defined(REFRACTION_THIN)
    if (refraction.dispersion > 0.0) { // green keeps its direction
        highp vec3 ior = dispersedIor(refraction.ior, refraction.dispersion);
        Look red = lookThrough(refraction, ior.r, deviation), blue = lookThrough(refraction, ior.b, deviation);
        behind.light.r = red.light.r;
        behind.light.b = blue.light.b;
        behind.environment.r = 1.0 - red.share;
        behind.environment.b = 1.0 - blue.share;
    }
#endif
    return behind;
}

// For DebugView::Refraction: red is -1 - level, or -0.5 where only the environment is seen.
highp vec3 codeOfBehind(Behind behind) {
    return vec3(behind.environment.g < 1.0 ? -1.0 - behind.level : -0.5, 0.0, 0.0);
}
