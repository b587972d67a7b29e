// SPDX-License-Identifier: Apache-2.0
// Opaque matter with layers.

#include "shaders/material/gltf/surface.glsl"

#include "shaders/material/gltf/layers.glsl"

void material(inout MaterialInputs material) {
    gltfNormals(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material);
    gltfLayers(material);
}
