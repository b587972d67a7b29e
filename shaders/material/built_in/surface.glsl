// SPDX-License-Identifier: Apache-2.0
// What the lit built-in materials have in common: everything but the base colour.

void setSurface(inout MaterialInputs material, vec3 color) {
    material.baseColor = vec4(color, 1.0);
    material.metallic = materialParams.metallic;
    material.roughness = materialParams.roughness;
    material.reflectance = materialParams.reflectance;
    material.emissive = vec4(materialParams.emissive, 1.0);
}
