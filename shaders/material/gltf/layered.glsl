// SPDX-License-Identifier: Apache-2.0
// Opaque matter with layers.

#include "shaders/material/gltf/surface.glsl"

#include "shaders/material/gltf/layers.glsl"

void material(inout MaterialInputs material) {
    readUvSets();
    vec2 widths = gltfNormals(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material, widths.x);
    gltfLayers(material, widths.y);
}
