// SPDX-License-Identifier: Apache-2.0
// Alternative specular parameters: reflectance and index of refraction, the weights of KHR_materials_specular, and
// specular-glossiness. See f0FromReflectance(), f0FromIor() and iorFromF0() in brdf.glsl.

// Inverse of f0FromReflectance(). f0 in [0, 0.16] -> [0, 1], larger f0 give more.
float reflectanceFromF0(float f0) { return 2.5f * sqrt(f0); }

// Reflectance from an index of refraction. ior >= 1. Returns [0, 2.5): an ior above 2.33 exceeds the range of
// reflectance.
float reflectanceFromIor(float ior) { return 2.5f * (ior - 1.0f) / (ior + 1.0f); }

// Index of refraction from a reflectance: r = sqrt(f0) = 0.4 reflectance. [0, 1] -> [1, 2.34].
float iorFromReflectance(float reflectance) { return (1.0f + 0.4f * reflectance) / (1.0f - 0.4f * reflectance); }

// KHR_materials_specular, "Implementation": the colour tints the reflection of a dielectric of f0, up to 1, and the
// weight reduces it; metals are not affected. f0, weight, metallic, baseColor in [0, 1], specularColor >= 0.
vec3 f0FromSpecular(vec3 baseColor, float metallic, float f0, vec3 specularColor, float weight) {
    return mix(min(f0 * specularColor, vec3(1.0f)) * weight, baseColor, metallic);
}

// The same for grazing angles, which the colour does not tint. All in [0, 1].
float f90FromSpecular(float weight, float metallic) { return mix(weight, 1.0f, metallic); }

// KHR_materials_pbrSpecularGlossiness, appendix B: light that is not reflected is left to the diffuse lobe; f0 is the
// specular colour itself. All in [0, 1].
vec3 diffuseColorFromSpecularGlossiness(vec3 diffuse, vec3 specular) {
    return diffuse * (1.0f - max(specular.x, max(specular.y, specular.z)));
}

float perceptualRoughnessFromGlossiness(float glossiness) { return 1.0f - glossiness; }
