// SPDX-License-Identifier: Apache-2.0
// Fragment stage of post-process materials, entry point.

void main() {
    PostProcessInputs inputs;
    POST_CLEAR_OUTPUTS(inputs)
    postProcess(inputs);
    POST_WRITE_OUTPUTS(inputs)
}
