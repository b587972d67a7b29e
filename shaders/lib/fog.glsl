// SPDX-License-Identifier: Apache-2.0
// Fog whose density falls off exponentially with height: density(h) = density(0) e^(-falloff h).

// What lies at infinity counts as this far away, in metres: products with any density stay finite.
const float kFogInfinity = 1e15f;

// The optical depth between two points of a ray, in closed form. Wenzel 2007, "Real-time Atmospheric Effects in Games
// Revisited", and Quilez 2010, "Better Fog", integrate from the camera: e^(-falloff rise t) then overflows on rays that
// lead down. Here the lower of the two points is the origin: with x = falloff |rise| length, the integral is
//     density(lower) length (1 - e^-x) / x,
// whose last factor is in (0, 1], whatever the ray. It is 1 on level rays.
// logDensity: the logarithm of the density, in 1/m, at the height where the ray begins (distance 0); falloff: 1/m, [0,
// 1e3]; rise: metres up for each metre of the ray, [-1, 1]; from, to: metres along the ray, [0, kFogInfinity]. Returns
// [0, 3e37]; 0 unless `to` is beyond `from`. Relative error: that of falloff * height + logDensity, absolute. fp32
// only.
float fogOpticalDepth(float logDensity, float falloff, float rise, float from, float to) {
    float length = max(to - from, 0.0f);
    float lowest = min(rise * from, rise * to);
    float density = exp(clamp(logDensity - falloff * lowest, -80.0f, 50.0f));
    float x = falloff * max(rise, -rise) * length;
    float share = x > 1e-20f ? oneMinusExp(x) / x : 1.0f;
    return density * length * share;
}

// The share of light that fog of this optical depth replaces (Beer and Lambert). largest: [0, 1]. fp32 only.
float fogOpacity(float opticalDepth, float largest) { return min(oneMinusExp(opticalDepth), largest); }

// The glow of fog around a light, relative to that towards it: a power of the cosine between both directions. With the
// factor (exponent + 1) / (2 pi) it sums to 1 over the sphere: all light that the fog takes, it scatters (Lewis 1994,
// "Making Shaders More Physically Plausible", section 4, for the lobe of Phong). cosine: [-1, 1]; exponent: [0, 1e3].
// fp32 only.
float fogGlow(float cosine, float exponent) { return cosine > 0.0f ? pow(min(cosine, 1.0f), exponent) : 0.0f; }

// The phase function of Henyey and Greenstein 1941, "Diffuse radiation in the Galaxy", times 4 pi: its mean over the
// sphere is 1. cosine: between the direction in which the camera looks and that towards the light, [-1, 1]; asymmetry:
// the mean cosine of scattering, [-0.95, 0.95]; 0: alike in all directions. Returns (0, 780]. fp32 only.
float henyeyGreenstein(float cosine, float asymmetry) {
    float square = max(1.0f + asymmetry * asymmetry - 2.0f * asymmetry * cosine, 1e-4f);
    return (1.0f - asymmetry * asymmetry) / (square * sqrt(square));
}

// Volumetric fog is cut into slices whose thickness grows with the distance: slice i begins at the depth
// (i / slices)^2 meters. depth: metres in front of the camera, >= 0. Returns [0, slices]. fp32 only.
float fogSliceAt(float depth, float slices, float meters) { return sqrt(saturate(depth / meters)) * slices; }

// The inverse: the depth in metres of a place between slices.
float fogDepthOf(float slice, float slices, float meters) { return sq(slice / slices) * meters; }
