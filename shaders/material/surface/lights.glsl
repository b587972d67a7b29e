// SPDX-License-Identifier: Apache-2.0
// The sum over all lights that reach a surface: shadeLight() of the shading model for each.

#if defined(VARIANT_PUNCTUAL)

highp vec3 punctualLights(Surface surface) {
    highp vec3 sum = vec3(0.0);
    int count = int(frameUniforms.ambient.w);
    for (int i = 0; i < count; ++i) { // a loop even for few lights: unrolled code takes seconds to compile
        PunctualLight light = lightUniforms.lights[i];
        highp vec3 toLight = light.positionRange.xyz - vertex_worldPosition;
        highp float attenuation = distanceAttenuation(toLight, light.positionRange.w);
        if (attenuation <= 0.0) continue; // out of range
        highp vec3 direction = normalizeOrZero(toLight);
        if (light.colorIntensity.w > 0.0) {
            attenuation *= spotAttenuation(direction, light.directionScale.xyz, light.directionScale.w, light.offset.x);
            if (attenuation <= 0.0) continue; // outside the cone
        }
        Light arriving;
        arriving.direction = direction;
        arriving.illuminance = light.colorIntensity.rgb * attenuation;
#if defined(CUSTOM_SURFACE_SHADING)
        arriving.color = light.colorIntensity.rgb;
        arriving.attenuation = attenuation;
        arriving.position = light.positionRange.xyz;
#endif
        sum += shadeLight(surface, arriving);
    }
    return sum;
}

#endif

void addLights(Surface surface, inout highp vec3 sum) {
#if defined(VARIANT_SUN)
    Light sun;
    sun.direction = frameUniforms.sunDirection.xyz;
    sun.illuminance = frameUniforms.sunIlluminance.rgb;
#if defined(CUSTOM_SURFACE_SHADING)
    sun.color = frameUniforms.sunIlluminance.rgb;
    sun.attenuation = 1.0;
    sun.position = vertex_worldPosition + sun.direction;
#endif
    sum += shadeLight(surface, sun);
#endif
#if defined(VARIANT_PUNCTUAL)
    sum += punctualLights(surface);
#endif
}
