// SPDX-License-Identifier: Apache-2.0
// KHR_materials_volume_scatter in a solid.

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
    material.multiscatterColor = materialParams.multiscatterColor;
    if (materialConstants_hasMultiscatterMap) {
        material.multiscatterColor *= texture(materialParams_multiscatterMap, mapUv(materialConstants_multiscatterUv,
                materialConstants_multiscatterTransform, materialParams.multiscatterUvMatrix)).rgb;
    }
    material.scatterAnisotropy = materialParams.scatterAnisotropy;
}
