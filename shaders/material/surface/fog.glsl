// SPDX-License-Identifier: Apache-2.0
// Fog between the camera and this fragment (Effects::fog): docs/fog.md. All of it is in 32 bits.

#include "shaders/lib/fog.glsl"

struct FogRay {
    highp vec3 direction; // unit
    highp float meters;   // to what the fragment shows, at most kFogInfinity
};

// point: relative to the camera, homogeneous; w = 0: at infinity.
FogRay fogRayTo(highp vec4 point) {
    highp float largest = max(max(abs(point.x), abs(point.y)), abs(point.z));
    highp vec3 scaled = point.xyz / max(largest, 1e-30);
    highp float size = sqrt(max(dot(scaled, scaled), 1e-30)); // in [1, 2)
    FogRay ray;
    ray.direction = scaled / size;
    ray.meters = point.w > largest * (size / kFogInfinity) ? largest * size / point.w : kFogInfinity;
    return ray;
}

// The share of light that fog replaces between `from` and the end of the ray.
highp float fogAlong(FogRay ray, highp float from) {
    highp vec4 medium = frameUniforms.fogMedium;
    highp float depth = fogOpticalDepth(medium.x, medium.y, ray.direction.y, from, ray.meters);
    return ray.meters > medium.w ? 0.0 : fogOpacity(depth, frameUniforms.fogLight.w);
}

// The point of a pixel. depth: in the depth buffer. Where nothing is, at infinity.
highp vec4 fogPointAt(highp vec2 pixel, highp float depth) {
    highp vec4 point = frameUniforms.worldFromClip * vec4(pixel * passUniforms.target.zw * 2.0 - 1.0, depth, 1.0);
    if (depth == frameUniforms.exposure.w) point.w = 0.0;
    return point;
}
