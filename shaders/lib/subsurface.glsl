// SPDX-License-Identifier: Apache-2.0
// Light scattered below the surface of wax, leaves and skin, for lights and for the sky: Barre-Brisebois and Bouchard
// 2011, "Approximating Translucency for a Fast, Cheap and Convincing Subsurface Scattering Look", GPU Pro 2: a lobe
// around the light's direction, seen through the object, and a wrapped diffuse lobe. Here both lobes are divided by
// their integrals, and the scattered light is removed from the surface's diffuse lobe, so that no material gains
// energy.
//   opacity  0: all light passes, 1: none. power: narrowness of the transmitted lobe, >= 0.

const float kLn2 = 0.693147180559945f;
// Below this the transmitted lobe is uniform to 1 part in 1000.
const float kMinSubsurfacePower = 0.0009765625f;

// The share of light that a material's thickness stops. Beer and Lambert's exponential, so that any thickness lets some
// light through; with 2^(-2 thickness) it agrees with the paper's linear 1 - thickness at 0 and at the default, 0.5.
// thickness >= 0. Returns [0, 1].
float subsurfaceOpacity(float thickness) { return 1.0f - exp2(-2.0f * max(thickness, 0.0f)); }

// The forward part: 2^(power (cos - 1)) of the angle with the light's direction, cut at a right angle. Its integral
// over the sphere is 2 pi ((1 - 2^-power) / (power ln 2) + 2^-power). lov = light . view in [-1, 1]. Returns 1/sr.
float subsurfaceForward(float lov, float power) {
    float p = max(power, kMinSubsurfacePower);
    float x = p * kLn2;
    float integral = oneMinusExp(x) / x + exp2(-p);
    return exp2(p * (saturate(-lov) - 1.0f)) * (0.5f * kInversePi) / integral;
}

// The scattered part of one light, in place of a lobe times nol: half of it forward, half of it wrapped around the
// surface, further for a smaller opacity. nol, lov in [-1, 1], opacity in [0, 1]. Multiply by subsurfaceColor and
// illuminance. Returns 1/sr; its integral over light directions is 1 - opacity.
float subsurfaceScatter(float nol, float lov, float opacity, float power) {
    float around = diffuseWrapped(nol, 1.0f - opacity);
    return (1.0f - opacity) * 0.5f * (around + subsurfaceForward(lov, power));
}

// The factor of the surface's diffuse lobe: the part that is not scattered below. In [0, 1].
float subsurfaceDiffuseScaling(vec3 subsurfaceColor, float opacity) {
    return 1.0f - (1.0f - opacity) * max(subsurfaceColor.x, max(subsurfaceColor.y, subsurfaceColor.z));
}

// The perceptual roughness of the GGX lobe as wide as subsurfaceForward(), for looking up the environment behind the
// object. Own derivation: the transmitted lobe falls to half of its peak at an angle whose square is 2 / power, D where
// the square of half the angle is (sqrt(2) - 1) alpha^2. Returns (0, 1].
float subsurfaceForwardRoughness(float power) { return pow(max(0.82842712f * power, 1.0f), -0.25f); }
