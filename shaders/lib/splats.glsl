// SPDX-License-Identifier: Apache-2.0
// Splats: the kernel `ellipse` of the glTF extension KHR_gaussian_splatting, Kerbl et al. 2023, "3D Gaussian splatting for
// real-time radiance field rendering", section 4.

const float kSplatReach2 = 9.0f; // squared standard deviations

// How much a splat covers at some place. opacity: of its centre, [0, 1]. at: standard deviations from the centre along the
// axes of the ellipse. Returns [0, 1]; nothing from three standard deviations on. fp32 only: in 16 bits the edge shows.
float splatAlpha(float opacity, vec2 at) {
    float distance2 = at.x * at.x + at.y * at.y;
    return distance2 < kSplatReach2 ? opacity * exp(-0.5f * distance2) : 0.0f;
}

// The mean colour of blended splats: their sums of colours multiplied by alpha, and how much they cover together. Colours
// from 0 on; nothing covered is black. fp32 only: sums reach the ends of 16 bits.
vec3 splatMean(vec4 sums) {
    return vec3(sums.x, sums.y, sums.z) / max(sums.w, 1e-6f);
}
