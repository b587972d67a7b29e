// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 without extensions that change the shading.

#include "shaders/material/gltf/surface.glsl"

void material(inout MaterialInputs material) {
    readUvSets();
    float width = gltfSurfaceNormal(material);
    prepareMaterial(material);
    gltfBump();
    gltfSurface(material, width);
}
