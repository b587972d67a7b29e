// SPDX-License-Identifier: Apache-2.0
// Geometric specular anti-aliasing: normal variation within a pixel is converted to roughness.

// Kaplanyan 2016, "Stable Specular Highlights"; Tokuyoshi and Kaplanyan 2019, "Improved Geometric Specular
// Antialiasing", eq. 7 with the isotropic kernel.
// ddxNormal, ddyNormal: screen-space derivatives of the geometric world normal. variance: of the screen-space filter,
// usually 0.15 (0: off); threshold: the largest addition to alpha^2, usually 0.2. Returns [perceptualRoughness, 1].
float filteredPerceptualRoughness(float perceptualRoughness, vec3 ddxNormal, vec3 ddyNormal, float variance,
        float threshold) {
    float kernel = variance * (dot(ddxNormal, ddxNormal) + dot(ddyNormal, ddyNormal));
    float alpha = perceptualRoughness * perceptualRoughness;
    float alphaSquared = saturate(alpha * alpha + min(2.0f * kernel, threshold));
    return sqrt(sqrt(alphaSquared));
}
