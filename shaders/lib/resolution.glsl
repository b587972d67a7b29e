// SPDX-License-Identifier: Apache-2.0
// Filters that upscale an image, that accumulate its samples over frames, and that sharpen it;
// included after color.glsl.

// Weights of the texels at -1, 0, 1 and 2 for a place f in [0, 1] between those at 0 and 1: Catmull and Rom 1974, "A
// class of local interpolating splines". Their sum is 1; parabolas are kept as they are.
vec4 catmullRomWeights(float f) {
    return vec4(f * (-0.5f + f * (1.0f - 0.5f * f)), 1.0f + f * f * (-2.5f + 1.5f * f),
            f * (0.5f + f * (2.0f - 1.5f * f)), f * f * (-0.5f + 0.5f * f));
}

// Light in [0, 1), each component by itself: a filter of it cannot spread a lamp over its neighbours. light >= 0.
// fp32 only: its inverse is steep near 1.
vec3 boundedLight(vec3 light) { return light / (1.0f + light); }

// Inverse of boundedLight(); beyond its range, the largest half float. fp32 only.
vec3 lightFromBounded(vec3 bounded) {
    vec3 x = clamp(bounded, 0.0f, 1.0f);
    return min(x / max(1.0f - x, 1e-5f), 65504.0f);
}

// ---- the edge-adaptive filter: Lottes 2021, "AMD FidelityFX Super Resolution" (presentation), its part EASU

// How monotonic the change from `before` over `here` to `after` is: 1 for a ramp and beside an edge, 0 for a line and
// for noise. Any brightness.
float monotony(float before, float here, float after) {
    float most = max(abs(after - here), abs(here - before));
    return most > 0.0f ? min(abs(after - before) / most, 1.0f) : 0.0f;
}

// How the filter lies on an edge of a monotony in [0, 1] whose unit gradient is `gradient`: x: factor of distances
// across it, that keeps the filter narrow where texels lie diagonally; y: along it, where the filter is up to twice as
// long; z: 1 / its squared radius.
vec3 edgeShape(float gradientX, float gradientY, float edge) {
    float diagonal = 1.0f / max(max(abs(gradientX), abs(gradientY)), 0.5f); // 1 along the axes, sqrt(2) at most
    return vec3(1.0f + (diagonal - 1.0f) * edge, 1.0f - 0.5f * edge, 0.5f - 0.29f * edge);
}

// Weight at the squared distance x in [0, 1 / lobe]: polynomials for the sine quotient of Lanczos' filter and for the
// window that ends it. 1 at 0, 0 at 1, negative between 1 and 4, 0 at the end. lobe in [0.21, 0.5].
float edgeKernel(float x, float lobe) {
    float base = 0.4f * x - 1.0f;
    float window = lobe * x - 1.0f;
    return (1.5625f * base * base - 0.5625f) * (window * window);
}

// ---- sharpening: the same presentation, its part RCAS

// A quarter less than where the sum of all weights would be zero.
const float kMostSharpening = 0.1875f;

// Weight of each of the four neighbours, [-kMostSharpening, 0], such that the result stays in [0, 1]. `least` and `most`
// of the pixel and its neighbours in each component, in [0, 1].
float sharpeningWeight(vec3 least, vec3 most) {
    vec3 dark = least / max(4.0f * most, 1e-6f);
    vec3 bright = (1.0f - most) / max(4.0f - 4.0f * least, 1e-6f);
    float room = min(min(min(dark.x, dark.y), dark.z), min(min(bright.x, bright.y), bright.z));
    return -clamp(room, 0.0f, kMostSharpening);
}

// ---- temporal accumulation

// Of a sample `away` pixels from the middle of a pixel along one axis: a box whose edges are ramps of twice the width
// `ramp`, in [1/16, 1/2]. Its integral is 1 for each of them.
float sampleShare(float away, float ramp) { return saturate((0.5f + ramp - abs(away)) / (2.0f * ramp)); }
