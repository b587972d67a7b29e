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

// ---- reflection probes (docs/probes.md), where quality_reflectionProbes is not 0. One function for all look-ups, whose
// calls stay calls (shaders/compiler/KeepCalls.h). Loops have a constant number of turns: drivers unroll them, and know
// the places of uniforms.

// Values of quality_reflectionProbes (ProbeTerms).
const int kTwoProbes = 4;
const int kFourProbes = 6;

int probeCount() {
    return quality_reflectionProbes <= kTwoProbes ? (quality_reflectionProbes + 1) >> 1
         : quality_reflectionProbes <= kFourProbes ? quality_reflectionProbes - 2
         : kMaxProbesOfView;
}

// One or two probes may be all that lights a view: their odd values.
bool addsEnvironment() {
    return quality_reflectionProbes >= kTwoProbes || (quality_reflectionProbes & 1) == 0;
}

// Light of the probes around the surface and of the environment, which gives what they leave: the mean over a lobe at
// this level of the cubes.
highp vec3 probedRadiance(highp vec3 direction, highp float level) {
    highp vec3 sum = vec3(0.0);
    if (quality_reflectionProbes != 0) { // which declares passProbes
        highp float left = 1.0;
        for (int i = 0; i < probeCount(); ++i) {
            highp vec3 local = pointInProbe(i);
            highp float share = shareOfProbe(i, left);
            left -= share;
            highp vec3 along = direction * worldFromProbe(i);
            highp vec4 capture = probeUniforms.probes[i].capture;
            highp vec3 to =
                    probeDirection(local - capture.xyz, along, probeRayLength(local, along, halfExtentOfProbe(i)));
            highp float layer = probeUniforms.probes[i].irradianceSh[0].w;
            sum += radianceOfTexel(textureLod(passProbes, vec4(to, layer), level)) * (share * capture.w);
        }
        if (addsEnvironment()) {
            highp vec4 to = vec4(environmentFromWorld(direction), 0.0);
            sum += radianceOfTexel(textureLod(passProbes, to, level)) * left;
        }
    }
    return sum;
}

// Of the light around the surface, the part that probes give.
highp float shareOfProbes() {
    highp float left = addsEnvironment() ? 1.0 : 0.0;
    if (quality_reflectionProbes != 0 && addsEnvironment()) {
        for (int i = 0; i < probeCount(); ++i) left -= shareOfProbe(i, left);
    }
    return 1.0 - left;
}

// As probedRadiance(), of irradiance / pi. environment: that of the environment.
highp vec3 probedIrradiance(highp vec3 normal, highp vec3 environment) {
    highp vec3 sum = vec3(0.0);
    highp float left = 1.0;
    for (int i = 0; i < probeCount(); ++i) {
        highp float share = shareOfProbe(i, left) * probeUniforms.probes[i].irradianceSh[1].w;
        left -= share;
        highp vec3 irradiance = irradianceSh(probeUniforms.probes[i].irradianceSh, normal, 3);
        sum += irradiance * (share * probeUniforms.probes[i].capture.w);
    }
    return sum + environment * left;
}

// The mean over a lobe of this roughness around a direction of the world, which need not be normalised. Before
// frameUniforms.ambient.x.
vec3 environmentRadiance(highp vec3 direction, highp float perceptualRoughness) {
    highp float level =
            levelFromPerceptualRoughness(perceptualRoughness, frameUniforms.ambient.y, quality_roughnessMapping);
    vec3 radiance;
    if (quality_reflectionProbes != 0) {
        radiance = probedRadiance(direction, level);
    } else {
        radiance = radianceOfTexel(textureLod(passSpecular, environmentFromWorld(direction), level));
    }
    return radiance;
}

// Reflected radiance of a white Lambert surface with this normal. Before frameUniforms.ambient.x.
vec3 environmentIrradiance(highp vec3 normal) {
    vec3 irradiance = vec3(0.0);
    if (quality_diffuseIrradiance == kIrradianceOfField) {
        irradiance = objectIrradiance(normal);
    } else {
        if (addsEnvironment()) irradiance = irradianceTerm(environmentFromWorld(normal));
        if (quality_reflectionProbes != 0) irradiance = probedIrradiance(normal, irradiance);
    }
    return irradiance;
}
