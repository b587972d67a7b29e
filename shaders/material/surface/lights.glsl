// SPDX-License-Identifier: Apache-2.0
// The sum over all lights that reach a surface: shadeLight() of the shading model for each.

#if defined(VARIANT_PUNCTUAL)

// The lights that may reach a point, ascending by their place among those of the view.
struct LightList {
    int first;     // word of froxelBuffer, if it is the list of a froxel
    int count;
    bool isFroxel; // otherwise the lights are 0, 1, ..., count - 1: all of the view
};

// The froxel is that of the point, not of the pixel: it is the point that lights reach, and a vertex stage may draw it
// elsewhere. A point outside of the grid has all lights, so lists need not know what is there.
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

highp vec3 punctualLights(Surface surface) {
    highp vec3 sum = vec3(0.0);
    LightList list = lightsNear(vertex_worldPosition);
    int firstLight = int(frameUniforms.froxelPlaces.y);
    for (int i = 0; i < list.count; ++i) { // a loop even for few lights: unrolled code takes seconds to compile
        int index = i;
        if (list.isFroxel) index = int(froxelBuffer.words[list.first + i]);
        index += firstLight;
        highp vec4 positionRange = lightBuffer.lights[index].positionRange;
        highp vec4 colorIntensity = lightBuffer.lights[index].colorIntensity;
        bool isSun = colorIntensity.w < 0.0; // its position is the direction towards it
        highp vec3 toLight = isSun ? positionRange.xyz : positionRange.xyz - vertex_worldPosition;
        highp float attenuation = isSun ? 1.0 : distanceAttenuation(toLight, positionRange.w);
        if (attenuation <= 0.0) continue; // out of range
        highp vec3 direction = isSun ? toLight : normalizeOrZero(toLight);
        if (colorIntensity.w > 0.0) {
            highp vec4 directionScale = lightBuffer.lights[index].directionScale;
            highp float offset = lightBuffer.lights[index].offset.x;
            attenuation *= spotAttenuation(direction, directionScale.xyz, directionScale.w, offset);
            if (attenuation <= 0.0) continue; // outside the cone
        }
        Light arriving;
        arriving.direction = direction;
        arriving.illuminance = colorIntensity.rgb * attenuation;
#if defined(CUSTOM_SURFACE_SHADING)
        arriving.color = colorIntensity.rgb;
        arriving.attenuation = attenuation;
        arriving.position = isSun ? vertex_worldPosition + toLight : positionRange.xyz;
#endif
        sum += shadeLight(surface, arriving);
    }
    return sum;
}

#endif

void addLights(Surface surface, inout highp vec3 sum) {
#if defined(VARIANT_SUN)
    Light sun;
    sun.direction = frameUniforms.sunDirection.xyz;
    sun.illuminance = frameUniforms.sunIlluminance.rgb;
#if defined(CUSTOM_SURFACE_SHADING)
    sun.color = frameUniforms.sunIlluminance.rgb;
    sun.attenuation = 1.0;
    sun.position = vertex_worldPosition + sun.direction;
#endif
    sum += shadeLight(surface, sun);
#endif
#if defined(VARIANT_PUNCTUAL)
    sum += punctualLights(surface);
#endif
}
