// SPDX-License-Identifier: Apache-2.0
// What a light of the list sends to a point, before anything shadows it.

// From a point to a light.
struct ListedRay {
    highp vec4 colorIntensity; // PunctualLight
    highp vec3 toLight;        // of suns the unit direction
    highp vec3 direction;      // unit; 0: the point is where the light is
    highp float attenuation;   // by distance, cone and profile; of areas by range alone
    bool isSun, isAnArea;
};

ListedRay rayOfListed(ListedLight listed, highp vec3 point) {
    int index = listed.index;
    highp vec4 positionRange = listed.positionRange;
    highp vec4 colorIntensity = lightBuffer.lights[index].colorIntensity;
    bool isSun = colorIntensity.w < 0.0; // its position is the direction towards it
    bool isAnArea = quality_areaLights != 0 && isArea(colorIntensity.w);
    highp vec3 toLight = isSun ? positionRange.xyz : positionRange.xyz - point;
    highp vec3 direction = isSun ? toLight : normalizeOrZero(toLight);
    highp float attenuation = 1.0;
    if (isAnArea) {
        attenuation = rangeWindow(toLight, positionRange.w);
    } else if (!isSun) {
        attenuation = distanceAttenuation(toLight, positionRange.w);
    }
    if (colorIntensity.w > 0.0 && !isAnArea) {
        highp vec4 directionScale = lightBuffer.lights[index].directionScale;
        highp float offset = lightBuffer.lights[index].offset.x;
        attenuation *= spotAttenuation(direction, directionScale.xyz, directionScale.w, offset);
    }
    highp float profiled = lightBuffer.lights[index].offset.w;
    if (quality_lightImages != 0) profiled -= kImagedLightStep * floor(profiled / kImagedLightStep);
    if (quality_lightProfiles != 0 && !isAnArea) {
        if (profiled > 0.0) {
            highp vec3 forward = lightBuffer.lights[index].directionScale.xyz;
            attenuation *= profileShare(int(profiled) - 1, forward, -direction);
        }
    }
    return ListedRay(colorIntensity, toLight, direction, attenuation, isSun, isAnArea);
}
