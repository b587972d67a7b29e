// SPDX-License-Identifier: Apache-2.0
// Light scattered inside a solid of one medium (KHR_materials_volume_scatter), with the solid as a ball that has the
// object's thickness as its diameter.
//   depth      extinction times the diameter of the ball: mean number of events along it, >= 0.
//   loss       s = sqrt(1 - a) of the single-scatter albedo a: 0 if nothing is absorbed, 1 if nothing scatters. In
//              [0, 1], and precise where the albedo is almost 1.
//   anisotropy g, the mean cosine of the angle by which an event turns light, in (-1, 1).
//   Similar    a medium with g scatters, over many events, like one without: its depth is (1 - g a) times as large and
//              s^2 becomes s^2 / (1 - g a) (van de Hulst 1980, "Multiple Light Scattering", volume 2, chapter 14).

// The nearest to 1 that the sizes of g are: 1 - g must not vanish in 16 bits.
const float kMaxScatterAnisotropy = 0.9990234375f;
// Nothing crosses a ball of this depth; squares of depths stay in 16 bits.
const float kMaxScatterDepth = 64.0f;

// The loss of a medium without anisotropy that has this multi-scatter albedo A: the share that a body returns which is so
// thick that no light crosses it. Ibid.: A = (1 - s) (1 - 0.139 s) / (1 + 1.17 s). Kulla and Conty 2017, "Revisiting
// Physically Based Shading at Imageworks", solve it for s; this is the same root without the difference of equal
// numbers. color in [0, 1].
vec3 scatterLoss(vec3 color) {
    vec3 dark = vec3(1.0f) - color;
    vec3 b = color * 1.17f + vec3(1.139f);
    return dark * 2.0f / (b + sqrt(b * b - dark * 0.556f));
}

// 1 - g a: the depth of the similar medium over that of the medium. Not precise for g near 1 and s near 0.
vec3 scatterSimilarity(vec3 loss, float anisotropy) { return vec3(1.0f - anisotropy) + loss * loss * anisotropy; }

// The mean transmittance of a ball, over all its chords, as a rational function with the exact first two derivatives at
// 0; the exact one is 2 (1 - (1 + depth) exp(-depth)) / depth^2. Within 0.034 of it.
vec3 ballTransmittance(vec3 depth) { return vec3(1.0f) / (vec3(1.0f) + depth * (vec3(0.6666667f) + depth * 0.1944444f)); }

// The chance that light of an event anywhere in the ball reaches its surface without another one: Case, de Hoffmann and
// Placzek 1953, "Introduction to the Theory of Neutron Diffusion", section 10.4. It follows from the transmittance t by
// reciprocity: 3 (1 - t) / (2 depth).
vec3 ballEscape(vec3 depth) { return (vec3(1.0f) + depth * 0.2916667f) * ballTransmittance(depth); }

// The part of diffuse light inside that the surface reflects back inside: Fresnel's reflectance for diffuse light outside,
// by Schlick's form, and the law of etendue. ior in [1, 4]. Returns [0, 1).
float diffuseReflectedInside(float ior) {
    float root = (ior - 1.0f) / (ior + 1.0f);
    float f0 = root * root;
    float outside = f0 + (1.0f - f0) * 0.0476190f * saturate(16.5f * f0);
    return saturate(1.0f - (1.0f - outside) / (ior * ior));
}

// What leaves the ball of the light that scattered in it at least once. Own derivation: each event loses s^2, and the
// light that is left escapes with a chance that is known for balls that scatter little (ballEscape()) and follows from A
// for those that scatter often; with their root of squares the result is within 0.06 of a random walk for ior up to 1.5, and
// within 0.016 of it in the mean (root mean square). What the surface
// reflects inside crosses the ball or scatters again. loss and depth of the similar medium. ior: 1 for surfaces that
// reflect nothing inside. Returns [0, 1].
vec3 scatteredShare(vec3 depth, vec3 loss, float ior) {
    float inside = diffuseReflectedInside(ior);
    // Refracted light enters deeper: the second term, fitted to a random walk.
    float entry = 2.309f + 1.3f * (1.0f - 1.0f / ior);
    vec3 thick = loss * (vec3(1.0f) - loss * 0.139f) / ((vec3(1.0f) + loss) * (vec3(entry) - loss * 0.139f));
    vec3 once = ballEscape(depth);
    vec3 reached = min(sqrt(thick * thick + once * once), vec3(1.0f));
    vec3 escape = reached * (1.0f - inside) / (vec3(1.0f) - ballTransmittance(depth) * inside);
    vec3 left = (vec3(1.0f) - loss * loss) * escape;
    return left / (loss * loss + left);
}

// The part of scattered light that arrived on the far side of the ball, for the irradiance of both sides: fitted to a
// random walk; dark balls are too bright from behind, by up to 0.28. Backward scattering counts while events are few.
//   depth  of the similar medium.
// Returns [0, 1].
vec3 scatteredFromBehind(vec3 depth, float anisotropy, float ior) {
    vec3 turned = vec3(1.0f) + min(anisotropy, 0.0f) / (vec3(1.0f) + depth);
    return saturate(turned * min(0.4f + 0.1f * ior, 0.6f) / (vec3(1.0f) + depth * (0.19f / ior)));
}
