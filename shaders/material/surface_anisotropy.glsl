// SPDX-License-Identifier: Apache-2.0
// Grooves: the specular lobe of the base stretched along the tangent, or across it where the amount is negative.

#include "shaders/lib/brdf_anisotropic.glsl"

#if defined(HALF_PRECISION)
const float kMinGrooveAlpha = kMinPerceptualRoughnessMedium * kMinPerceptualRoughnessMedium;
#else
const float kMinGrooveAlpha = kMinAlpha;
#endif

const float kGrooveShare = 0.6; // of groovesCompensation()

struct Grooves {
    float amount;            // in [-1, 1]; 0: none, and the rest is of no meaning
    vec3 tangent, bitangent; // of the shading normal, unit; 0 where the geometry has no tangents
    vec2 alpha;              // along both
    vec3 view;               // in the frame of tangent, bitangent and normal
};

Grooves groovesOf(MaterialInputs material, float alpha) {
    Grooves grooves;
    grooves.amount = clamp(material.anisotropy, -1.0, 1.0);
    highp vec3 direction = shading_tangentToWorld * material.anisotropyDirection;
    highp vec3 tangent = normalizeOrZero(direction - shading_normal * dot(direction, shading_normal));
    highp vec3 bitangent = cross(shading_normal, tangent);
    grooves.tangent = tangent;
    grooves.bitangent = bitangent;
    grooves.alpha = anisotropicAlpha(alpha, grooves.amount, kMinGrooveAlpha);
    grooves.view = vec3(dot(tangent, shading_view), dot(bitangent, shading_view), shading_NoV);
    return grooves;
}

// What energyCompensation() gives is lost by a round lobe of this roughness; a stretched one loses less towards some views.
// Of lights only: image-based light has a round lobe. The share is a bound over roughness, view and amount, not a fit.
vec3 groovesCompensation(Grooves grooves, vec3 compensation) {
    float share = 1.0 - kGrooveShare * max(grooves.amount, -grooves.amount);
    return 1.0 + (compensation - 1.0) * share;
}

// D V of one light; nol is positive.
float groovesLobe(Grooves grooves, vec3 normal, vec3 halfway, vec3 light, float nol) {
    vec3 halfLocal =
            vec3(dot(grooves.tangent, halfway), dot(grooves.bitangent, halfway), saturate(dot(normal, halfway)));
    vec3 lightLocal = vec3(dot(grooves.tangent, light), dot(grooves.bitangent, light), nol);
    return ndfGgxAnisotropic(halfLocal, grooves.alpha) *
            finite(visibilitySmithGgxAnisotropic(grooves.view, lightLocal, grooves.alpha));
}

// What the environment is looked up along, in place of the mirrored view.
highp vec3 groovesReflected(Grooves grooves, vec3 normal, vec3 view, float perceptualRoughness) {
    highp vec3 bent = anisotropicNormal(
            normal, grooves.tangent, grooves.bitangent, view, grooves.amount, perceptualRoughness);
    return reflect(-shading_view, bent);
}
