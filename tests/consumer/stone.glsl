// SPDX-License-Identifier: Apache-2.0
vec3 stoneColor(vec3 tint) {
    return 0.5 * tint;
}
