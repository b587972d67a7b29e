// SPDX-License-Identifier: Apache-2.0
// Which lights of a view may reach a point.

// The lights that may reach a point, ascending by their place among those of the view.
struct LightList {
    int first;     // word of froxelBuffer, if it is the list of a froxel
    int count;
    bool isFroxel; // otherwise the lights are 0, 1, ..., count - 1: all of the view
};

// The froxel is that of the position, not of the pixel: lights reach the position, and a vertex stage may draw it
// elsewhere. A point outside of the grid has all lights, so lists need no bounds.
// filament_core/prepare/Froxels.cpp, froxelAt(), is the twin.
LightList lightsNear(highp vec3 point) {
    highp vec4 grid = frameUniforms.froxelGrid;
    highp vec4 clip = frameUniforms.clipFromWorld * vec4(point, 1.0);
    highp float depth = -(frameUniforms.viewFromWorld * vec4(point, 1.0)).z;
    highp vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * grid.xy;
    LightList list;
    list.isFroxel = clip.w > 0.0 && depth > 0.0 && at.x >= 0.0 && at.x < grid.x && at.y >= 0.0 && at.y < grid.y;
    list.first = int(frameUniforms.froxelPlaces.z);
    list.count = int(frameUniforms.ambient.w);
    if (list.isFroxel) {
        int slice = int(floatBitsToUint(depth) >> uint(frameUniforms.froxelPlaces.x)) - int(grid.w);
        slice = clamp(slice, 0, int(grid.z) - 1);
        int froxel = (slice * int(grid.y) + int(at.y)) * int(grid.x) + int(at.x);
        uint word = froxelBuffer.words[list.first + froxel];
        list.first += int(word >> uint(kFroxelCountBits));
        list.count = int(word & ((1u << uint(kFroxelCountBits)) - 1u));
    }
    return list;
}
