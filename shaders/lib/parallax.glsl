// SPDX-License-Identifier: Apache-2.0
// Relief without geometry: where a view ray that enters at uv meets a height field. Use in materials:
//     #define PARALLAX_HEIGHT(uv) textureLod(materialParams_height, uv, 0.0).x
//     #include "shaders/lib/parallax.glsl"
// PARALLAX_HEIGHT gives heights in [0, 1], 1 at the surface. It is fetched in loops, so it must not use implicit
// derivatives.
//   viewTangent  unit, towards the eye, in tangent space: x along uv.x, y along uv.y, z > 0 along the normal.
//   scale        depth of the height field in units of uv.
// fp32 only: texture coordinates.

#ifndef PARALLAX_HEIGHT
#define PARALLAX_HEIGHT(uv) (1.0f + 0.0f * (uv).x) // all at the surface; names uv, or compilers find it unused
#endif

// Below this the ray would run along the surface.
const float kMinParallaxCosine = 0.0625f;

// How far uv moves while the ray descends through the whole field. Kaneko et al. 2001, "Detailed Shape Representation
// with Parallax Mapping". fp32 only.
vec2 parallaxShift(vec3 viewTangent, float scale) {
    return vec2(viewTangent.x, viewTangent.y) * (scale / max(viewTangent.z, kMinParallaxCosine));
}

// Intersection of two line segments: the ray from depth rayBefore to rayAfter, and the field from fieldBefore to
// fieldAfter, which is below the ray before and above it after. Returns the fraction of the way, [0, 1]. fp32 only.
float parallaxCrossing(float rayBefore, float fieldBefore, float rayAfter, float fieldAfter) {
    float before = max(fieldBefore - rayBefore, 0.0f);
    float after = max(rayAfter - fieldAfter, 0.0f);
    return min(before / max(before + after, 1e-6f), 1.0f); // GPUs divide by multiplying with a rounded reciprocal
}

// One fetch, as if the field were flat at the depth below uv. fp32 only.
vec2 parallaxPlain(vec2 uv, vec3 viewTangent, float scale) {
    return uv - parallaxShift(viewTangent, scale) * (1.0f - PARALLAX_HEIGHT(uv));
}

// The first layer that is below the field: McGuire and McGuire 2005, "Steep Parallax Mapping". Exact for features wider
// than a step. layers in [1, 256]. Returns uv and the layer's depth, [0, 1]. fp32 only.
vec3 parallaxSteep(vec2 uv, vec3 viewTangent, float scale, int layers) {
    float layerDepth = 1.0f / float(layers);
    vec2 stride = parallaxShift(viewTangent, scale) * layerDepth;
    vec2 at = uv;
    float depth = 0.0f;
    for (int i = 0; i < layers; ++i) {
        if (depth < 1.0f - PARALLAX_HEIGHT(at)) {
            at -= stride;
            depth += layerDepth;
        }
    }
    return vec3(at.x, at.y, min(depth, 1.0f));
}

// The steep search, with the field interpolated linearly between its last two layers: Tatarchuk 2006, "Dynamic Parallax
// Occlusion Mapping with Approximate Soft Shadows". Two more fetches. Returns as parallaxSteep(). fp32 only.
vec3 parallaxOcclusion(vec2 uv, vec3 viewTangent, float scale, int layers) {
    vec3 after = parallaxSteep(uv, viewTangent, scale, layers);
    float layerDepth = min(1.0f / float(layers), after.z);
    vec2 back = parallaxShift(viewTangent, scale) * layerDepth;
    vec2 uvAfter = vec2(after.x, after.y);
    vec2 uvBefore = uvAfter + back;
    float fraction = parallaxCrossing(after.z - layerDepth, 1.0f - PARALLAX_HEIGHT(uvBefore), after.z,
            1.0f - PARALLAX_HEIGHT(uvAfter));
    vec2 at = uvBefore - back * fraction;
    return vec3(at.x, at.y, after.z - layerDepth * (1.0f - fraction));
}

// Metres from the surface to a depth of the field along the view ray, for MaterialInputs::pixelDepthOffset.
//   depth   [0, 1], of parallaxSteep() or parallaxOcclusion().
//   meters  from the highest to the lowest point of the field.
// fp32 only.
float parallaxOffset(float depth, vec3 viewTangent, float meters) {
    return depth * meters / max(viewTangent.z, kMinParallaxCosine);
}

// How much of a light reaches a point of the field past the relief between them. Tatarchuk 2006, as above, takes the
// highest blocker; here a blocker counts by the slope between it and the ray, so a penumbra widens with the distance. One
// fetch a layer.
//   hit           uv and depth, of parallaxSteep() or parallaxOcclusion().
//   lightTangent  as viewTangent; from below the surface, z <= 0, no light comes.
//   softness      slope from the lowest to the highest point of the light: 0 is hard. layers in [2, 256].
// Returns [0, 1]. fp32 only.
float parallaxShadow(vec3 hit, vec3 lightTangent, float scale, int layers, float softness) {
    vec2 uv = vec2(hit.x, hit.y);
    float depth = 1.0f - PARALLAX_HEIGHT(uv); // not that of the hit: below the field it would shadow itself
    vec2 shift = parallaxShift(lightTangent, scale) * depth;
    float blocked = 0.0f;
    for (int i = 1; i < layers; ++i) {
        float way = float(i) / float(layers);
        float above = depth * (1.0f - way) - (1.0f - PARALLAX_HEIGHT(uv + shift * way));
        blocked = max(blocked, above / max(depth * way, 1e-6f));
    }
    return lightTangent.z > 0.0f ? saturate(1.0f - blocked / max(softness, 1e-3f)) : 0.0f;
}

#undef PARALLAX_HEIGHT
