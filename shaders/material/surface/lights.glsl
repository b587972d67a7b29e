// SPDX-License-Identifier: Apache-2.0
// The sum over all lights that reach a surface: shadeLight() of the shading model for each.

// Lights in full shadow are not shaded; authors' models see them, and catchers of shadows weigh them.
bool isLit(highp vec3 visibility) {
#if defined(CUSTOM_SURFACE_SHADING) || defined(SHADOW_MULTIPLIER)
    return true;
#else
    return max3(visibility) > 0.0;
#endif
}

#if defined(HAS_LIGHT_LIST)

// Metres that a pixel of the image covers across the view.
highp float widthOfPixel(highp vec3 point) {
    highp float distance = ofFragment(frameUniforms.clipFromView[3].w) != 0.0 ? 1.0 : sqrt(dot(point, point));
    return distance * 2.0 * passUniforms.target.w / max(abs(frameUniforms.clipFromView[1].y), 1e-6);
}

#include "shaders/material/surface/light_list.glsl"
#include "shaders/material/surface/listed_light.glsl"
#if defined(RECEIVES_SHADOWS)
#include "shaders/material/surface/area_shadows.glsl"
#endif

highp vec3 areaLight(Surface surface, AreaLight area) {
    highp vec3 reflected;
#if defined(AREA_LIGHTS_BY_LTC)
    if (quality_areaLights == kAreaLightsLtc) {
        area.luminance *= area.visibility;
        reflected = shadeAreaByLtc(surface, area);
    } else
#endif
    {
        reflected = shadeAreaAsPoint(surface, area);
    }
    return reflected;
}

// Multiplies the light with its image. One loop for all lobes and kinds of lights: the code of a look-up is there once.
void applyImage(Surface surface, int index, inout ListedRay ray, inout AreaLight area) {
    highp float own = ray.isAnArea ? ray.colorIntensity.w / kShapeImaged : lightBuffer.lights[index].offset.w / kImagedLightStep;
    if (own >= 1.0) {
        int imaged = int(own) - 1;
        int table = int(lightBuffer.lights[imaged].offset.x);
        highp float texels = sqrt(float(froxelBuffer.words[table]) * float(froxelBuffer.words[table + 1]));
        highp float width = widthOfPixel(vertex_worldPosition);
        int lobes = ray.isAnArea ? 2 : 1;
        for (int i = 0; i < lobes; ++i) {
            highp vec3 axis = vec3(0.0);
            highp float spread = 1.0;
#if defined(AREA_LIGHTS_BY_LTC)
            if (i == 1) {
                axis = reflect(-surface.view, surface.normal);
                spread = surface.alpha;
            }
#endif
            highp vec3 place;
            if (ray.isAnArea) {
                place = placeOnArea(area, axis, spread);
                place.z *= texels;
            } else {
                place = placeOnCookie(imaged, ray.isSun ? vertex_worldPosition : -ray.toLight, width);
            }
            highp vec3 color = vec3(0.0);
            if (place.z >= 0.0) color = imageAt(table, vec2(place.x, place.y), log2(clamp(place.z, 1.0, 1e6)));
            if (i == 0) area.color = color;
            area.mirrored = color;
        }
        if (!ray.isAnArea) ray.colorIntensity.rgb *= area.color;
    }
}

highp vec3 punctualLight(Surface surface, ListedLight listed) {
    int index = listed.index;
    ListedRay ray = rayOfListed(listed, vertex_worldPosition);
    highp vec4 colorIntensity = ray.colorIntensity;
    highp vec3 toLight = ray.toLight, direction = ray.direction;
    highp float attenuation = ray.attenuation;
    bool isSun = ray.isSun, isAnArea = ray.isAnArea;
    highp vec3 light = vec3(0.0);
    if (attenuation > 0.0) { // in range, within the cone, and the profile is not dark in this direction
        highp vec3 visibility = vec3(1.0);
#if defined(RECEIVES_SHADOWS)
        if (variant_shadows != 0) {
            highp vec2 maps = lightBuffer.lights[index].offset.yz;
            if (quality_shadowFilter >= kShadowsOfShapes && isAnArea) {
                visibility = areaVisibility(areaLightAt(index, toLight, colorIntensity), maps);
            } else {
                visibility = listedVisibility(maps, isSun, toLight);
            }
        }
#endif
        if (quality_contactShadows != 0) {
            bool isAsked = (int(lightBuffer.lights[index].offset.z) & kContactShadowBit) != 0 && isLit(visibility);
            highp float reach = isSun ? frameUniforms.contactShadows.x : sqrt(dot(toLight, toLight));
            visibility *= contactVisibility(isAsked, direction, reach);
        }
#if defined(SHADOW_MULTIPLIER)
        highp vec3 left = takeShadow(visibility);
#endif
        AreaLight area;
        if (isAnArea) area = areaLightAt(index, toLight, colorIntensity);
        if (quality_lightImages != 0 && isLit(visibility)) {
            applyImage(surface, index, ray, area);
            colorIntensity = ray.colorIntensity;
        }
        if (isAnArea) {
            area.luminance *= attenuation;
            area.visibility = visibility;
            if (isLit(visibility)) light = areaLight(surface, area);
        } else if (isLit(visibility)) {
            Light arriving;
            arriving.direction = direction;
            arriving.illuminance = colorIntensity.rgb * (visibility * attenuation);
#if defined(CUSTOM_SURFACE_SHADING)
            arriving.color = tintedByShadow(colorIntensity.rgb, visibility);
            arriving.attenuation = attenuation;
            arriving.visibility = max3(visibility);
            arriving.position = isSun ? vertex_worldPosition + toLight : listed.positionRange.xyz;
#endif
            light = shadeLight(surface, arriving);
        }
#if defined(SHADOW_MULTIPLIER)
        shading_leftByShadows += light * left;
#endif
    }
    return light;
}

highp vec3 punctualLights(Surface surface) {
    highp vec3 sum = vec3(0.0);
    LightList list = lightsNear(vertex_worldPosition);
    ListedLight next = ListedLight(0, 0, vec4(0.0));
    findInRange(list, vertex_worldPosition, next);
    for (;;) { // a loop even for few lights: unrolled code takes seconds to compile
        ListedLight light = next;
        bool isFound = light.place < list.count;
        if (isFound) {
            ++next.place;
            findInRange(list, vertex_worldPosition, next);
            sum += punctualLight(surface, light);
        }
        if (!isFound || next.place >= list.count) break; // last, as in findInRange()
    }
    return sum;
}

#endif

#if defined(HAS_SUN)

highp vec3 sunLight(Surface surface) {
    highp vec3 visibility = vec3(1.0);
#if defined(RECEIVES_SHADOWS)
    if (variant_shadows != 0) visibility = sunVisibility();
#endif
    if (quality_contactShadows != 0) {
        bool isAsked = frameUniforms.contactShadows.w > 0.0 && max3(visibility) > 0.0;
        visibility *= contactVisibility(isAsked, frameUniforms.sunDirection.xyz, frameUniforms.contactShadows.x);
    }
#if defined(SHADOW_MULTIPLIER)
    highp vec3 left = takeShadow(visibility);
#endif
    Light sun;
    sun.direction = frameUniforms.sunDirection.xyz;
    sun.illuminance = frameUniforms.sunIlluminance.rgb * visibility;
#if defined(CUSTOM_SURFACE_SHADING)
    sun.color = tintedByShadow(frameUniforms.sunIlluminance.rgb, visibility);
    sun.attenuation = 1.0;
    sun.visibility = max3(visibility);
    sun.position = vertex_worldPosition + sun.direction;
#endif
#if defined(SHADOW_MULTIPLIER)
    highp vec3 light = shadeLight(surface, sun);
    shading_leftByShadows += light * left;
    return light;
#else
    return shadeLight(surface, sun);
#endif
}

#endif

void addLights(Surface surface, inout highp vec3 sum) {
#if defined(HAS_SUN)
    if (variant_sun != 0) sum += sunLight(surface);
#endif
#if defined(HAS_LIGHT_LIST)
    if (variant_lightList != 0) sum += punctualLights(surface);
#endif
}
