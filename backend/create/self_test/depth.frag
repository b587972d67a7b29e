#version 310 es
// SPDX-License-Identifier: Apache-2.0
void main() {
    gl_FragDepth = 0.5;
}
