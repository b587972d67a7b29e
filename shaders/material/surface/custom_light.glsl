// SPDX-License-Identifier: Apache-2.0
// shadeLight() of materials with customSurfaceShading: the author's function, also for lights behind the surface.

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
