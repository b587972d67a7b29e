// SPDX-License-Identifier: Apache-2.0
// The terms of lit materials that <filament_core/Quality.h> selects. The choices are specialisation constants, so a program
// contains only the selected terms. <filament_core/Quality.h> has the defaults.

const int kVisibilityFast = 1;
const int kVisibilityUncorrelated = 2;
const int kFresnelExact = 1;
const int kDiffuseDisney = 1;
const int kSplitSumAnalytic = 1;
const int kIrradianceLastSpecularLevel = 1;
const int kIrradianceCube = 2;
const int kIrradianceOfField = 3; // shader::IrradianceField (docs/irradiance-grids.md)
const int kEncodingRgbm = 1;
const int kLookUpsQuadratic = 1;
const int kLookUpsTwo = 2;
const int kLookUpsThree = 3;
const int kLookUpsEight = 4;
const int kLookUpsThirtyTwo = 5;
const int kGrainLookUpsOne = 1;
const int kGrainLookUpsThree = 2;
const int kGrainLookUpsNine = 3;

// Half floats end at 65504, and infinity times the cosine of grazing light would be NaN.
#if defined(HALF_PRECISION)
float finite(float x) { return min(x, 65504.0); }
#else
float finite(float x) { return x; }
#endif

// In half floats 1 - n.h is only rounding error where D peaks: computed from the cross product of the vectors instead.
float distributionTerm(vec3 normal, vec3 halfway, float alpha) {
#if defined(HALF_PRECISION)
    return ndfGgxFromVectors(normal, halfway, alpha);
#else
    return ndfGgx(saturate(dot(normal, halfway)), alpha);
#endif
}

float visibilityTerm(float nov, float nol, float alpha) {
#if defined(QUALITY_LOW) // the material's own quality: slightly inaccurate, whatever the view selects
    return finite(visibilitySmithGgxCorrelatedFast(nov, nol, alpha));
#else
    float v;
    if (quality_specularVisibility == kVisibilityFast) {
        v = visibilitySmithGgxCorrelatedFast(nov, nol, alpha);
    } else if (quality_specularVisibility == kVisibilityUncorrelated) {
        v = visibilitySmithGgxUncorrelated(nov, nol, alpha);
    } else {
        v = visibilitySmithGgxCorrelated(nov, nol, alpha);
    }
    return finite(v);
#endif
}

// f90 is below 1 only for materials without reflection (surfaceOf()); that applies to the exact term as well.
vec3 fresnelTerm(vec3 f0, float f90, float metallic, float voh) {
    vec3 f;
    if (quality_fresnel == kFresnelExact) {
        f = fresnelExact(f0, metallic, voh) * f90;
    } else {
        f = fresnelSchlick(f0, f90, voh);
    }
    return f;
}

float diffuseTerm(float nov, float nol, float voh, float perceptualRoughness) {
    float d;
    if (quality_diffuse == kDiffuseDisney) {
        d = diffuseDisney(nov, nol, voh, perceptualRoughness);
    } else {
        d = diffuseLambert();
    }
    return d;
}

vec2 splitSumTerm(highp float nov, highp float perceptualRoughness) {
    vec2 dfg;
    if (quality_splitSum == kSplitSumAnalytic) {
        dfg = dfgAnalytic(nov, perceptualRoughness);
    } else {
        dfg = textureLod(passDfg, vec2(nov, perceptualRoughness), 0.0).xy;
    }
    return dfg;
}

vec3 energyCompensationTerm(vec3 f0, vec2 dfg) {
    vec3 factor = vec3(1.0);
    if (quality_withoutEnergyCompensation == 0) factor = energyCompensation(f0, dfg);
    return factor;
}

// Directional albedo of the specular lobe with all bounces.
vec3 specularAlbedoTerm(vec3 f0, float f90, vec2 dfg) { return specularDfg(f0, f90, dfg) * energyCompensationTerm(f0, dfg); }

// The two factors of the diffuse lobe under lights: one is the part not reflected by the specular lobe towards one
// direction; the other is that for the other direction, divided by the average part left.
vec3 diffuseEntryTerm(vec3 albedo) {
    vec3 share = vec3(1.0);
    if (quality_withoutDiffuseCoupling == 0) share = diffuseEntry(albedo);
    return share;
}

vec3 diffuseExitTerm(vec3 albedo, vec3 averageAlbedo) {
    vec3 share = vec3(1.0);
    if (quality_withoutDiffuseCoupling == 0) share = diffuseExit(albedo, averageAlbedo);
    return share;
}

// The direction of the single fetch that approximates a rough lobe.
highp vec3 lobeDirectionTerm(highp vec3 normal, highp vec3 reflected, float alpha) {
    highp vec3 direction;
    if (quality_specularLookUps == kLookUpsQuadratic) {
        direction = quadraticSpecularDirection(normal, reflected, alpha);
    } else {
        direction = dominantSpecularDirection(normal, reflected, alpha);
    }
    return direction;
}

vec3 radianceOfTexel(vec4 texel) {
    vec3 radiance;
    if (quality_environmentEncoding == kEncodingRgbm) {
        radiance = radianceFromRgbm(texel);
    } else {
        radiance = texel.rgb;
    }
    return radiance;
}

// Irradiance / pi around a direction of the environment's space.
vec3 irradianceTerm(highp vec3 normal) {
    vec3 irradiance;
    if (quality_diffuseIrradiance == kIrradianceLastSpecularLevel && quality_reflectionProbes == 0) {
        irradiance = radianceOfTexel(textureLod(passSpecular, normal, frameUniforms.ambient.y));
    } else if (quality_diffuseIrradiance == kIrradianceCube) {
        irradiance = textureLod(passIrradiance, normal, 0.0).rgb;
    } else {
        irradiance = irradianceSh(frameUniforms.irradianceSh, normal, int(ofFragment(frameUniforms.ambient.z)));
    }
    return irradiance;
}
