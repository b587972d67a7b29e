// SPDX-License-Identifier: Apache-2.0
// KHR_materials_transmission without a volume: an infinitely thin wall tinted by the base colour.

#include "shaders/material/gltf/transmission.glsl"

void material(inout MaterialInputs material) {
    readUvSets();
    vec2 widths = gltfNormals(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material, widths.x);
    gltfLayers(material, widths.y);
    material.transmission = gltfTransmission().x;
}
