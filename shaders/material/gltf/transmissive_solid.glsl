// SPDX-License-Identifier: Apache-2.0
// KHR_materials_transmission with KHR_materials_volume, and KHR_materials_dispersion.

#include "shaders/material/gltf/transmission.glsl"

void material(inout MaterialInputs material) {
    readUvSets();
    vec2 widths = gltfNormals(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material, widths.x);
    gltfLayers(material, widths.y);
    vec2 amounts = gltfTransmission();
    material.transmission = amounts.x;
    material.thickness = amounts.y;
    if (materialConstants_hasAbsorption) material.absorption = materialParams.absorption;
    if (materialConstants_hasDispersion) material.dispersion = materialParams.dispersion;
}
