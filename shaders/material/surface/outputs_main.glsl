// SPDX-License-Identifier: Apache-2.0
// Fragment stage of unlit surface materials with `outputs`, entry point: the outputs as the code leaves them, for mesh
// passes. Of the base colour only the mask counts; there is no light, exposure or fog.

void main() {
    MaterialInputs inputs;
    initMaterial(inputs);
    computeShadingGeometry();
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(0.0); // as in other materials
#endif
    material(inputs);
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(inputs.pixelDepthOffset);
#endif
    applyMask(inputs.baseColor);
    SURFACE_WRITE_OUTPUTS(inputs)
}
