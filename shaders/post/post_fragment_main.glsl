// SPDX-License-Identifier: Apache-2.0
// Fragment stage of post-process materials, entry point.

void main() {
    PostProcessInputs inputs;
    inputs.color = vec4(0.0, 0.0, 0.0, 1.0);
    postProcess(inputs);
    fragment_color = inputs.color;
}
