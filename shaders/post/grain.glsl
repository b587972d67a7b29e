// SPDX-License-Identifier: Apache-2.0
// Noise of film on display values; included after shaders/lib/color.glsl. The material has the constant `grain` and the
// parameters `grainStrength` and `grainSize`.

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": PCG3D.
uvec3 hashed(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// Sum of three uniform distributions: mean 0, standard deviation 1.
float grainAt(ivec2 cell) {
    uvec3 bits = hashed(uvec3(uvec2(cell), floatBitsToUint(frameUniforms.time.x) ^ floatBitsToUint(frameUniforms.time.y)));
    vec3 even = vec3(bits >> 8u) * (1.0 / 16777216.0);
    return (even.x + even.y + even.z - 1.5) * 2.0;
}

// For any grain size: four of them are mixed, by weights that keep the standard deviation.
float grainOf(vec2 pixel, float size) {
    vec2 place = pixel / size;
    vec2 cell = floor(place);
    vec2 f = place - cell;
    vec4 weights = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    ivec2 at = ivec2(cell);
    vec4 grains = vec4(grainAt(at), grainAt(at + ivec2(1, 0)), grainAt(at + ivec2(0, 1)), grainAt(at + ivec2(1, 1)));
    return dot(grains, weights) * inversesqrt(dot(weights, weights));
}

// Strongest in the midtones: black and white of film have no grain.
vec3 grained(vec3 color) {
    if (materialConstants_grain) {
        float y = saturate(luminance(color));
        float share = 4.0 * y * (1.0 - y);
        color += grainOf(floor(gl_FragCoord.xy), materialParams.grainSize) * materialParams.grainStrength * share;
    }
    return color;
}
