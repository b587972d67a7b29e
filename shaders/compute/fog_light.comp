// SPDX-License-Identifier: Apache-2.0
// Volumetric fog: the light that fog scatters towards the camera (Fog::volumetric), summed up along each column of cells from the
// camera on, after Wronski 2014, "Volumetric Fog: Unified Compute Shader Based Solution to Atmospheric Scattering". An
// invocation walks through one column, so that lighting and summing are one dispatch. Draws would need one for each slice,
// because a slice adds to what those before it sum up to.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 2, binding = 0, std430) writeonly buffer WrittenFogCells {
    uvec2 borders[];
} writtenFogCells;

#include "shaders/lib/light.glsl"
#include "shaders/lib/ltc.glsl"
#include "shaders/lib/profiles.glsl"
#include "shaders/lib/fog.glsl"
#define HAS_SHADOW_MOMENTS
#include "shaders/lib/moments.glsl"
#include "shaders/material/surface/shadow_maps.glsl"
#include "shaders/material/surface/light_list.glsl"
#include "shaders/material/surface/area_shapes.glsl"
#include "shaders/material/surface/profiles.glsl"
#include "shaders/material/surface/listed_light.glsl"

highp float ofFragment(highp float uniformValue) { return uniformValue; } // as in fragment_api.glsl
#include "shaders/material/surface/fog.glsl"

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
    return quality_shadowFilter >= kShadowVsm ? shadowOfBlurred(receiver) : shadowOfTent(receiver, 1);
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

// Lux: on a plane that faces the light.
highp vec3 illuminanceBy(ListedLight listed, ListedRay ray) {
    highp vec3 illuminance = ray.colorIntensity.rgb;
    if (ray.isAnArea) {
        AreaLight area = areaLightAt(listed.index, ray.toLight, ray.colorIntensity);
        illuminance *= integralOver(areaFrame(ray.direction, ray.direction), area).z;
    }
    return illuminance * ray.attenuation;
}

highp float phaseTowards(highp vec3 view, highp vec3 toLight) {
    return henyeyGreenstein(dot(view, toLight), frameUniforms.fogScattering.w);
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

void main() {
    highp vec4 grid = frameUniforms.fogGrid;
    highp vec2 cell = vec2(gl_GlobalInvocationID.xy);
    if (cell.x < grid.x && cell.y < grid.y) {
        highp vec4 background = fogPointOnScreen((cell + 0.5) / grid.xy * 2.0 - 1.0, frameUniforms.exposure.w);
        FogRay ray = fogRayTo(background);
        bool isParallel = frameUniforms.clipFromView[3].w != 0.0;
        highp vec3 origin = isParallel ? background.xyz - ray.direction * dot(background.xyz, ray.direction) : vec3(0.0);
        highp float perDepth = 1.0 / dot(ray.direction, fogForward());
        highp vec3 fromSun = frameUniforms.fogSun.rgb * phaseTowards(ray.direction, frameUniforms.fogSunDirection.xyz);
        int slices = int(grid.z);
        int border = int((cell.y * grid.x + cell.x) * (grid.z + 1.0));
        highp vec4 sum = vec4(0.0);
        writtenFogCells.borders[border] = asHalves(sum);
        for (int i = 0; i < slices; ++i) {
            highp float begin = fogDepthOf(float(i), grid.z, grid.w) * perDepth;
            highp float end = fogDepthOf(float(i + 1), grid.z, grid.w) * perDepth;
            highp float opacity = fogBetween(ray, frameUniforms.fogMedium.z, end);
            highp vec3 light = vec3(0.0);
            if (opacity > sum.w) {
                light = fromSun * visibilityOfSun(origin + ray.direction * begin, origin + ray.direction * end);
                litPoint = origin + ray.direction * (0.5 * (begin + end));
                light += lightOfLamps(ray.direction);
            }
            sum = vec4(sum.rgb + light * (opacity - sum.w), opacity);
            writtenFogCells.borders[border + 1 + i] = asHalves(sum);
        }
    }
}
