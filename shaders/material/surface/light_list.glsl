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

// A light of a list.
struct ListedLight {
    int place; // in the list; its count: none
    int index; // in lightBuffer
    highp vec4 positionRange;
};

// Steps to the next light whose range the point is within, at `light.place` or after it.
// A loop of its own that reads only what it must: drivers for CPUs shade several fragments in step, with every
// instruction of a loop for all of them until the last one leaves it. So each fragment first finds its own next light,
// and shading runs as often as the fragment with most lights in range needs it, not once for each light listed.
void findInRange(LightList list, highp vec3 point, inout ListedLight light) {
    bool isSearching = light.place < list.count;
    for (;;) {
        if (isSearching) {
            light.index = light.place;
            if (list.isFroxel) light.index = int(froxelBuffer.words[list.first + light.place]);
            light.index += int(frameUniforms.froxelPlaces.y);
            light.positionRange = lightBuffer.lights[light.index].positionRange;
            highp vec3 toLight = light.positionRange.xyz - point;
            // Where distanceAttenuation() and rangeWindow() are 0. Suns are unlimited: their w is 0.
            bool isOutside = dot(toLight, toLight) * light.positionRange.w >= 1.0;
            if (isOutside) ++light.place;
            isSearching = isOutside && light.place < list.count;
        }
        if (!isSearching) break; // last in the loop: whatever follows a break runs once more, for no fragment
    }
}
