// SPDX-License-Identifier: Apache-2.0
// Lighting from a distant environment: the mip level, the direction, and the diffuse part.

// The mip level of the pre-filtered environment for a roughness. levelOfRoughnessOne * r * (2 - r) gives rough surfaces
// more levels than log2 would: 5 levels hold roughness^2 0, 0.018, 0.086, 0.25, 1.
// perceptualRoughness in [0, 1]. Returns [0, levelOfRoughnessOne].
float levelFromPerceptualRoughness(float perceptualRoughness, float levelOfRoughnessOne) {
    return levelOfRoughnessOne * perceptualRoughness * (2.0f - perceptualRoughness);
}

// Inverse of levelFromPerceptualRoughness, used to fill the levels. level in [0, levelOfRoughnessOne].
float perceptualRoughnessFromLevel(float level, float levelOfRoughnessOne) {
    return 1.0f - sqrt(max(1.0f - level / levelOfRoughnessOne, 0.0f));
}

// Other mappings of roughness to levels (RoughnessMapping in <filament_core/Quality.h>, in its order).
const int kRoughnessQuadratic = 0;
const int kRoughnessLogarithmic = 1; // every level doubles alpha, but level 0 is a mirror
const int kRoughnessLinear = 2;

// Guy and Agopian 2018, "High performance on mobile", for the quadratic and logarithmic mappings. Ranges as above.
float levelFromPerceptualRoughness(float perceptualRoughness, float levelOfRoughnessOne, int mapping) {
    float level = levelFromPerceptualRoughness(perceptualRoughness, levelOfRoughnessOne);
    if (mapping == kRoughnessLogarithmic) {
        level = max(levelOfRoughnessOne + 2.0f * log2(max(perceptualRoughness, 0.001f)), 0.0f);
    } else if (mapping == kRoughnessLinear) {
        level = levelOfRoughnessOne * perceptualRoughness;
    }
    return level;
}

// Inverse of the above, except for the mirror at level 0 of the logarithmic mapping.
float perceptualRoughnessFromLevel(float level, float levelOfRoughnessOne, int mapping) {
    float roughness = perceptualRoughnessFromLevel(level, levelOfRoughnessOne);
    if (mapping == kRoughnessLogarithmic) {
        roughness = level > 0.0009765625f ? exp2(0.5f * (level - levelOfRoughnessOne)) : 0.0f; // 2^-10: every format has it
    } else if (mapping == kRoughnessLinear) {
        roughness = level / levelOfRoughnessOne;
    }
    return roughness;
}

// RGBM: a colour in [0, 1] with a common factor in alpha; here for the square root of radiance, so that 8 bits reach
// from 0 to kRgbmRange^2 = 256. Packed by Rgbm.h. Karis 2009, "RGBM color encoding"; the root is from Lazarov, 2011.
const float kRgbmRange = 16.0f;
vec3 radianceFromRgbm(vec4 texel) {
    vec3 root = vec3(texel) * (texel.w * kRgbmRange);
    return root * root;
}

// The effective direction of a rough lobe: it turns from the mirror direction r towards the normal n. Lagarde and de
// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.9.3.
// Not normalised, since a cube map look-up does not need it. n, r unit, alpha in [0, 1].
vec3 dominantSpecularDirection(vec3 n, vec3 r, float alpha) {
    float smoothness = 1.0f - alpha;
    return mix(n, r, smoothness * (sqrt(smoothness) + alpha));
}

// The same with the weight alpha^2: no root, but further from the lobe at middle roughness.
vec3 quadraticSpecularDirection(vec3 n, vec3 r, float alpha) { return mix(r, n, alpha * alpha); }

// One of `count` look-ups that replace the single one of a GGX lobe: the half vector for a point of the unit disc, which
// a view at cosine nov sees as often as all others. Heitz 2018, "Sampling the GGX Distribution of Visible Normals".
// x points to the side of the view, z along the normal. nov in (0, 1], alpha in [kMinAlpha, 1]. Returns a unit vector.
vec3 visibleHalfVector(float nov, float alpha, vec2 disc) {
    float stretched = alpha * sqrt(max((1.0f - nov) * (1.0f + nov), 0.0f));
    float inverse = 1.0f / sqrt(stretched * stretched + nov * nov);
    float sine = stretched * inverse, cosine = nov * inverse;
    float lift = 0.5f * (1.0f + cosine);
    float rest = max(1.0f - disc.x * disc.x, 0.0f);
    float up = (1.0f - lift) * sqrt(rest) + lift * disc.y;
    float ahead = sqrt(max(rest - up * up, 0.0f));
    vec3 h = vec3(alpha * (ahead * sine - up * cosine), alpha * disc.x, max(up * sine + ahead * cosine, 0.0f));
    return h / sqrt(max(dot(h, h), 1e-12f));
}

// How much of the light of such a half vector's mirror direction is not shadowed, up to a factor of the view. Smith's
// height-correlated masking and shadowing over masking (Heitz 2014, eq. 99). nov, nol in (0, 1]. Returns [0, 1].
float visibleLookUpWeight(float nov, float nol, float alpha) {
    float a2 = alpha * alpha;
    float view = sqrt(a2 + (1.0f - a2) * nov * nov), light = sqrt(a2 + (1.0f - a2) * nol * nol);
    float both = nol * view + nov * light;
    return both > 0.0f ? nol * (nov + view) / both : 0.0f;
}

// The roughness to look such a direction up with: its lobe covers the share of the sphere that belongs to the sample.
// Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling". Returns (0, 1].
float visibleLookUpRoughness(float nov, float noh, float alpha, float count) {
    float a2 = alpha * alpha;
    float view = sqrt(a2 + (1.0f - a2) * nov * nov);
    float spread = (noh * noh) * a2 + (1.0f - noh) * (1.0f + noh); // a2 / (pi D) is its square
    float width2 = (nov + view) * spread * spread / (2.0f * count * a2);
    return sqrt(sqrt(min(width2, 1.0f)));
}

// A fit of the split-sum table (DfgTable.h), without a fetch. Karis 2014, "Physically Based Shading on Mobile", after
// Lazarov 2013, "Getting More Physical in Call of Duty: Black Ops II". Errors up to 0.09 for dielectrics and 0.3 for
// metals, for which energyCompensation() corrects them. nov, perceptualRoughness in [0, 1].
// Returns the two values of a table entry.
vec2 dfgAnalytic(float nov, float perceptualRoughness) {
    vec4 r = perceptualRoughness * vec4(-1.0f, -0.0275f, -0.572f, 0.022f) + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * nov)) * r.x + r.y;
    float bias = clamp(1.04f * a + r.w, 0.0f, 1.0f);
    return vec2(bias, min(max(r.z - 1.04f * a, 0.0f) + bias, 1.0f));
}

// Irradiance / pi: the radiance leaving a white Lambert reflector with normal n. Ramamoorthi and Hanrahan 2001, "An
// Efficient Representation for Irradiance Environment Maps". The coefficients include the cosine lobe, the
// normalisation of the basis and 1/pi (IblBaker.h), so only the polynomials remain.
// sh[i].xyz in the environment's unit; n unit; bands 1, 2 or 3 cost 1, 4 or 9 coefficients. Returns values >= 0.
vec3 irradianceSh(const vec4 sh[9], vec3 n, int bands) {
    vec3 e = vec3(sh[0]);
    if (bands >= 2) {
        e += vec3(sh[1]) * n.y + vec3(sh[2]) * n.z + vec3(sh[3]) * n.x;
    }
    if (bands >= 3) {
        e += vec3(sh[4]) * (n.x * n.y) + vec3(sh[5]) * (n.y * n.z) + vec3(sh[6]) * (3.0f * n.z * n.z - 1.0f);
        e += vec3(sh[7]) * (n.z * n.x) + vec3(sh[8]) * (n.x * n.x - n.y * n.y);
    }
    return max(e, vec3(0.0f));
}
