// SPDX-License-Identifier: Apache-2.0
// Fragment stage of unlit surface materials, entry point: the base colour as it is, no light and no exposure.

void main() {
    MaterialInputs inputs;
    initMaterial(inputs);
    computeShadingGeometry();
    material(inputs);
    applyMask(inputs.baseColor);
    vec4 color = vec4(inputs.baseColor.rgb, outputAlpha(inputs.baseColor.a));
    addEmissive(inputs, color);
    blendPostLighting(inputs, color);
    fragment_color = color;
}
