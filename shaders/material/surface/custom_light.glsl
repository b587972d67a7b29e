// SPDX-License-Identifier: Apache-2.0
// Lights for materials with customSurfaceShading: shadeLight() is the author's function, also for lights behind the
// surface.

// LightData::visibility is one number: the tint of a coloured shadow goes into the light's colour.
highp vec3 tintedByShadow(highp vec3 color, highp vec3 visibility) {
    highp float most = max3(visibility);
    if (variant_shadows != 0 && quality_coloredShadows != 0 && most > 0.0) color *= visibility / most;
    return color;
}

highp vec3 shadeLight(Surface surface, Light light) {
    LightData data;
    highp float strength = max3(light.color);
    data.colorIntensity = strength > 0.0 ? vec4(light.color / strength, strength) : vec4(0.0);
    data.l = light.direction;
    data.NdotL = clamp(dot(shading_normal, light.direction), 0.0, 1.0);
    data.worldPosition = light.position;
    data.attenuation = light.attenuation;
    data.visibility = light.visibility;
    return surfaceShading(surface.inputs,
            ShadingData(surface.diffuse, surface.f0, surface.perceptualRoughness, surface.alpha), data);
}
