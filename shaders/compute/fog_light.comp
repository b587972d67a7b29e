// SPDX-License-Identifier: Apache-2.0
// Volumetric fog: the light that fog scatters towards the camera (Fog::volumetric), summed up along each column of cells from the
// camera on, after Wronski 2014, "Volumetric Fog: Unified Compute Shader Based Solution to Atmospheric Scattering". An
// invocation walks through one column, so that lighting and summing are one dispatch. Draws would need one for each slice,
// because a slice adds to what those before it sum up to.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 2, binding = 0, std430) writeonly buffer WrittenFogCells {
    uvec2 borders[];
} writtenFogCells;

layout(set = 2, binding = 1, std140) uniform FogHistoryUniforms {
    mat4 lastClipFromWorld; // from this frame's world
    vec4 lastAlongView;
    vec4 place; // z: of this frame in a sequence, [0, 1); w: share of the slices that it lights
    vec4 exposure; // x: of this frame, by that of the last one
} fogHistory;

// The light of a full cell: a column's cells follow each other.
layout(set = 2, binding = 2, std430) readonly buffer LastFogLight {
    uvec2 cells[];
} lastFogLight;

layout(set = 2, binding = 3, std430) writeonly buffer WrittenFogLight {
    uvec2 cells[];
} writtenFogLight;

#include "shaders/lib/light.glsl"
#include "shaders/lib/ltc.glsl"
#include "shaders/lib/profiles.glsl"
#include "shaders/lib/fog.glsl"
#include "shaders/lib/fog_noise.glsl"
#define HAS_SHADOW_MOMENTS
#include "shaders/lib/moments.glsl"
#include "shaders/material/surface/shadow_maps.glsl"
#include "shaders/material/surface/light_list.glsl"
#include "shaders/material/surface/light_images.glsl"
#include "shaders/material/surface/area_shapes.glsl"
#include "shaders/material/surface/profiles.glsl"
#include "shaders/material/surface/listed_light.glsl"

highp float ofFragment(highp float uniformValue) { return uniformValue; } // as in fragment_api.glsl
#include "shaders/material/surface/fog.glsl"

const int kFogLightVaries = 1; // shader::FogLightTerms
const int kFogLightIsWeakened = 2;
const int kFogLightOfFrames = 4;

highp vec3 litPoint; // whose shadows are looked up

// A point in the air has no plane: every texel of a filter is compared with its depth.
ShadowReceiver shadowReceiver(int map, highp vec3 toLight) {
    highp vec4 at = shadowUniforms.maps[map].atlasFromWorld * vec4(litPoint, 1.0);
    highp vec4 width = shadowUniforms.maps[map].texel;
    highp vec3 place = at.xyz / at.w;
    ShadowReceiver receiver;
    receiver.tile = shadowUniforms.maps[map].tile;
    receiver.softness = shadowUniforms.maps[map].softness;
    receiver.texel = place.xy;
    receiver.depth = place.z + (width.z + width.w * place.z);
    receiver.slope = vec2(0.0);
    receiver.pixel = 1.0;
    highp float reach = max(kFilterReach, receiver.softness.w + 1.0);
    receiver.isInside = at.w > 0.0 && place.x >= receiver.tile.x + reach && place.y >= receiver.tile.y + reach &&
            place.x < receiver.tile.z - reach && place.y < receiver.tile.w - reach;
    return receiver;
}

// Cells are wider than texels: the narrowest tent does.
highp float shadowOf(ShadowReceiver receiver) {
    return shadowFilter() >= kShadowVsm ? shadowOfBlurred(receiver) : shadowOfTent(receiver, 1);
}

// The mean over a slice, of points that divide it evenly: the edges of shafts cross many slices, and lamps do not.
const int kSunSamples = 4;
highp vec3 visibilityOfSun(highp vec3 begin, highp vec3 end) {
    highp vec3 visibility = vec3(1.0);
    if (variant_shadows != 0) {
        visibility = vec3(0.0);
        for (int i = 0; i < kSunSamples; ++i) {
            litPoint = mix(begin, end, (float(i) + 0.5) / float(kSunSamples));
            visibility += sunVisibility();
        }
        visibility /= float(kSunSamples);
    }
    return visibility;
}

highp vec3 visibilityOf(ListedLight listed, ListedRay ray) {
    highp vec3 visibility = vec3(1.0);
    if (variant_shadows != 0) {
        highp vec2 maps = lightBuffer.lights[listed.index].offset.yz;
        visibility = listedVisibility(maps, ray.isSun, ray.toLight);
    }
    return visibility;
}

// Metres of a cell across the view: images of lights are averaged over it.
highp float widthOfCell(highp vec3 point) {
    highp float distance = frameUniforms.clipFromView[3].w != 0.0 ? 1.0 : sqrt(dot(point, point));
    return distance * 2.0 / (frameUniforms.fogGrid.y * max(abs(frameUniforms.clipFromView[1].y), 1e-6));
}

// The light's image at the point.
highp vec3 colorByImage(ListedLight listed, ListedRay ray) {
    highp vec3 color = vec3(1.0);
    highp float own = ray.isAnArea ? ray.colorIntensity.w / kShapeImaged
                                   : lightBuffer.lights[listed.index].offset.w / kImagedLightStep;
    if (own >= 1.0) {
        int imaged = int(own) - 1;
        int table = int(lightBuffer.lights[imaged].offset.x);
        highp vec3 place;
        if (ray.isAnArea) {
            place = placeOnArea(areaLightAt(listed.index, ray.toLight, ray.colorIntensity), vec3(0.0), 1.0);
            place.z *= sqrt(float(froxelBuffer.words[table]) * float(froxelBuffer.words[table + 1]));
        } else {
            place = placeOnCookie(imaged, ray.isSun ? litPoint : -ray.toLight, widthOfCell(litPoint));
        }
        color = place.z < 0.0 ? vec3(0.0) : imageAt(table, vec2(place.x, place.y), log2(clamp(place.z, 1.0, 1e6)));
    }
    return color;
}

// Lux: on a plane that faces the light.
highp vec3 illuminanceBy(ListedLight listed, ListedRay ray) {
    highp vec3 illuminance = ray.colorIntensity.rgb;
    if (quality_lightImages != 0) illuminance *= colorByImage(listed, ray);
    if (ray.isAnArea) {
        AreaLight area = areaLightAt(listed.index, ray.toLight, ray.colorIntensity);
        illuminance *= integralOver(areaFrame(ray.direction, ray.direction), area).z;
    }
    return illuminance * ray.attenuation;
}

highp float phaseTowards(highp vec3 view, highp vec3 toLight) {
    return henyeyGreenstein(dot(view, toLight), frameUniforms.fogScattering.w);
}

// The share of light that fog lets through between a point and a light, without noise: it evens out along the way.
highp float shareOnTheWay(highp vec3 point, highp vec3 direction, highp float meters) {
    highp float share = 1.0;
    if ((quality_fog & kFogLightIsWeakened) != 0) {
        highp vec4 medium = frameUniforms.fogMedium;
        highp float density = medium.x - medium.y * point.y;
        share = 1.0 - fogOpacity(fogOpticalDepth(density, medium.y, direction.y, 0.0, meters), 1.0);
    }
    return share;
}

// What the lamps add to fog that covers all; view: unit, away from the camera.
highp vec3 lightOfLamps(highp vec3 view) {
    highp vec3 sum = vec3(0.0);
    LightList list = lightsNear(litPoint);
    ListedLight next = ListedLight(0, 0, vec4(0.0));
    findInRange(list, litPoint, next);
    for (;;) {
        ListedLight listed = next;
        bool isFound = listed.place < list.count;
        if (isFound) {
            ++next.place;
            findInRange(list, litPoint, next);
            ListedRay ray = rayOfListed(listed, litPoint);
            highp vec3 light = illuminanceBy(listed, ray) * phaseTowards(view, ray.direction);
            light *= shareOnTheWay(litPoint, ray.direction, ray.isSun ? kFogInfinity : length(ray.toLight));
            if (ray.attenuation > 0.0) sum += light * visibilityOf(listed, ray);
        }
        if (!isFound || next.place >= list.count) break; // last, as in findInRange()
    }
    return sum * frameUniforms.fogScattering.rgb;
}

uvec2 asHalves(highp vec4 light) {
    highp vec4 finite = min(light, vec4(65504.0));
    return uvec2(packHalf2x16(finite.xy), packHalf2x16(finite.zw));
}

// A column's ray, from `origin` relative to the camera.
struct FogColumn {
    FogRay ray;
    highp vec3 origin;
    highp float perDepth; // metres of the ray for each of depth
    highp vec3 fromSun;   // the light of a full cell in the sun
};

// at: in columns.
FogColumn fogColumnAt(highp vec2 at) {
    highp vec4 background = fogPointOnScreen(at / frameUniforms.fogGrid.xy * 2.0 - 1.0, frameUniforms.exposure.w);
    FogColumn column;
    column.ray = fogRayTo(background);
    bool isParallel = frameUniforms.clipFromView[3].w != 0.0;
    highp vec3 direction = column.ray.direction;
    column.origin = isParallel ? background.xyz - direction * dot(background.xyz, direction) : vec3(0.0);
    column.perDepth = 1.0 / dot(direction, fogForward());
    column.fromSun = frameUniforms.fogSun.rgb * phaseTowards(direction, frameUniforms.fogSunDirection.xyz);
    return column;
}

// Where the ray is between slices.
highp float fogMetersAt(FogColumn column, highp float slice) {
    return fogDepthOf(slice, frameUniforms.fogGrid.z, frameUniforms.fogGrid.w) * column.perDepth;
}

// The mean of the noise between two distances: of points that divide it evenly, each as wide as its part or the column.
const int kNoiseSamples = 4;
highp float noiseBetween(FogColumn column, highp float begin, highp float end) {
    highp float step = (end - begin) / float(kNoiseSamples), sum = 0.0;
    highp float columnAt1 = 2.0 / (abs(frameUniforms.clipFromView[0][0]) * frameUniforms.fogGrid.x);
    bool isParallel = frameUniforms.clipFromView[3].w != 0.0;
    for (int i = 0; i < kNoiseSamples; ++i) {
        highp float meters = begin + (float(i) + 0.5) * step;
        highp float width = max(isParallel ? columnAt1 : columnAt1 * meters / column.perDepth, step);
        highp vec3 place = frameUniforms.fogNoise.xyz + (column.origin + column.ray.direction * meters) * frameUniforms.fogNoise.w;
        sum += fogNoise(place, frameUniforms.fogVariation.y, width * frameUniforms.fogNoise.w);
    }
    return sum / float(kNoiseSamples);
}

// The light that a full cell of slice i scatters towards the camera, by what is between `begin` and `end`.
highp vec3 lightOfCell(FogColumn column, highp float begin, highp float end) {
    highp vec3 direction = column.ray.direction;
    highp vec3 light = column.fromSun * visibilityOfSun(column.origin + direction * begin, column.origin + direction * end);
    litPoint = column.origin + direction * (0.5 * (begin + end));
    light *= shareOnTheWay(litPoint, frameUniforms.fogSunDirection.xyz, kFogInfinity);
    return light + lightOfLamps(direction);
}

// Trilinear, of the frame before; w: 0 where that did not see the point.
highp vec4 lastLightAt(highp vec3 point) {
    highp vec4 grid = frameUniforms.fogGrid;
    highp vec4 clip = fogHistory.lastClipFromWorld * vec4(point, 1.0);
    highp float depth = dot(fogHistory.lastAlongView, vec4(point, 1.0));
    highp vec3 at = vec3((clip.xy / clip.w * 0.5 + 0.5) * grid.xy, fogSliceAt(depth, grid.z, grid.w));
    bool isSeen = clip.w > 0.0 && depth > 0.0 && depth < grid.w && at.x >= 0.0 && at.y >= 0.0 && at.x <= grid.x && at.y <= grid.y;
    at = clamp(at - 0.5, vec3(0.0), grid.xyz - 1.0);
    highp vec3 corner = floor(at), part = at - corner;
    highp vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        highp vec3 step = vec3(float(i & 1), float((i >> 1) & 1), float(i >> 2));
        highp vec3 cell = min(corner + step, grid.xyz - 1.0);
        highp vec3 shares = vec3(1.0) - abs(part - step);
        uvec2 halves = lastFogLight.cells[isSeen ? int((cell.y * grid.x + cell.x) * grid.z + cell.z) : 0];
        highp vec4 light = vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
        sum += light * (shares.x * shares.y * shares.z);
    }
    return isSeen ? sum : vec4(0.0);
}

// Each frame lights a part of the slices anew, by a sequence that comes back to each about as often; the others have the light
// that the last frame knew of the same place, and are lit where it knew none. All columns agree on the slices, because
// drivers for CPUs shade several in step. Halves are rounded down: without the half of their last bit, light would fade.
highp vec3 lightOverFrames(FogColumn column, highp vec2 cell, int slice, highp float begin, highp float end) {
    bool isDue = fract(fogHistory.place.z + 0.61803399 * float(slice)) < fogHistory.place.w;
    highp vec4 last = vec4(0.0);
    if (!isDue) last = lastLightAt(column.origin + column.ray.direction * fogMetersAt(column, float(slice) + 0.5));
    highp vec3 light = last.rgb * fogHistory.exposure.x;
    if (last.w < 0.5) light = lightOfCell(column, begin, end);
    writtenFogLight.cells[int((cell.y * frameUniforms.fogGrid.x + cell.x) * frameUniforms.fogGrid.z) + slice] =
            asHalves(vec4(light * 1.000244, 1.0));
    return light;
}

// The opacity from the camera to `end`, by that to `begin`, if the density varies.
highp float opacityBehind(FogColumn column, highp float opacity, highp float begin, highp float end) {
    highp vec4 medium = frameUniforms.fogMedium;
    highp float density = medium.x - medium.y * column.ray.height, from = max(begin, medium.z);
    highp float depth = fogOpticalDepth(density, medium.y, column.ray.direction.y, from, end);
    if (depth > 0.0) depth *= 1.0 + frameUniforms.fogVariation.x * noiseBetween(column, from, end);
    return min(opacity + (1.0 - opacity) * fogOpacity(depth, 1.0), frameUniforms.fogLight.w);
}

void main() {
    highp vec4 grid = frameUniforms.fogGrid;
    highp vec2 cell = vec2(gl_GlobalInvocationID.xy);
    if (cell.x < grid.x && cell.y < grid.y) {
        FogColumn column = fogColumnAt(cell + 0.5);
        int slices = int(grid.z);
        int border = int((cell.y * grid.x + cell.x) * (grid.z + 1.0));
        highp vec4 sum = vec4(0.0);
        writtenFogCells.borders[border] = asHalves(sum);
        for (int i = 0; i < slices; ++i) {
            highp float begin = fogMetersAt(column, float(i)), end = fogMetersAt(column, float(i + 1));
            highp float opacity = 0.0;
            if ((quality_fog & kFogLightVaries) != 0) {
                opacity = opacityBehind(column, sum.w, begin, end);
            } else {
                opacity = fogBetween(column.ray, frameUniforms.fogMedium.z, end);
            }
            highp vec3 light = vec3(0.0);
            if ((quality_fog & kFogLightOfFrames) != 0) {
                light = lightOverFrames(column, cell, i, begin, end);
            } else if (opacity > sum.w) {
                light = lightOfCell(column, begin, end);
            }
            sum = vec4(sum.rgb + light * (opacity - sum.w), opacity);
            writtenFogCells.borders[border + 1 + i] = asHalves(sum);
        }
    }
}
