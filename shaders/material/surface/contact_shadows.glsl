// SPDX-License-Identifier: Apache-2.0
// Shadows of casters that are too small or too near for shadow maps: a ray from the fragment towards the light through the
// depth buffer (docs/shadows.md, "Contact shadows"). All of it is in 32 bits.

const highp float kContactBias = 0.25; // of a pixel's width: smaller heights above the fragment's plane are that plane
const highp float kContactFade = 0.75; // of the ray, from which shadows fade
const highp float kDepthUnit = 1.2e-7; // of a depth buffer with floats near 1

// Constants of all rays of a fragment. A pixel at `place`, in [-1, 1], shows a point at the distance d along the
// view at (axes x place.x + axes y place.y + axes w) d; these are its heights above the fragment's plane, in metres.
// In an orthographic projection the point is at axes x place.x + axes y place.y + the image centre + forward d.
struct ContactReceiver {
    highp vec3 normal; // of the plane, towards the camera
    highp vec3 rise;   // heights of the axes
    highp float middle; // height of the image centre; 0: perspective
    highp float height; // of the camera
    highp float bias;
};

bool isParallelView() { return ofFragment(frameUniforms.clipFromView[3].w) != 0.0; }

highp float riseOfPixel(ContactReceiver receiver, highp vec2 place, highp float distance) {
    highp float across = receiver.rise.x * place.x + receiver.rise.y * place.y;
    return isParallelView() ? across + receiver.middle + receiver.rise.z * distance : (across + receiver.rise.z) * distance;
}

ContactReceiver contactReceiver() {
    mat4 axes = frameUniforms.worldFromClip, clip = frameUniforms.clipFromView;
    highp float distance = max(-(frameUniforms.viewFromWorld * vec4(vertex_worldPosition, 1.0)).z, 0.0);
    ContactReceiver receiver;
    receiver.normal = dot(shading_facet, shading_facet) > 0.0 ? shading_facet : shading_geometricNormal;
    if (dot(receiver.normal, isParallelView() ? -shading_view : vertex_worldPosition) > 0.0)
        receiver.normal = -receiver.normal;
    receiver.rise = vec3(dot(receiver.normal, axes[0].xyz), dot(receiver.normal, axes[1].xyz),
            dot(receiver.normal, axes[3].xyz));
    receiver.middle = 0.0;
    receiver.height = dot(receiver.normal, vertex_worldPosition);
    if (isParallelView()) {
        highp vec3 middle = axes[2].xyz * clip[3].z + axes[3].xyz; // in the plane of the camera
        receiver.rise.z = -dot(receiver.normal, shading_view);
        receiver.middle = dot(receiver.normal, middle);
        distance = 1.0; // all pixels are as wide
    }
    receiver.bias = distance * (kContactBias * 2.0) * passUniforms.target.w / max(abs(clip[1].y), 1e-6);
    // With the ordinary range, depths far away are coarse.
    if (isParallelView())
        receiver.bias += kDepthUnit / max(abs(clip[2].z), 1e-30);
    else
        receiver.bias += frameUniforms.exposure.w * distance * distance * kDepthUnit / max(abs(clip[3].z), 1e-30);
    return receiver;
}

// 1: the light is visible. toLight: unit. reach: metres to the light. There are no rays towards lights
// behind the plane, which is dark anyway.
highp float contactVisibility(bool isAsked, highp vec3 toLight, highp float reach) {
    ContactReceiver receiver = contactReceiver();
    bool isAbove = dot(receiver.normal, toLight) > 0.0;
    highp vec4 effect = frameUniforms.contactShadows;
    highp vec3 ray = toLight * min(effect.x, reach);
    highp vec4 from = frameUniforms.clipFromWorld * vec4(vertex_worldPosition, 1.0);
    highp vec4 along = frameUniforms.clipFromWorld * vec4(ray, 0.0);
    highp float stride = 1.0 / max(effect.z, 1.0), visible = 1.0;
    highp float t = stride * interleavedGradientNoise(floor(gl_FragCoord.xy));
    // Once for every step, or not at all: drivers for CPUs compute both sides of a branch, but leave a loop that has
    // ended.
    int steps = isAsked && isAbove ? int(effect.z) : 0;
    for (int i = 0; i < steps; ++i) {
        highp vec3 at = from.xyw + along.xyw * t; // z: the distance along the view
        highp vec2 pixel = floor((at.xy / at.z * 0.5 + 0.5) * passUniforms.target.xy);
        bool isInside = at.z > 0.0 && pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < passUniforms.target.x &&
                pixel.y < passUniforms.target.y;
        if (!isInside) break;
        highp float seen = texelFetch(passSceneDepth, ivec2(pixel), 0).x;
        highp vec2 place = (pixel + 0.5) * passUniforms.target.zw * 2.0 - 1.0;
        highp float rise = riseOfPixel(receiver, place, seen);
        if (seen < at.z && at.z - seen < effect.y && rise - receiver.height > receiver.bias) {
            visible = saturate((t - kContactFade) / (1.0 - kContactFade));
            break;
        }
        t += stride;
    }
    return visible;
}
