// SPDX-License-Identifier: Apache-2.0
// The motion of a surface on screen from this frame to the previous one. Includes need: the parameters `motion`
// (FrameTargets::motion), `lastFromPixel`, `perSample` (1 / size) and `jitter` (of this frame, pixels), and
// the constants `hasMotion` and `isElsewhere` (the camera moved).

// point: pixel and its depth. Returns fractions of the screen's width and height; outside of it: nowhere.
vec2 movedSince(vec3 point) {
    if (materialConstants_hasMotion) {
        vec4 motion = texelFetch(materialParams_motion, ivec2(point.xy), 0);
        if (motion.a > 0.0) return motion.xy + materialParams.jitter * materialParams.perSample;
    }
    if (!materialConstants_isElsewhere) return vec2(0.0);
    vec4 there = materialParams.lastFromPixel * vec4(point, 1.0);
    if (!(there.w > 0.0)) return vec2(4.0);
    return there.xy / there.w - (point.xy - materialParams.jitter) * materialParams.perSample;
}
