// SPDX-License-Identifier: Apache-2.0
// KHR_materials_unlit: the base colour is the colour.

#include "shaders/material/gltf/base_color.glsl"

void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = gltfBaseColor();
}
