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

// ---- reflection probes (docs/probes.md), where quality_reflectionProbes is 1

highp vec4 probeVector(int word) {
    return uintBitsToFloat(uvec4(froxelBuffer.words[word], froxelBuffer.words[word + 1], froxelBuffer.words[word + 2],
            froxelBuffer.words[word + 3]));
}

// irradianceSh() of the coefficients from this word on, without an array; those of bands that the view leaves out are 0.
highp vec3 probedIrradiance(int word, highp vec3 n) {
    highp vec3 e = probeVector(word).xyz;
    e += probeVector(word + 4).xyz * n.y + probeVector(word + 8).xyz * n.z + probeVector(word + 12).xyz * n.x;
    e += probeVector(word + 16).xyz * (n.x * n.y) + probeVector(word + 20).xyz * (n.y * n.z);
    e += probeVector(word + 24).xyz * (3.0 * n.z * n.z - 1.0);
    e += probeVector(word + 28).xyz * (n.z * n.x) + probeVector(word + 32).xyz * (n.x * n.x - n.y * n.y);
    return max(e, vec3(0.0));
}

// Light of the probes around the surface and of the environment, which is the last of their records: the mean over a lobe
// at this level of the cubes; a level below 0: irradiance / pi. A record: ReflectionProbe in ShaderInterface.h. One function
// for all look-ups, whose calls stay calls (shaders/compiler/KeepCalls.h).
highp vec3 probedLight(highp vec3 direction, highp float level) {
    highp vec3 sum = vec3(0.0);
    if (quality_reflectionProbes != 0) {
        bool isDiffuse = level < 0.0;
        highp float left = 1.0;
        int word = int(frameUniforms.irradianceSh[0].w), end = int(frameUniforms.irradianceSh[1].w);
        for (; word < end; word += kProbeWords) {
            highp vec4 x = probeVector(word), y = probeVector(word + 4), z = probeVector(word + 8);
            highp vec4 center = probeVector(word + 12), capture = probeVector(word + 16);
            highp vec3 halfExtent = vec3(x.w, y.w, z.w);
            highp mat3 worldFromBox = mat3(x.xyz, y.xyz, z.xyz);
            highp vec3 local = (vertex_worldPosition - center.xyz) * worldFromBox;
            highp float share = probeShare(probeWeight(local, halfExtent, center.w), left);
            if (share <= 0.0 || (isDiffuse && froxelBuffer.words[word + 27] == 0u)) continue;
            left -= share;
            highp vec3 along = direction * worldFromBox;
            vec3 light;
            if (isDiffuse) {
                light = probedIrradiance(word + 20, along);
            } else {
                highp vec3 to = probeDirection(local - capture.xyz, along, probeRayLength(local, along, halfExtent));
                light = radianceOfTexel(textureLod(passProbes, vec4(to, probeVector(word + 20).w), level));
            }
            sum += light * (share * capture.w);
        }
    }
    return sum;
}

// The mean over a lobe of this roughness around a direction of the world, which need not be normalised. Before
// frameUniforms.ambient.x.
vec3 environmentRadiance(highp vec3 direction, highp float perceptualRoughness) {
    highp float level =
            levelFromPerceptualRoughness(perceptualRoughness, frameUniforms.ambient.y, quality_roughnessMapping);
    vec3 radiance;
    if (quality_reflectionProbes != 0) {
        radiance = probedLight(direction, level);
    } else {
        radiance = radianceOfTexel(textureLod(passSpecular, environmentFromWorld(direction), level));
    }
    return radiance;
}

// Reflected radiance of a white Lambert surface with this normal. Before frameUniforms.ambient.x.
vec3 environmentIrradiance(highp vec3 normal) {
    vec3 irradiance;
    if (quality_reflectionProbes != 0) {
        irradiance = probedLight(normal, -1.0);
    } else {
        irradiance = irradianceTerm(environmentFromWorld(normal));
    }
    return irradiance;
}
