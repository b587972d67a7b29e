// SPDX-License-Identifier: Apache-2.0
// The mean radiance of the environment over the specular lobe of the base, by one look-up or several (Quality.h). The
// cube stores round lobes for a view along the normal; several of them together have the shape of the lobe. Directions
// and weights are in 32 bits.

const float kGoldenCosine = -0.7373688780783197, kGoldenSine = 0.6754902942615238; // of 2.39996 radians

// Either fitted to the lobe (shaders/lib/look_ups.glsl), or at points of a sunflower (Vogel 1979, "A Better Way to Construct
// the Sunflower Head") on the disc of visible normals. In one loop, because the look-up itself is most of the code.
highp vec3 radianceOfSeveral(Surface surface, highp vec3 reflected, int count) {
    bool isFitted = quality_specularLookUps < kLookUpsEight;
    highp float alpha = surface.alpha;
    highp vec3 across = cross(shading_normal, shading_view);
    highp float sine2 = dot(across, across);
    highp vec3 any = shading_normal.y * shading_normal.y < 0.5 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    highp vec3 y = normalizeOrZero(sine2 > 1e-8 ? across : cross(shading_normal, any));
    highp vec3 x = cross(y, shading_normal); // to the side of the view
    highp float nov = min(shading_NoV, 1.0), inverse = 1.0 / float(count);
    highp vec3 view = vec3(sqrt(max((1.0 - nov) * (1.0 + nov), 0.0)), 0.0, nov);
    highp vec2 turn = vec2(1.0, 0.0);
    highp vec3 sum = vec3(0.0);
    highp float weights = 1e-6;
    for (int i = 0; i < count; ++i) {
        highp vec3 direction;
        highp float roughness, weight = 1.0;
        if (isFitted) {
            highp vec2 lookUp = lookUpOf(count, i, surface.perceptualRoughness, nov);
            direction = mix(shading_normal, reflected, lookUp.x);
            roughness = lookUp.y;
        } else {
            highp vec2 disc = turn * sqrt((float(i) + 0.5) * inverse);
            turn = vec2(turn.x * kGoldenCosine - turn.y * kGoldenSine, turn.x * kGoldenSine + turn.y * kGoldenCosine);
            highp vec3 h = visibleHalfVector(nov, alpha, disc);
            highp vec3 light = h * (2.0 * dot(view, h)) - view;
            if (light.z <= 0.0) continue; // below the surface
            direction = x * light.x + y * light.y + shading_normal * light.z;
            weight = visibleLookUpWeight(nov, min(light.z, 1.0), alpha);
            roughness = visibleLookUpRoughness(nov, min(h.z, 1.0), alpha, float(count));
        }
        sum += environmentRadiance(direction, roughness) * weight;
        weights += weight;
    }
    return sum / weights;
}

#if defined(HAS_ANISOTROPY)

highp vec3 radianceAlongGrain(Grooves grooves, int count) {
    bool isAlong = grooves.alpha.x >= grooves.alpha.y;
    highp vec3 x = isAlong ? grooves.tangent : grooves.bitangent; // the lobe is wider along x
    highp vec3 y = cross(shading_normal, x);
    highp vec2 alpha = isAlong ? grooves.alpha : grooves.alpha.yx;
    highp vec3 view = vec3(dot(x, shading_view), dot(y, shading_view), shading_NoV);
    highp vec3 sum = vec3(0.0);
    highp float weights = 1e-6;
    for (int i = 0; i < count; ++i) {
        highp vec4 halfVector = grainHalfVector(view, alpha, (float(i) + 0.5) / float(count));
        highp vec4 lookUp = grainLookUp(view, alpha, halfVector);
        if (lookUp.w <= 0.0) continue; // below the surface, or hidden
        highp vec3 direction = x * lookUp.x + y * lookUp.y + shading_normal * lookUp.z;
        sum += environmentRadiance(direction, grainLookUpRoughness(view, alpha, halfVector, float(count))) * lookUp.w;
        weights += lookUp.w;
    }
    return sum / weights;
}

#endif

// reflected: the mirrored view, as bent by grooves.
vec3 radianceOfRound(Surface surface, highp vec3 reflected) {
    vec3 radiance;
    if (quality_specularLookUps >= kLookUpsTwo) {
        int count = 2;
        if (quality_specularLookUps == kLookUpsThree) count = 3;
        if (quality_specularLookUps == kLookUpsEight) count = 8;
        if (quality_specularLookUps == kLookUpsThirtyTwo) count = 32;
        radiance = radianceOfSeveral(surface, reflected, count);
    } else {
        highp vec3 direction = lobeDirectionTerm(surface.normal, reflected, surface.alpha);
        radiance = environmentRadiance(direction, surface.perceptualRoughness);
    }
    return radiance;
}

vec3 radianceOfBase(Surface surface, highp vec3 reflected) {
    vec3 radiance;
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) {
        bool hasGrain = dot(surface.grooves.tangent, surface.grooves.tangent) > 0.5; // geometry without tangents has none
        if (quality_anisotropicLookUps == kGrainLookUpsOne || !hasGrain) {
            highp vec3 direction = lobeDirectionTerm(surface.normal, reflected, surface.alpha);
            radiance = environmentRadiance(direction, surface.perceptualRoughness);
        } else {
            int count = 5;
            if (quality_anisotropicLookUps == kGrainLookUpsThree) count = 3;
            if (quality_anisotropicLookUps == kGrainLookUpsNine) count = 9;
            radiance = radianceAlongGrain(surface.grooves, count);
        }
    } else
#endif
    {
        radiance = radianceOfRound(surface, reflected);
    }
    return radiance;
}
