// SPDX-License-Identifier: Apache-2.0
// The light that arrives at a surface, for any shading model: one light, and the environment. All of it is pre-exposed,
// so that sums stay within fp16 even at 110 000 lux.

struct Light {
    vec3 direction;   // to the light, unit
    vec3 illuminance; // at normal incidence
#if defined(CUSTOM_SURFACE_SHADING)
    highp vec3 color; // the unattenuated light
    highp float attenuation;
    highp float visibility;
    highp vec3 position;
#endif
};

highp vec3 environmentFromWorld(highp vec3 direction) {
    return direction * mat3(frameUniforms.worldFromEnvironment);
}

// The mean over a lobe of this roughness around a direction of the world, which need not be normalised. Before
// frameUniforms.ambient.x.
vec3 environmentRadiance(highp vec3 direction, highp float perceptualRoughness) {
    highp float level =
            levelFromPerceptualRoughness(perceptualRoughness, frameUniforms.ambient.y, quality_roughnessMapping);
    return radianceOfTexel(textureLod(passSpecular, environmentFromWorld(direction), level));
}

// Reflected radiance of a white Lambert surface with this normal. Before frameUniforms.ambient.x.
vec3 environmentIrradiance(highp vec3 normal) { return irradianceTerm(environmentFromWorld(normal)); }
