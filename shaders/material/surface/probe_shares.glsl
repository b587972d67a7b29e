// SPDX-License-Identifier: Apache-2.0
// Where vertex_worldPosition lies in the boxes of the view's reflection probes.

highp mat3 worldFromProbe(int i) {
    return mat3(probeUniforms.probes[i].axes[0].xyz, probeUniforms.probes[i].axes[1].xyz,
            probeUniforms.probes[i].axes[2].xyz);
}

highp vec3 halfExtentOfProbe(int i) {
    return vec3(probeUniforms.probes[i].axes[0].w, probeUniforms.probes[i].axes[1].w, probeUniforms.probes[i].axes[2].w);
}

highp vec3 pointInProbe(int i) {
    return (vertex_worldPosition - probeUniforms.probes[i].center.xyz) * worldFromProbe(i);
}

highp float shareOfProbe(int i, highp float left) {
    return probeShare(probeWeight(pointInProbe(i), halfExtentOfProbe(i), probeUniforms.probes[i].center.w), left);
}
