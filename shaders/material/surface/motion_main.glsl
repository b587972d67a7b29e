// SPDX-License-Identifier: Apache-2.0
// Fragment stage of motion variants: the way from this pixel to the point's place in the previous frame. Surface
// properties do not matter, because the pass draws over known depths.

layout(location = 0) in vec4 vertex_lastClip;
layout(location = 1) in vec2 vertex_distances;
layout(location = 0) out vec4 fragment_motion; // FrameTargets::motion

const float kOutOfPicture = 4.0; // in widths and heights of the screen: larger than any distance of two pixels
const float kLargestHalf = 65504.0;

void main() {
    vec2 here = gl_FragCoord.xy * passUniforms.target.zw;
    bool wasInFront = vertex_lastClip.w > 0.0 && vertex_distances.x > 0.0;
    vec2 there = vertex_lastClip.xy / (wasInFront ? vertex_lastClip.w : 1.0) * 0.5 + 0.5;
    vec2 moved = wasInFront ? clamp(there - here, -kOutOfPicture, kOutOfPicture) : vec2(kOutOfPicture);
    float ratio = vertex_distances.x / max(vertex_distances.y, 1e-30);
    fragment_motion = vec4(moved, clamp(ratio, 0.0, kLargestHalf), 1.0);
}
