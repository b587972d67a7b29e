// SPDX-License-Identifier: Apache-2.0
// Grooves: the specular lobe of the base, stretched along the tangent, or across it if the amount is negative.

#include "shaders/lib/brdf_anisotropic.glsl"

#if defined(HALF_PRECISION)
const float kMinGrooveAlpha = kMinPerceptualRoughnessMedium * kMinPerceptualRoughnessMedium;
#else
const float kMinGrooveAlpha = kMinAlpha;
#endif

const float kGrooveSmooth = 0.5, kGrooveAcross = 0.03; // of groovesRoughness()

struct Grooves {
    float amount;            // in [-1, 1]; 0: none, and the other members are undefined
    vec3 tangent, bitangent; // of the shading normal, unit; 0 if the geometry has no tangents
    vec2 alpha;              // along tangent and bitangent
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

// energyCompensation() restores the loss of an isotropic lobe of this roughness; a stretched one loses less towards
// some views. Applies to lights only, since image-based light uses an isotropic lobe. The share is a bound over
// roughness, view and amount, not a fit: slight grooves account for most of the difference.
vec3 groovesCompensation(Grooves grooves, vec3 compensation) {
    float amount = max(grooves.amount, -grooves.amount);
    float share = 1.0 - amount * (0.85 - 0.25 * amount);
    return 1.0 + (compensation - 1.0) * share;
}

// The perceptual roughness of an isotropic lobe that reflects as much towards this direction, or slightly more. A
// stretched lobe behaves like its roughness along the direction (Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs", section 5.3), but facets that lean across the direction reduce it, and it never
// reaches zero. Both shares are bounds for dielectrics over roughness, direction and amount, exceeded by at most 0.004.
highp float groovesRoughness(Grooves grooves, vec3 direction) {
    vec2 part = vec2(dot(grooves.tangent, direction), dot(grooves.bitangent, direction));
    part = part * part;
    part = part / max(part.x + part.y, 0.0009765625); // 2^-10
    vec2 squared = grooves.alpha * grooves.alpha;
    float amount = max(grooves.amount, -grooves.amount);
    float along = 1.0 - kGrooveSmooth * amount, across = kGrooveAcross * amount;
    return sqrt(sqrt(along * along * dot(part, squared) + across * across * dot(part.yx, squared)));
}

// D V for one light; nol is positive.
float groovesLobe(Grooves grooves, vec3 normal, vec3 halfway, vec3 light, float nol) {
    vec3 halfLocal =
            vec3(dot(grooves.tangent, halfway), dot(grooves.bitangent, halfway), saturate(dot(normal, halfway)));
    vec3 lightLocal = vec3(dot(grooves.tangent, light), dot(grooves.bitangent, light), nol);
    return ndfGgxAnisotropic(halfLocal, grooves.alpha) *
            finite(visibilitySmithGgxAnisotropic(grooves.view, lightLocal, grooves.alpha));
}

// The direction for looking up the environment, instead of the mirrored view.
highp vec3 groovesReflected(Grooves grooves, vec3 normal, vec3 view, float perceptualRoughness) {
    highp vec3 bent = anisotropicNormal(
            normal, grooves.tangent, grooves.bitangent, view, grooves.amount, perceptualRoughness);
    return reflect(-shading_view, bent);
}
