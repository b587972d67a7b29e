// SPDX-License-Identifier: Apache-2.0
// Fog between the camera and this fragment (Effects::fog): docs/fog.md. All of it is in 32 bits.

#include "shaders/lib/fog.glsl"

struct FogRay {
    highp vec3 direction; // unit
    highp float meters;   // to the fragment, at most kFogInfinity
    highp float height;   // where it begins, above the camera
};

// In which direction depth grows, unit.
highp vec3 fogForward() {
    highp mat4 view = frameUniforms.viewFromWorld;
    return -vec3(view[0].z, view[1].z, view[2].z);
}

// Parallel to the others, from the plane of the camera. point: w = 0: background.
FogRay parallelFogRay(highp vec4 point) {
    FogRay ray;
    ray.direction = fogForward();
    highp float along = dot(point.xyz, ray.direction);
    ray.meters = point.w > 0.0 ? max(along, 0.0) : kFogInfinity;
    ray.height = point.y - ray.direction.y * along;
    return ray;
}

// point: relative to the camera, homogeneous; w = 0: at infinity.
FogRay fogRayTo(highp vec4 point) {
    if (ofFragment(frameUniforms.clipFromView[3].w) != 0.0) return parallelFogRay(point);
    highp float largest = max(max(abs(point.x), abs(point.y)), abs(point.z));
    highp vec3 scaled = point.xyz / max(largest, 1e-30);
    highp float size = sqrt(max(dot(scaled, scaled), 1e-30)); // in [1, 2)
    FogRay ray;
    ray.direction = scaled / size;
    ray.meters = point.w > largest * (size / kFogInfinity) ? largest * size / point.w : kFogInfinity;
    ray.height = 0.0;
    return ray;
}

// The fraction of light that fog replaces between `from` and `to` metres, wherever it ends.
highp float fogBetween(FogRay ray, highp float from, highp float to) {
    highp vec4 medium = frameUniforms.fogMedium;
    highp float density = medium.x - medium.y * ray.height;
    highp float depth = fogOpticalDepth(density, medium.y, ray.direction.y, from, to);
    return fogOpacity(depth, frameUniforms.fogLight.w);
}

// The fraction of light that fog replaces between `from` and the end of the ray.
highp float fogAlong(FogRay ray, highp float from) {
    return ray.meters > frameUniforms.fogMedium.w ? 0.0 : fogBetween(ray, from, ray.meters);
}

// A point at a place of the screen, [-1, 1]. depth: in the depth buffer. Background is at infinity.
highp vec4 fogPointOnScreen(highp vec2 place, highp float depth) {
    highp vec4 point = frameUniforms.worldFromClip * vec4(place, depth, 1.0);
    if (depth == frameUniforms.exposure.w) point.w = 0.0;
    return point;
}

// The point of a pixel.
highp vec4 fogPointAt(highp vec2 pixel, highp float depth) {
    return fogPointOnScreen(pixel * passUniforms.target.zw * 2.0 - 1.0, depth);
}
