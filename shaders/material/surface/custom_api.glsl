// SPDX-License-Identifier: Apache-2.0
// Arguments of the author's surfaceShading() for each light (materials guide, 4.4.3), placed before the author's code.

struct ShadingData {
    vec3 diffuseColor;         // times alpha
    vec3 f0;                   // reflectance at normal incidence
    float perceptualRoughness; // clamped and filtered
    float roughness;           // its square
};

struct LightData {
    vec4 colorIntensity; // rgb: colour, its largest component is 1; w: pre-exposed lux or candela
    vec3 l;              // to the light, unit
    float NdotL;         // [0, 1]
    vec3 worldPosition;  // for the sun: a metre away in its direction
    float attenuation;   // by distance and cone: 1 / m^2; 1 for the sun
    float visibility;    // [0, 1]: visibility from shadows
};
