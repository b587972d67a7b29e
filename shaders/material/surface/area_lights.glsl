// SPDX-License-Identifier: Apache-2.0
// The light of rectangles, discs and tubes for any shading model.

#include "shaders/material/surface/area_shapes.glsl"

const int kAreaLightsLtc = 1; // 0: none

// A point far away that gives the surface as much light as the area, from the mean direction. integral: in the frame.
Light representativeOf(AreaFrame frame, AreaLight area, highp vec3 integral) {
    highp vec3 toLight = (frame.x * integral.x + frame.y * integral.y) + frame.z * integral.z;
    Light arriving;
    arriving.direction = normalizeOrZero(toLight);
    highp vec3 illuminance = area.luminance * area.color * sqrt(dot(toLight, toLight));
    arriving.illuminance = illuminance * area.visibility;
#if defined(CUSTOM_SURFACE_SHADING)
    arriving.color = tintedByShadow(illuminance, area.visibility);
    arriving.attenuation = 1.0;
    arriving.visibility = max3(area.visibility);
    arriving.position = vertex_worldPosition + area.center;
#endif
    return arriving;
}

// For any shading model. Transmissive models get light on their back as a separate point.
highp vec3 shadeAreaAsPoint(Surface surface, AreaLight area) {
    AreaFrame frame = areaFrame(surface.normal, surface.view);
    highp vec3 integral = integralOver(frame, area);
    highp vec3 reflected = vec3(0.0);
    if (integral.z > 0.0) reflected = shadeLight(surface, representativeOf(frame, area, integral));
#if defined(SHADING_MODEL_SUBSURFACE) || defined(HAS_DIFFUSE_TRANSMISSION) || defined(REFRACTION_THIN)
    AreaFrame behind = behindOf(frame);
    highp vec3 fromBehind = integralOver(behind, area);
    if (fromBehind.z > 0.0) reflected += shadeLight(surface, representativeOf(behind, area, fromBehind));
#endif
    return reflected;
}
