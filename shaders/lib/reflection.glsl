// SPDX-License-Identifier: Apache-2.0
// Screen-space reflections: the confidence of a hit, and its blur. All of it is fp32
// only, like screen-space rays.

// A smooth step from 0 to 1 over [0, 1]. Returns [0, 1]. fp32 only.
float smoothUnit(float x) {
    float t = saturate(x);
    return t * t * (3.0f - 2.0f * t);
}

// 1 inside of the screen, falling to 0 over the outer `border` of each side, where neighbours of the hit are missing.
// uv in the screen's [0, 1]^2, or outside of it: 0. border in [0.001, 0.5]. Returns [0, 1]. fp32 only.
float insideWeight(vec2 uv, float border) {
    float x = min(uv.x, 1.0f - uv.x);
    float y = min(uv.y, 1.0f - uv.y);
    return smoothUnit(x / border) * smoothUnit(y / border);
}

// Rays that return to the camera meet the backs of what it sees: 1 away from it or across, 0 from 60 degrees off its
// direction on. cosine: between ray and the direction to the camera, [-1, 1]. Returns [0, 1]. fp32 only.
float awayWeight(float cosine) { return 1.0f - smoothUnit(2.0f * cosine); }

// The last quarter of a ray fades, so that what comes into its reach does not pop up. share: of the ray's length, [0,
// 1]. Returns [0, 1]. fp32 only.
float reachWeight(float share) { return smoothUnit((1.0f - share) * 4.0f); }

// Radius of the lobe around a mirrored ray, in units of the ray's length, within which half of its facets reflect:
// facets lean by up to atan(alpha) (the NDF of GGX, Walter et al. 2007, eq. 35 for one half), the ray by twice that.
// Limited to 45 degrees. alpha in [0, 1]. Returns [0, 1]. fp32 only.
float lobeRadius(float alpha) { return min(2.0f * alpha / max(1.0f - alpha * alpha, 1e-3f), 1.0f); }

// The level of a chain of blurred images that is as blurred as a disc of this radius: level n blurs as a Gaussian
// with a deviation of about 0.6 2^n pixels, and a Gaussian has one half within 1.18 deviations. radius in pixels, >= 0.
// Returns >= 0. fp32 only.
float blurLevel(float radius) { return log2(max(1.41f * radius, 1.0f)); }
