// SPDX-License-Identifier: Apache-2.0
// The sum over all lights that reach a surface: shadeLight() of the shading model for each.

// Lights in full shadow are not shaded; authors' models see them, too.
bool isLit(highp vec3 visibility) {
#if defined(CUSTOM_SURFACE_SHADING)
    return true;
#else
    return max3(visibility) > 0.0;
#endif
}

#if defined(HAS_LIGHT_LIST)

#include "shaders/material/surface/light_list.glsl"
#include "shaders/material/surface/listed_light.glsl"

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
        if (variant_shadows != 0) visibility = listedVisibility(lightBuffer.lights[index].offset.yz, isSun, toLight);
#endif
        if (quality_contactShadows != 0) {
            bool isAsked = (int(lightBuffer.lights[index].offset.z) & kContactShadowBit) != 0 && isLit(visibility);
            highp float reach = isSun ? frameUniforms.contactShadows.x : sqrt(dot(toLight, toLight));
            visibility *= contactVisibility(isAsked, direction, reach);
        }
        if (isAnArea) {
            AreaLight area = areaLightAt(index, toLight, colorIntensity);
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
    Light sun;
    sun.direction = frameUniforms.sunDirection.xyz;
    sun.illuminance = frameUniforms.sunIlluminance.rgb * visibility;
#if defined(CUSTOM_SURFACE_SHADING)
    sun.color = tintedByShadow(frameUniforms.sunIlluminance.rgb, visibility);
    sun.attenuation = 1.0;
    sun.visibility = max3(visibility);
    sun.position = vertex_worldPosition + sun.direction;
#endif
    return shadeLight(surface, sun);
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
