// SPDX-License-Identifier: Apache-2.0
// Lit materials with shadowMultiplier: what lies behind is a photograph of the ground, light included. Of that light the
// surface keeps the share that shadows leave, as a ground of this material would; screen-space reflections are added.
//   After   Debevec 1998, "Rendering Synthetic Objects into Real Scenes", 6: the local scene with and without objects.
//           As a ratio, not as a difference: the photograph has the colour of the ground, the material need not.

highp vec3 shading_leftByShadows; // of the light: what shadows and occlusion leave

// Lights are shaded without their shadows; returns what these leave.
highp vec3 takeShadow(inout highp vec3 visibility) {
    highp vec3 left = visibility;
    visibility = vec3(1.0);
    return left;
}

// shadeEnvironment() of a surface from which nothing hides the environment.
highp vec3 shadeOpenEnvironment(Surface surface) {
    surface.visibility = 1.0;
#if defined(REFLECTION_OF_PICTURE)
    surface.mirrored = noHit();
#endif
    return shadeEnvironment(surface);
}

// `light`: without shadows. `strength`: the alpha of a full shadow.
highp vec4 caughtShadow(Surface surface, highp vec3 light, highp float strength) {
    highp vec4 caught = vec4(0.0, 0.0, 0.0, strength * shadowedShare(shading_leftByShadows, light));
#if defined(REFLECTION_OF_PICTURE)
    if (quality_screenReflections != 0) caught.rgb = reflectedPicture(surface);
#endif
    return caught;
}
