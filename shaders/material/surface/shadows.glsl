// SPDX-License-Identifier: Apache-2.0
// The visibility of a light from this fragment, by shadow maps.
//
// Every texel of a filter is compared with the depth that the receiving plane, the triangle's own, has at the centre of
// that texel. The map holds the same depth there if nothing is in between, so surfaces do not shadow themselves however
// flat the light is, and a bias of a fraction of a texel is enough for creases (after Isidoro 2006, "Shadow Mapping:
// GPU-based Tips and Techniques", whose plane comes from derivatives of the map's coordinates).

#if defined(RECEIVES_SHADOWS)

#include "shaders/material/surface/facet.glsl"
#include "shaders/material/surface/shadow_maps.glsl"

const int kShadowPcf3 = 0; // ShadowFilter
const int kShadowHard = 2;
const int kShadowPcf2 = 3;
const int kShadowPoisson = 5;
const int kShadowPcss = 6;
const highp float kNormalBias = 0.25; // texels
const highp float kLeastCosine = 0.005; // between light and plane: slopes end at half a degree
const highp float kPoissonRadius = 2.16; // texels: a disc that blurs as much as a tent as wide as five
const highp float kWidestPenumbra = 0.0625; // in radius, of a map's width: the margin around a cone or a face
const highp float kLeastPenumbra = 2.0; // texels: narrower ones are a tent's

ShadowReceiver shadowReceiver(int map, highp vec3 toLight) {
    highp vec4 columns[4];
    for (int i = 0; i < 4; ++i) columns[i] = shadowUniforms.maps[map].atlasFromWorld[i];
    highp vec4 width = shadowUniforms.maps[map].texel;
    highp vec3 rowW = vec3(columns[0].w, columns[1].w, columns[2].w);
    highp float w = dot(rowW, vertex_worldPosition) + columns[3].w;
    highp vec3 normal = dot(shading_facet, toLight) < 0.0 ? -shading_facet : shading_facet;
    highp vec3 point = vertex_worldPosition + normal * (kNormalBias * (width.x + width.y * max(w, 0.0)));
    highp vec4 at = columns[0] * point.x + columns[1] * point.y + columns[2] * point.z + columns[3];

    ShadowReceiver receiver;
    receiver.tile = shadowUniforms.maps[map].tile;
    receiver.softness = shadowUniforms.maps[map].softness;
    highp vec3 place = at.xyz / at.w;
    receiver.texel = place.xy;
    receiver.depth = place.z + (width.z + width.w * place.z);
    highp float reach = max(kFilterReach, receiver.softness.w + 1.0);
    receiver.isInside = at.w > 0.0 && place.x >= receiver.tile.x + reach && place.y >= receiver.tile.y + reach &&
            place.x < receiver.tile.z - reach && place.y < receiver.tile.w - reach;
    // The normal in the map's space is that of the world times the cofactors of the derivatives of `place`.
    highp vec3 x = vec3(columns[0].x, columns[1].x, columns[2].x) - rowW * place.x;
    highp vec3 y = vec3(columns[0].y, columns[1].y, columns[2].y) - rowW * place.y;
    highp vec3 z = vec3(columns[0].z, columns[1].z, columns[2].z) - rowW * place.z;
    highp vec2 right = vec2(dot(x, shading_right), dot(y, shading_right));
    highp vec2 down = vec2(dot(x, shading_down), dot(y, shading_down));
    receiver.pixel = sqrt(max(dot(right, right), dot(down, down))) / abs(at.w);
    highp vec3 across = cross(x, y);
    highp float least = kLeastCosine * sqrt(dot(across, across));
    highp float facing = dot(normal, across);
    facing = facing < 0.0 ? min(facing, -least) : max(facing, least);
    receiver.slope = vec2(-dot(normal, cross(y, z)), -dot(normal, cross(z, x))) / facing;
    return receiver;
}

// From one point of Vogel's spiral to the next: the golden angle. Its points are uniform over a disc and keep their
// distance from each other, as those of a Poisson disc do, and need no table. Vogel 1979, "A Better Way to Construct
// the Sunflower Head".
const highp vec2 kGoldenAngle = vec2(-0.737368878, 0.675490294); // cosine, sine

// The x axis of the disc at this pixel, unit.
highp vec2 turnOfDisc() { return directionOfTurn(interleavedGradientNoise(floor(gl_FragCoord.xy))); }

highp vec2 turnedOn(highp vec2 axis) {
    return vec2(axis.x * kGoldenAngle.x - axis.y * kGoldenAngle.y, axis.x * kGoldenAngle.y + axis.y * kGoldenAngle.x);
}

// Point i of `texels` along `axis`, which is as long as the disc is wide.
highp float blockerOnDisc(ShadowReceiver receiver, highp vec2 axis, int i, highp float texels) {
    return blockerInTexel(receiver, receiver.texel + axis * sqrt((float(i) + 0.5) / texels));
}

highp float shadowOfDisc(ShadowReceiver receiver, highp float radius, int texels) {
    highp vec2 axis = turnOfDisc() * radius;
    highp float shadowed = 0.0, all = float(max(texels, 1));
    for (int i = 0; i < texels; ++i) {
        if (blockerOnDisc(receiver, axis, i, all) > 0.0) shadowed += 1.0;
        axis = turnedOn(axis);
    }
    return 1.0 - shadowed / all;
}

// The radius of the penumbra in texels, from what is in front of the plane within the largest possible one; below 0:
// nothing is.
highp float penumbraOf(ShadowReceiver receiver) {
    highp float widest = (receiver.tile.z - receiver.tile.x) * kWidestPenumbra;
    highp vec2 axis = turnOfDisc() * max(min(receiver.softness.x, widest), kLeastPenumbra);
    highp float sum = 0.0, blockers = 0.0;
    for (int i = 0; i < 16; ++i) {
        highp float blocker = blockerOnDisc(receiver, axis, i, 16.0);
        if (blocker > 0.0) {
            sum += blocker;
            blockers += 1.0;
        }
        axis = turnedOn(axis);
    }
    return blockers > 0.0 ? min(sum / blockers * receiver.softness.x, widest) : -1.0;
}

// Without a branch: drivers for CPUs compute both sides of one, but leave a loop that has ended.
highp float shadowOfPenumbra(ShadowReceiver receiver) {
    highp float radius = penumbraOf(receiver);
    int inDisc = radius >= kLeastPenumbra ? 32 : 0;
    int inTent = radius >= 0.0 && inDisc == 0 ? 2 : 0;
    return shadowOfDisc(receiver, radius, inDisc) * shadowOfTent(receiver, inTent); // one of them is 1
}

highp float shadowOf(ShadowReceiver receiver) {
    int chosen = shadowFilter();
    highp float light;
    if (chosen >= kShadowVsm) {
        light = shadowOfBlurred(receiver);
    } else if (chosen == kShadowHard) {
        light = shadowOfTexel(receiver);
    } else if (chosen == kShadowPoisson) {
        light = shadowOfDisc(receiver, kPoissonRadius, 16);
    } else if (chosen == kShadowPcss) {
        light = shadowOfPenumbra(receiver);
    } else {
        int pairs = chosen == kShadowPcf2 ? 1 : chosen == kShadowPcf3 ? 2 : 3;
        light = shadowOfTent(receiver, pairs);
    }
    return light;
}

#endif
